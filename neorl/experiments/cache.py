"""Finished conditions on disk, so that nothing is computed twice.

A condition is kept under a key of all that determines it: agent, world, steps, runs, seed, and the source of every
module that takes part in a run, and of every kernel of the user's own. A file is complete or absent, whatever moment
the process is killed at, and carries a digest of its content: one that is damaged is noticed and computed again.

The files lie in the folder that the environment variable ``NEORL_CACHE`` names, or in the user's cache folder; all of
it may be deleted at any time.
"""

import functools
import hashlib
import io
import os
from dataclasses import dataclass, fields
from pathlib import Path

import numpy as np
import platformdirs

from neorl import checks
from neorl.agents.agent import Agent
from neorl.experiments.identity import identity
from neorl.experiments.simulation import Result, checked_changes, simulate
from neorl.files import write_whole
from neorl.worlds.world import World

ROOMS = ("core", "worlds", "agents", "experiments")  # all that a run is made of, beside `neorl.checks`
DIGEST_BYTES = hashlib.sha256().digest_size


def simulate_once(agent, world, *, steps, runs, seed=0, changes=(), progress=True):
    """`simulate`, unless the same condition is on disk already; then what was computed is read. Returns a `Result`."""
    condition = Condition(agent, world, steps, runs, seed, changes)
    result = load(condition)
    if result is None:
        result = simulate(**condition.choices, progress=progress)
        save(condition, result)
    return result


@dataclass(frozen=True)
class Condition:
    """All that determines a `Result`: the arguments of `simulate` of the same names.

    Raises ValueError for what `simulate` would refuse.
    """

    agent: Agent
    world: World
    steps: int
    runs: int
    seed: int = 0
    changes: tuple[tuple[int, Agent], ...] = ()

    def __post_init__(self):
        checks.instance("agent", self.agent, Agent)
        checks.instance("world", self.world, World)
        steps = checks.integer("steps", self.steps, at_least=1)
        checks.assign(self, steps=steps, runs=checks.integer("runs", self.runs, at_least=1),
                     seed=checks.integer("seed", self.seed, at_least=0), changes=checked_changes(self.changes, steps))

    @property
    def choices(self):
        """The condition as keyword arguments."""
        return {field.name: getattr(self, field.name) for field in fields(self)}

    @property
    def key(self):
        """A name for the condition and the source that it runs with: 64 hexadecimal digits."""
        return hashlib.sha256(f"{identity(self)} {source_digest()}".encode()).hexdigest()

    @property
    def path(self):
        """Where its result is kept."""
        return folder() / "conditions" / self.key


def load(condition):
    """The `Result` of a condition if it is on disk, or else None."""
    content = read_checked(condition.path)
    if content is None:
        return None
    arrays = np.load(io.BytesIO(content))
    return Result(**condition.choices, rewards=arrays["rewards"], hits=arrays["hits"])


def save(condition, result):
    """Write the `Result` of a condition to disk."""
    content = io.BytesIO()
    np.savez_compressed(content, rewards=result.rewards, hits=result.hits)
    write_checked(condition.path, content.getvalue())


def folder():
    """Where finished conditions and claims are kept: a `pathlib.Path`."""
    return Path(os.environ.get("NEORL_CACHE") or platformdirs.user_cache_path("neorl-companion"))


@functools.cache
def source_digest():
    """A digest of the source of every module that takes part in a run."""
    package = Path(__file__).parents[1]
    paths = [package / "checks.py", package / "files.py",
             *(path for room in ROOMS for path in sorted((package / room).rglob("*.py")))]
    return hashlib.sha256(b"".join(path.read_bytes() for path in paths)).hexdigest()


def read_checked(path):
    """What `write_checked` has written, or None if there is no such file or it is damaged."""
    try:
        content = path.read_bytes()
    except OSError:
        return None
    return content[DIGEST_BYTES:] if hashlib.sha256(content[DIGEST_BYTES:]).digest() == content[:DIGEST_BYTES] else None


def write_checked(path, content):
    """Write bytes to a file, after a digest of them."""
    write_whole(path, hashlib.sha256(content).digest() + content)
