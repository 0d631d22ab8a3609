"""Workers: they end with their parent process, and run a few at a time."""

import signal
import subprocess
import sys
import time
from pathlib import Path

import psutil
import pytest
import workers


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


def log_of(script):
    return (script.parent / "log").read_text().split()


def test_workers_run_a_few_at_a_time(script):
    names = "abcd"
    assert workers.work({name: (script, name, "0.1", "0") for name in names}, 2, print) == []
    log = log_of(script)
    assert sorted(log) == sorted(f"{sign}{name}" for sign in "+-" for name in names)
    count = [sum(1 if each[0] == "+" else -1 for each in log[:end]) for end in range(len(log) + 1)]
    assert max(count) <= 2


def test_a_worker_that_failed_is_named_and_the_others_go_on(script):
    codes, said = {"bad": "1", "shot": "killed", "fine": "0"}, []
    commands = {name: (script, name, "0", code) for name, code in codes.items()}
    assert workers.work(commands, 2, said.append) == ["bad", "shot"]
    assert "-fine" in log_of(script)
    assert said == ["shot: its process was killed by signal 9; perhaps there was not enough memory"]


@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGTERM, signal.SIGINT])
def test_workers_and_what_they_have_started_end_with_their_starter(tmp_path, how):
    (tmp_path / "worker.py").write_text("""import subprocess, sys
code = "import time; print('up', flush=True); time.sleep(1000)"
subprocess.run([sys.executable, "-c", code], start_new_session=True)
""")
    program = (f"import sys; sys.path.insert(0, {str(Path(workers.__file__).parent)!r}); import workers\n"
               f"workers.work({{'w': ({str(tmp_path / 'worker.py')!r},)}}, 1, print)")
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
    with workers.watch(1.0) as hung:
        busy = "import time\nend = time.monotonic() + 2\nwhile time.monotonic() < end: 0"
        subprocess.run([sys.executable, "-c", busy])
    assert not hung.is_set()


def test_an_idle_process_is_killed_and_nothing_else():
    before = subprocess.Popen(["sleep", "1000"])
    with workers.watch(0.5) as hung:
        began = time.monotonic()
        done = subprocess.run(["sleep", "60"])
    assert hung.is_set() and done.returncode == -signal.SIGKILL and time.monotonic() - began < 60
    assert before.poll() is None
    before.kill()
    before.wait()
