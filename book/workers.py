"""Worker processes that end with their starter.

A worker's standard input is a pipe that its starter holds open. When the pipe closes, however the starter has ended,
the worker ends with all that it has started in turn. It has a session of its own, so that a keyboard interrupt reaches
its starter alone. Run as a program, this file is a worker that runs a script: ``python workers.py SCRIPT …``.
"""

import os
import runpy
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from itertools import compress

import psutil


def work(commands, at_once, say):
    """Run scripts, {name: (script, argument, …)}, and return the names of those that failed.

    at_once: how many may run in parallel. say: called with a line of output.
    """
    pipe, held = os.pipe()
    pool = ThreadPoolExecutor(at_once)

    def fails(name):
        code = run(commands[name], pipe)
        if code < 0:
            say(f"{name}: its process was killed by signal {-code}; perhaps there was not enough memory")
        return code != 0

    try:
        return list(compress(commands, pool.map(fails, commands)))
    finally:
        os.close(held)  # no worker is running, unless interrupted
        pool.shutdown(cancel_futures=True)
        os.close(pipe)


def run(command, pipe=subprocess.PIPE):
    """Run one worker to its end, and return its exit code."""
    with subprocess.Popen([sys.executable, __file__, *command], stdin=pipe, start_new_session=True) as process:
        return process.wait()


def end_with_starter():
    """Make this process, with all that it starts, end when its starter does."""
    def wait():
        while os.read(sys.stdin.fileno(), 1):
            pass
        for stream in (1, 2):  # the script would report its processes that end
            os.dup2(os.open(os.devnull, os.O_WRONLY), stream)
        kill(started())
        os._exit(1)

    threading.Thread(target=wait, daemon=True).start()


def started(before=()):
    """The processes that this one has started, directly or indirectly, except those in before."""
    return [each for each in psutil.Process().children(recursive=True) if each not in before]


def kill(processes):
    for process in processes:
        try:
            process.kill()
        except psutil.NoSuchProcess:
            continue


@contextmanager
def watch(seconds):
    """Kill the processes started within this context once they take no processor time for a number of seconds.

    No time means less than a 300th of the time of one core. The event in the context says whether they were killed.
    """
    before, over, hung = started(), threading.Event(), threading.Event()

    def look():
        last = {}
        while not over.wait(seconds):
            now = {process.pid: used(process) for process in started(before)}
            if now.keys() == last.keys() and sum(now.values()) - sum(last.values()) < seconds / 300:
                hung.set()
                return kill(started(before))
            last = now

    thread = threading.Thread(target=look, daemon=True)
    thread.start()
    try:
        yield hung
    finally:
        over.set()
        thread.join()


def used(process):
    """Seconds of processor time that a process has taken."""
    try:
        return sum(process.cpu_times()[:2])
    except psutil.NoSuchProcess:
        return 0.0


if __name__ == "__main__":
    end_with_starter()  # before slow imports
    sys.argv = sys.argv[1:]
    runpy.run_path(sys.argv[0], run_name="__main__")
