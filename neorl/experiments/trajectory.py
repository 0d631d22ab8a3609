"""The trajectory of a run: where the agent was, what it did and earned, and the returns of its episodes."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from neorl import checks


@dataclass(frozen=True, eq=False)
class Trajectory:
    """What `neorl.Run.record` has recorded of a run, in frames of several steps.

    steps: int64 (frames + 1,), how many steps the run had taken at the beginning and at the end of each frame.
    positions: float64 (frames + 1, axes), of the agent then, in the world's units; where an episode ends, the place
        where it ended.
    actions: int64 (frames,), the number of the last action of each frame.
    rewards: float64 (frames,), summed over each frame.
    hits: int64 (frames, kinds), the number of things of each kind that were met in each frame.
    ends: int64 (episodes,), how many steps the run had taken when each episode ended.
    returns: float64 (episodes,), the total reward of each of these episodes; the first counts from where the recording
        began.
    """

    steps: NDArray[np.int64]
    positions: NDArray[np.float64]
    actions: NDArray[np.int64]
    rewards: NDArray[np.float64]
    hits: NDArray[np.int64]
    ends: NDArray[np.int64]
    returns: NDArray[np.float64]

    __eq__ = checks.equal_fields
