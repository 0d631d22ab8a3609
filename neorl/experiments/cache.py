"""Cache of finished conditions on disk, so that nothing is computed twice.

The key of a condition covers everything that determines it: agent, steps, runs, seed, all that runs take from the
world, the source of every module that takes part in a run, and every kernel of the user's own with all that it looks up
(`neorl.core.identity`). A file is complete or absent, even if the process is killed, and carries a digest of its
content: a file that is damaged, or was not written by this version, counts as absent. Single runs of a long condition
are also cached, until the whole condition is.

The files are in the folder that the environment variable ``NEORL_CACHE`` names, or in the user's cache folder; all of
them may be deleted at any time (`neorl.files`).
"""

import hashlib
import io
import zipfile
from dataclasses import dataclass, fields

import numpy as np

from neorl import checks, files
from neorl.agents.agent import Agent
from neorl.core.description import Described
from neorl.core.identity import digest_of_source, identity
from neorl.experiments.exchange import note
from neorl.experiments.run import bin_steps
from neorl.experiments.simulation import Result, checked_changes
from neorl.worlds.world import World

PARTS = ("checks", "extras", "files", "core", "worlds", "agents", "experiments")  # everything that takes part in a run


@dataclass(frozen=True)
class Condition(Described):
    """Everything that determines a `Result`. The fields are those of `simulate` of the same names.

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
        """A digest of the condition and the source that it runs with: 64 hexadecimal digits."""
        return hashlib.sha256(f"{identity(self)} {source_digest()}".encode()).hexdigest()

    @property
    def path(self):
        """The file of its result."""
        return files.cache_folder() / "conditions" / self.key


def source_digest():
    """A digest of the source of every module that takes part in a run."""
    return digest_of_source(*PARTS)


source_digest()  # on import, since the files may change while this process goes on with their code


def load(condition):
    """The `Result` of a condition if it is on disk, else None."""
    arrays = _read(condition.path, condition)
    return None if arrays is None else Result(**condition.choices, **arrays)


def save(condition, result):
    """Write the `Result` of a condition to disk. Raises OSError if there is no room or no permission."""
    content = io.BytesIO()
    np.savez_compressed(content, about=note(condition, source_digest()), rewards=result.rewards, hits=result.hits)
    files.write_checked(condition.path, content.getvalue())


def load_runs(condition):
    """The runs of an unfinished condition that are on disk: {run: (rewards, hits)}."""
    lived = {}
    for path in _parts(condition):
        arrays = _read(path, condition, "runs")
        if arrays is not None:
            lived |= zip(arrays["runs"].tolist(), zip(arrays["rewards"], arrays["hits"]))
    return lived


def save_runs(condition, lived):
    """Write some runs of a condition to a file of their own. Raises OSError if there is no room or no permission."""
    content = io.BytesIO()
    np.savez(content, runs=np.array(list(lived)), rewards=np.stack([rewards for rewards, _ in lived.values()]),
             hits=np.stack([hits for _, hits in lived.values()]))
    files.write_checked(_part_folder() / f"{condition.key}-{min(lived)}", content.getvalue())


def remove_runs(condition):
    """Remove the single runs of a condition from disk, once the whole condition is there."""
    for path in _parts(condition):
        path.unlink(missing_ok=True)


def _part_folder():
    return files.cache_folder() / "runs"


def _parts(condition):
    return list(_part_folder().glob(f"{condition.key}-*"))


def _read(path, condition, *beside):
    """The arrays in a file if they are from runs of the condition, else None."""
    content = files.read_checked(path)
    if content is None:
        return None
    try:
        with np.load(io.BytesIO(content)) as file:
            arrays = {name: file[name] for name in ("rewards", "hits", *beside)}
    except (ValueError, KeyError, TypeError, EOFError, zipfile.BadZipFile):  # another kind of file
        return None
    runs, bins = arrays["runs"].size if beside else condition.runs, -(-condition.steps // bin_steps(condition.world))
    expected = {"rewards": (np.float32, (runs, bins)), "hits": (np.int16, (runs, bins, len(condition.world.kinds))),
                "runs": (np.int64, (runs,))}
    return arrays if all((each.dtype, each.shape) == expected[name] for name, each in arrays.items()) else None
