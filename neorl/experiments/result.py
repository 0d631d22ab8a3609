"""The result of a condition: rewards and hits of its runs, as arrays, tables of pandas, and files.

A saved result is an npz file of its arrays, rewards and hits, and a text, about: a table in JSON with the agent, the
world and everything else that determined it, as plain data (`neorl.description`), digests of the user's code among it
(`neorl.worlds.former`), and the version of neorl.
"""

from dataclasses import dataclass, fields
from operator import attrgetter
from os import PathLike
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from neorl.common import checks
from neorl.common.array_files import open_arrays, write_arrays
from neorl.common.extras import require
from neorl.common.version import VERSION
from neorl.common.warn import warn
from neorl.description import described, restored, warn_of_main
from neorl.experiments.bins import bin_shapes, bin_steps
from neorl.experiments.condition import Condition
from neorl.worlds.former import changes, code_of, stand_in


@dataclass(frozen=True, eq=False)
class Result:
    """The rewards and hits of the runs of one condition.

    condition: the `neorl.Condition`, whose agent, world, steps, runs, seed and changes the result has, too.
    rewards: float32 (runs, bins), in bins of about 0.2 s. hits: int16 (runs, bins, kinds), the number of things of
    each kind that were met, counted up to 32,767 in a bin; in WaterWorld green and red creeps.
    """

    condition: Condition
    rewards: NDArray[np.float32]
    hits: NDArray[np.int16]

    __eq__ = checks.equal_fields

    agent, world, steps, runs, seed, changes = (property(attrgetter(f"condition.{each.name}"))
                                                for each in fields(Condition))

    @property
    def seconds(self) -> float:
        """Simulated seconds per run."""
        return self.steps / self.world.fps

    @property
    def edges(self) -> NDArray[np.float64]:
        """float64 (bins + 1,): when the first bin begins and when each bin ends, in simulated seconds."""
        steps = np.arange(self.rewards.shape[1] + 1) * bin_steps(self.world)
        return np.minimum(steps, self.steps) / self.world.fps

    @property
    def time(self) -> NDArray[np.float64]:
        """float64 (bins,): when each bin ends, in simulated seconds."""
        return self.edges[1:]

    @property
    def totals(self) -> NDArray[np.float64]:
        """float64 (runs,): the accumulated reward of each run."""
        return self.rewards.sum(axis=1, dtype=float)

    def rate(self, begin: float = 0.0, end: float = 1.0) -> NDArray[np.float64]:
        """float64 (runs,): reward per simulated second between two fractions of the run, to the nearest bin.

        begin, end: the fractions, in [0, 1]. Raises ValueError for others, and for intervals shorter than a bin.
        """
        bins, seconds = self._stretch(begin, end)
        return self.rewards[:, bins].sum(axis=1, dtype=float) / seconds

    def hit_rate(self, begin: float = 0.0, end: float = 1.0) -> NDArray[np.float64]:
        """float64 (runs, kinds): things of each kind met per simulated second between two fractions of the run.

        begin, end: the fractions, in [0, 1]. Raises ValueError as `rate` does.
        """
        bins, seconds = self._stretch(begin, end)
        return self.hits[:, bins].sum(axis=1) / seconds

    def _stretch(self, begin, end):
        checks.real("begin", begin, 0, 1)
        checks.real("end", end, 0, 1)
        first, last = (round(share * self.rewards.shape[1]) for share in (begin, end))
        if first >= last:
            raise checks.error("end", f"a share at least a bin after begin, {begin!r}", end)
        return slice(first, last), self.edges[last] - self.edges[first]

    def to_frame(self) -> Any:
        """A `pandas.DataFrame` with a row for each run and bin, sorted by run, then bin.

        Columns: "run", int64; "time", float64, when the bin ends, in simulated seconds; "reward", float32, the sum over
        the bin; and for each kind of thing, such as ``hits_green``, int16, the number met in the bin.
        Raises ImportError without pandas.
        """
        runs, bins = self.rewards.shape
        columns = {"run": np.repeat(np.arange(runs), bins), "time": np.tile(self.time, runs),
                   "reward": self.rewards.reshape(-1)}
        columns |= {f"hits_{kind}": self.hits[:, :, i].reshape(-1) for i, kind in enumerate(self.world.kinds)}
        return require("pandas", extra="data").DataFrame(columns, copy=True)

    def save(self, path: str | PathLike[str]) -> None:
        """Save to a NumPy npz file: the arrays rewards and hits, and the text about, a table in JSON.

        An existing file is replaced. Raises OSError if it cannot be written, ValueError for an agent or a world that
        cannot be imported by name (`neorl.description`). Warns of what stands in ``__main__``, which other programs
        cannot load.
        """
        known, arrays = about(self.condition), {"rewards": self.rewards, "hits": self.hits}
        write_arrays(checks.path("path", path), "Result", known, arrays, np.savez_compressed)
        warn_of_main(path, known)

    @classmethod
    def load(cls, path: str | PathLike[str]) -> Self:
        """Load a result that `save` has written.

        A kernel or a world of the user's whose code has changed or cannot be found is replaced by what the file knows
        of it (`neorl.worlds.former`), with a warning: the condition then equals none of the present code.
        Raises OSError if there is no such file, ValueError if it is damaged, of another kind or from a newer neorl.
        """
        path = checks.path("path", path)
        with open_arrays(path, "Result") as file:
            try:
                changed = changes(file.about, file.about.get("code"))
                stand_in(file.about, file.about.get("code"), changed)
                condition = condition_of(file.about)
            except (ValueError, LookupError, TypeError, AttributeError) as error:
                raise ValueError(f"{path}: {error}") from error
            result = cls(condition, **file.read(bin_shapes(condition.world, condition.runs, condition.steps)))
        if changed:
            warn(f"{path} has a result of other code than the present: {'; '.join(changed.values())}")
        return result


def about(condition):
    """Everything that determines a condition as plain data, and the version of neorl.

    Raises ValueError for an agent or a world that cannot be imported by name.
    """
    data = described(condition, Condition)
    return {"neorl": VERSION, **data, "code": code_of(data, condition)}


def condition_of(known):
    """The condition that `about` has described. Raises ValueError if it cannot be restored."""
    return restored({each.name: known[each.name] for each in fields(Condition) if each.name in known}, Condition)

