"""The ways in which a recorded run (`golden`) must give the same bits.

A way takes the name of a run and a number of steps, and returns the run's record, or None if the way does not apply to
the run. Other Pythons get an environment in the cache, with the packages that the core needs as pinned by
``environment.txt``.
"""

import hashlib
import itertools
import json
import os
import re
import subprocess
import sys
import tempfile
import tomllib
from functools import partial
from pathlib import Path
from unittest.mock import patch

import golden
from same import newborn

from neorl import Run, simulate
from neorl.common.files import cache_folder
from neorl.experiments import simulation
from neorl.kernels.annotations import is_tuple
from neorl.kernels.execution import execute

ROOT = Path(__file__).parents[1]
RECORD = json.loads(golden.RECORD.read_text())
OLDEST = 11  # minor version of Python


def in_slices(name, steps):
    """In slices of irregular lengths, with an end at every change."""
    run, reward = golden.born(name), 0.0
    lengths = itertools.cycle([1, 2, 7, 333, 1_001])
    for until, later in (*golden.changes_of(name), (steps, None)):
        while run.step < min(until, steps):
            reward += run.advance(min(next(lengths), min(until, steps) - run.step))
        if later and until < steps:
            run.change(later)
    return golden.recorded(name, reward, run.agent, run.memory.q, run.world_state)


def from_a_copy(name, steps, copied=Run.copy):
    """By a copy made midway, after which the original continues independently."""
    run, reward = golden.born(name), 0.0
    for until, later in (*golden.changes_of(name), (steps, None)):
        until = min(until, steps)
        reward += run.advance((until - run.step) // 2)
        run, original = copied(run), run
        original.advance(77)
        reward += run.advance(until - run.step)
        if later and until < steps:
            run.change(later)
    return golden.recorded(name, reward, run.agent, run.memory.q, run.world_state)


def from_a_file(name, steps):
    """By a run saved midway and loaded again."""
    with tempfile.TemporaryDirectory() as folder:
        def through_a_file(run):
            run.save(Path(folder) / "run")
            return Run.load(Path(folder) / "run")
        return from_a_copy(name, steps, through_a_file)


def among_others(name, steps, runs, threads):
    """By `simulate`, as one of several runs, in parallel or one after another in the same memory."""
    found = []

    class Watched(Run):
        """A run that stores its final agent, values and world before the next run reuses its memory."""

        def __init__(self, agent, world, seed, number, after=None):
            super().__init__(agent, world, seed, number, after)
            self.number = number

        def advance(self, *arguments):
            super().advance(*arguments)
            if (self.number, self.step) == (golden.RUN, steps):
                found[:] = self.agent, self.memory.q.copy(), self.copy().world_state

    changes = [change for change in golden.changes_of(name) if change[0] < steps]
    with patch.object(simulation, "Run", Watched):
        result = simulate(golden.agent_of(name), golden.world_of(name), steps=steps, runs=runs, seed=golden.SEED,
                          changes=changes, threads=threads, progress=False)
    return golden.recorded(name, result.totals[golden.RUN], *found)


def by_a_learner(name, steps):
    """By a `Learner` in a Python loop."""
    world, changes = golden.world_of(name), dict(golden.changes_of(name))
    (learner, state), reward = newborn(golden.agent_of(name), world, golden.SEED, golden.RUN), 0.0
    for step in range(steps):
        if step in changes:
            learner.change(changes[step])
        paid, _, done = world.step(state, learner.act())
        reward += paid
        learner.observe(state.scene, paid)
        if done:
            execute(world.dynamics.reset, state, world.rules)
            learner.begin(state.scene)
    return golden.recorded(name, reward, learner.agent, learner.memory.q, state)


def in_webassembly(name, steps):
    """By the browser's module, which contains only the package's kernels."""
    from webassembly import copied

    if golden.changes_of(name) or golden.agent_of(name).policy.choose is not golden.Policy().choose:
        return None
    machine, sizes, arguments = copied(golden.born(name))
    machine.call("rollout", sizes, last_step=steps, **arguments)
    return golden.recorded(name, arguments["log"].paid[1][0], golden.agent_of(name), arguments["memory"].q[1],
                           views(arguments["world_state"]))


def views(values):
    """The arrays in a named tuple of (address, view) pairs."""
    return type(values)(*(views(each) if is_tuple(each) else each[1] for each in values))


WAYS = {
    "in one go": golden.digest,
    "in slices": in_slices,
    "from a copy": from_a_copy,
    "from a file": from_a_file,
    "of 4, 1 thread": partial(among_others, runs=4, threads=1),
    "of 9, 2 threads": partial(among_others, runs=9, threads=2),
    "Learner": by_a_learner,
    "WebAssembly": in_webassembly,
}


def in_a_process(names, steps, python=sys.executable, **settings):
    """The records of runs computed by another interpreter: {name: record}."""
    path = os.pathsep.join([str(ROOT), str(ROOT / "tests")])
    printed = subprocess.run([python, golden.__file__, str(steps), *names], check=True, stdout=subprocess.PIPE,
                             env={**os.environ, "PYTHONPATH": path, **settings}).stdout
    return json.loads(printed)


def interpreted(names):
    """The records of runs with the compiler off: short ones, since they are hundreds of times slower."""
    return in_a_process(names, golden.SHORT, NUMBA_DISABLE_JIT="1")


def version_of(python):
    """The version of an interpreter, such as "3.13.0", or None if it does not run."""
    try:
        return subprocess.run([python, "-c", "import platform; print(platform.python_version())"], check=True,
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return None


def other_pythons():
    """The oldest and the newest supported Python on the path, without the one that is running."""
    mine = sys.version_info.minor
    found = {minor: f"python3.{minor}" for minor in range(OLDEST, 30) if version_of(f"python3.{minor}")}
    return [found[minor] for minor in sorted({min([mine, *found]), max([mine, *found])} - {mine})]


def environment(python):
    """The interpreter of an environment with the current pins, made unless it exists. Raises ValueError without one."""
    version = version_of(python)
    if version is None:
        raise ValueError(f"python must be an interpreter of Python that runs, but is {python!r}")
    folder = cache_folder() / "pythons" / version
    ready, mine = folder / f"ready-{hashlib.sha256(' '.join(pins()).encode()).hexdigest()[:12]}", folder / "bin/python"
    if not ready.exists():
        subprocess.run([python, "-m", "venv", "--clear", folder], check=True)
        subprocess.run([mine, "-m", "pip", "install", "--quiet", "--no-deps", *pins()], check=True)
        ready.touch()
    return mine


def pins():
    """The pins of the packages that the core needs, from ``environment.txt``."""
    needed = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["dependencies"]
    names = {re.match(r"[\w-]+", each)[0] for each in needed} | {"llvmlite"}
    return [line for line in (ROOT / "environment.txt").read_text().splitlines() if line.split("==")[0] in names]
