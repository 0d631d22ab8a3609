"""Worker processes that end with their starter, run a few at a time, each after those that it needs.

A worker's standard input is a pipe that its starter holds open. When the pipe closes, however the starter has ended,
the worker ends with all that it has started in turn. It has a session of its own, so that a keyboard interrupt reaches
its starter alone, which then ends it. Run as a program, this file is a worker that runs a script:
``python workers.py SCRIPT …``.
"""

import os
import runpy
import subprocess
import sys
import threading
import time
from dataclasses import dataclass

import psutil

PATIENCE = 10  # seconds until a worker that should end is killed


@dataclass(frozen=True)
class Task:
    """A script to run in a worker.

    command: the script and its arguments. needs: names of tasks that must be done before. alone: whether nothing may
    run beside it, since it measures times.
    """

    command: tuple
    needs: frozenset = frozenset()
    alone: bool = False


def work(tasks, at_once, say):
    """Run tasks, {name: Task} in order of preference, and return the names of those that failed.

    at_once: how many may run in parallel. say: called with each line of output. A task is left out if one that it
    needs has failed.
    """
    waiting, running, done, failed = dict(tasks), {}, set(), []
    try:
        while waiting or running:
            for name, task in list(waiting.items()):
                missed = [each for each in failed if each in task.needs]
                if missed:
                    say(f"{name}: left out, since it needs {', '.join(missed)}")
                    failed.append(name)
                    del waiting[name]
                elif task.needs <= done and _fits(task, [tasks[each] for each in running], at_once):
                    running[name] = start(task.command)
                    del waiting[name]
            time.sleep(0.05)
            for name, process in list(running.items()):
                if process.poll() is not None:
                    del running[name]
                    process.stdin.close()
                    if process.returncode < 0:
                        say(f"{name}: its process was killed by signal {-process.returncode}; "
                            "perhaps there was not enough memory")
                    done.add(name) if process.returncode == 0 else failed.append(name)
    finally:
        for process in running.values():  # none, unless interrupted
            process.stdin.close()
        for process in running.values():
            end(process)
    return failed


def _fits(task, running, at_once):
    return not running or not task.alone and len(running) < at_once and not any(each.alone for each in running)


def start(command):
    return subprocess.Popen([sys.executable, __file__, *command], stdin=subprocess.PIPE, start_new_session=True)


def run(command):
    """Run one worker to its end, and return its exit code."""
    process = start(command)
    try:
        return process.wait()
    finally:
        end(process)


def end(process):
    """End a worker; kill it if it does not end by itself."""
    process.stdin.close()
    try:
        process.wait(PATIENCE)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def end_with_starter():
    """Make this process, with all that it starts, end when its starter does."""
    def wait():
        while os.read(sys.stdin.fileno(), 1):
            pass
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


class Watch:
    """A context that kills the processes started within it if they are idle for a number of seconds.

    Idle means less than a 300th of the time of one core. `hung` says whether they were killed.
    """

    def __init__(self, seconds):
        self.seconds, self.hung = seconds, False
        self._over, self._thread = threading.Event(), threading.Thread(target=self._look, daemon=True)

    def __enter__(self):
        self._before = started()
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._over.set()
        self._thread.join()

    def _look(self):
        last, since = self._used(), time.monotonic()
        while not self._over.wait(min(5, self.seconds / 10)):
            now = self._used()
            if now.keys() != last.keys() or sum(now.values()) - sum(last.values()) > self.seconds / 300:
                last, since = now, time.monotonic()
            elif time.monotonic() - since > self.seconds:
                self.hung = True
                kill(started(self._before))
                return

    def _used(self):
        """Seconds of processor time by process."""
        used = {}
        for process in started(self._before):
            try:
                used[process.pid] = sum(process.cpu_times()[:2])
            except psutil.NoSuchProcess:
                continue
        return used


if __name__ == "__main__":
    end_with_starter()  # before slow imports
    sys.argv = sys.argv[1:]
    runpy.run_path(sys.argv[0], run_name="__main__")
