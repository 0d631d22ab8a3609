"""Finished conditions on disk, so that nothing is computed twice.

A condition is kept under a key of all that determines it: agent, world, steps, runs, seed, and the source of every
module that takes part in a run, and of every kernel of the user's own. A file is complete or absent, whatever moment
the process is killed at, and carries a digest of its content: one that is damaged is noticed and computed again.

The files lie in the folder that the environment variable ``NEORL_CACHE`` names, or in the user's cache folder; all of
it may be deleted at any time (`neorl.files`).
"""

import hashlib
import io
import json
import zipfile
from dataclasses import dataclass, fields

import numpy as np

from neorl import checks, files
from neorl.agents.agent import Agent
from neorl.agents.description import described, restored
from neorl.core.identity import digest_of_source, identity
from neorl.experiments.simulation import Result, checked_changes, simulate
from neorl.worlds.world import World

PARTS = ("checks", "files", "core", "worlds", "agents", "experiments")  # all that a run is made of


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
        return files.cache_folder() / "conditions" / self.key


def source_digest():
    """A digest of the source of every module that takes part in a run."""
    return digest_of_source(*PARTS)


def load(condition):
    """The `Result` of a condition if it is on disk, or else None."""
    content = files.read_checked(condition.path)
    if content is None:
        return None
    arrays = np.load(io.BytesIO(content))
    return Result(**condition.choices, rewards=arrays["rewards"], hits=arrays["hits"])


def save(condition, result):
    """Write the `Result` of a condition to disk."""
    content = io.BytesIO()
    try:
        about = json.dumps(described(condition))
    except ValueError:  # a kernel that no module has
        about = ""
    np.savez_compressed(content, rewards=result.rewards, hits=result.hits, condition=np.array(about))
    files.write_checked(condition.path, content.getvalue())


def kept():
    """Every condition on disk that was computed with the present source and can be described, in a fixed order."""
    found = [_condition_in(path) for path in sorted((files.cache_folder() / "conditions").glob("*"))]
    return [condition for condition in found if condition is not None]


def _condition_in(path):
    content = files.read_checked(path)
    if content is None:
        return None
    try:
        condition = restored(json.loads(str(np.load(io.BytesIO(content))["condition"])))
        return condition if condition.path == path else None
    except (ValueError, KeyError, TypeError, AttributeError, EOFError, zipfile.BadZipFile):
        return None  # foreign, not described, or of another version
