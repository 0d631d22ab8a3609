"""How long agents stay in the receptive fields of maps of several resolutions (claim T8).

1. A path is where an agent was after each step.
2. In a map of places over the whole board the path is a sequence of cells. Each change of cell ends a *stay*.
3. The mean stay is the length of the path, in seconds, divided by the number of changes of cell. A path without a
   change counts as one stay.
"""

import numpy as np

from neorl import checks
from neorl.nres import NresMap


def follow(run, steps):
    """The path of a `Run` over its next steps: float64 (steps, 2), in board widths.

    Raises ValueError unless steps is an integer ≥ 1.
    """
    path = np.empty((checks.integer("steps", steps, at_least=1), 2))
    for place in path:
        run.advance(1)
        place[:] = run.state.agent_position
    return path / run.world.width


def mean_stays(path, resolutions, fps):
    """Mean seconds in a cell of maps of places over the whole board: float64 (maps,).

    path: (steps, 2), in board widths. resolutions: N of each map. fps: steps a second.
    """
    cells = np.array([NresMap(resolution).encode(path) for resolution in resolutions])
    changes = np.count_nonzero(np.diff(cells, axis=1), axis=1)
    return len(path) / fps / np.maximum(changes, 1)
