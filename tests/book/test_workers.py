"""Workers: they end with their parent process, and each task runs after those that it needs."""

import signal
import subprocess
import sys
import time
from pathlib import Path

import psutil
import pytest

BOOK = Path(__file__).parents[2] / "book"
sys.path.insert(0, str(BOOK))
import workers  # noqa: E402


@pytest.fixture
def script(tmp_path):
    """A script that logs when it begins and ends, and ends as its arguments say."""
    path = tmp_path / "script.py"
    path.write_text("""import os, sys, time
from pathlib import Path
name, seconds, code = sys.argv[1:]
with (Path(__file__).parent / "log").open("a") as log:
    log.write(f"+{name} ")
    log.flush()
    time.sleep(float(seconds))
    os.kill(os.getpid(), 9) if code == "killed" else None
    log.write(f"-{name} ")
sys.exit(int(code))
""")
    return path


def tasks_of(script, table):
    """Turn {name: (seconds, exit code, needs, alone)} into tasks."""
    return {name: workers.Task((script, name, str(seconds), code), frozenset(needs), alone)
            for name, (seconds, code, needs, alone) in table.items()}


def log_of(script):
    return (script.parent / "log").read_text().split()


def test_a_task_runs_after_those_it_needs_and_a_measurement_runs_alone(script):
    tasks = tasks_of(script, {"a": (0.1, "0", "", False), "b": (0.1, "0", "ad", False), "m": (0.1, "0", "", True),
                              "c": (0.1, "0", "", False), "d": (0.1, "0", "", False)})
    assert workers.work(tasks, 2, print) == []
    log = log_of(script)
    assert sorted(log) == sorted(f"{sign}{name}" for sign in "+-" for name in tasks)
    assert log.index("+b") > max(log.index("-a"), log.index("-d"))
    assert log.index("-m") == log.index("+m") + 1
    count = [sum(1 if each[0] == "+" else -1 for each in log[:end]) for end in range(len(log) + 1)]
    assert max(count) <= 2 and all(count[log.index(sign) + at] == 0 for sign, at in (("+m", 0), ("-m", 1)))


def test_a_failed_task_is_named_and_tasks_that_do_not_need_it_go_on(script):
    tasks = tasks_of(script, {"bad": (0, "1", "", False), "shot": (0, "killed", "", False),
                              "after": (0, "0", ["bad"], False), "last": (0, "0", ["after"], False),
                              "fine": (0, "0", "", False)})
    said = []
    assert sorted(workers.work(tasks, 2, said.append)) == ["after", "bad", "last", "shot"]
    assert "-fine" in log_of(script) and "+after" not in log_of(script)
    assert "after: left out, since it needs bad" in said and "last: left out, since it needs after" in said
    assert "shot: its process was killed by signal 9; perhaps there was not enough memory" in said


@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGTERM, signal.SIGINT])
def test_workers_and_what_they_have_started_end_with_their_starter(tmp_path, how):
    (tmp_path / "worker.py").write_text("""import subprocess, sys
code = "import time; print('up', flush=True); time.sleep(1000)"
subprocess.run([sys.executable, "-c", code], start_new_session=True)
""")
    program = (f"import sys; sys.path.insert(0, {str(BOOK)!r}); import workers\n"
               f"workers.work({{'w': workers.Task(({str(tmp_path / 'worker.py')!r},))}}, 1, print)")
    starter = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                               preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler))
    assert starter.stdout.readline() == b"up\n"
    offspring = psutil.Process(starter.pid).children(recursive=True)
    assert len(offspring) == 2
    starter.send_signal(how)
    assert starter.wait(60) != 0
    starter.stdout.close()
    gone, alive = psutil.wait_procs(offspring, timeout=60)
    assert not alive


def test_a_busy_process_is_not_taken_for_hung():
    with workers.Watch(1.0) as watch:
        busy = "import time\nend = time.monotonic() + 3\nwhile time.monotonic() < end: 0"
        subprocess.run([sys.executable, "-c", busy])
    assert not watch.hung


def test_an_idle_process_is_killed_and_nothing_else():
    before = subprocess.Popen(["sleep", "1000"])
    with workers.Watch(0.5) as watch:
        began = time.monotonic()
        done = subprocess.run(["sleep", "60"])
    assert watch.hung and done.returncode == -signal.SIGKILL and time.monotonic() - began < 60
    assert before.poll() is None
    before.kill()
    before.wait()
