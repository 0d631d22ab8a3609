"""Rate maps: the activity of a cell by the agent's place, as neuroscience draws it (O'Keefe and Dostrovsky 1971).

A cell of a map is active or not, so its rate at a place is the fraction of the agent's time there during which the cell
was active. Nothing is smoothed, and unvisited places are empty.
"""

from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import Normalize, PowerNorm
from matplotlib.patches import Rectangle
from numpy.typing import NDArray

from neorl import checks
from neorl.drawing.boards import as_board, check_run_in_plane
from neorl.drawing.style import INK, axes_or_new
from neorl.experiments.run import Run

LOOKS = 50  # samples per second, or one per step if there are fewer steps
MOST_LOOKS = 10_000_000


class Track(NamedTuple):
    """The positions of an agent over time, and the active cells of one map."""

    position: np.ndarray  # float64 (looks, 2), in units of the world's size
    cells: np.ndarray  # int64 (looks, points): the active cell for each thing or other point that the map follows
    step: float  # seconds from one sample to the next


def track(run: Run, seconds: float, index: int = 0) -> Track:
    """Advance a run, and sample it up to 50 times per second as a `Track`.

    run: a `neorl.Run` in a world of two axes, which is advanced. seconds: simulated, > 0.
    index: of the map in `Agent.maps`. Raises ValueError for anything else.

    >>> run = neorl.Run(neorl.place_cells([5]), neorl.WaterWorld())
    >>> drawing.track(run, seconds=10).position.shape
    (500, 2)
    """
    check_run_in_plane(run)
    index = checks.integer("index", index, at_least=0, at_most=len(run.agent.maps) - 1)
    every = max(1, round(run.world.fps / LOOKS))
    looks = max(1, round(checks.positive("seconds", seconds) * run.world.fps / every))
    if looks > MOST_LOOKS:
        raise checks.error("seconds", f"so long that the run has at most {MOST_LOOKS} looks, here {looks}", seconds)
    first, end = run.parameters.maps.first_track[index : index + 2]
    active, position = run.state.tracks.cell[first:end], run.world_state.scene.position
    places, cells = np.empty((looks, 2)), np.empty((looks, end - first), np.int64)
    for look in range(looks):
        run.advance(every)
        places[look], cells[look] = position, active
    return Track(places / run.world.size, cells, every / run.world.fps)


def rate_map(track: Track, cell: int | None = None, bins: int = 20) -> NDArray[np.floating]:
    """The rate of a cell by place, or without a cell the agent's seconds at each place: float64 (bins, bins).

    Bins are row by row from the upper left; positions beyond the board belong to those at its edge. The rate is in
    0 … 1, and NaN at unvisited places.

    track: a `Track`. cell: of its map, 0 … cells − 1, or None. bins: along each side of the unit board, integer from 1
    to 1000. Raises ValueError for anything else.

    >>> run = neorl.Run(neorl.place_cells([2]), neorl.WaterWorld())
    >>> drawing.rate_map(drawing.track(run, seconds=60), cell=0, bins=2)[0, 0]
    np.float64(1.0)
    """
    track = _checked(track)
    bins = checks.integer("bins", bins, at_least=1, at_most=1000)
    column, row = np.clip((track.position * bins).astype(np.int64), 0, bins - 1).T
    place = row * bins + column
    looks = np.bincount(place, minlength=bins**2).reshape(bins, bins)
    if cell is None:
        return looks * track.step
    active = np.any(track.cells == checks.integer("cell", cell, at_least=0), axis=1)
    found = np.bincount(place, active, minlength=bins**2).reshape(bins, bins)
    return np.divide(found, looks, out=np.full((bins, bins), np.nan), where=looks > 0)


def _checked(track):
    """The `Track` as plain arrays. Raises ValueError unless it is one, with at least one sample."""
    position = checks.doubles("position of track", checks.instance("track", track, Track).position)
    cells, step = np.asarray(track.cells), checks.positive("step of track", track.step)
    if position.ndim != 2 or position.shape[1] != 2 or cells.dtype.kind not in "iu" or cells.ndim != 2 or (
            len(cells) != len(position)) or not len(cells):
        raise ValueError("track must have positions (looks, 2) and integer cells (looks, points), but has "
                         f"{position.shape} and {cells.dtype} {cells.shape}, every {step} s")
    return Track(position, cells, step)


def draw_rate_map(track: Track, cell: int | None = None, bins: int = 20, ax: Axes | None = None) -> Axes:
    """Draw a `rate_map` over the board, with a scale beside it, into `ax` or a new figure; returns the axes.

    Seconds are coloured by their square root, so that places where the agent rested do not darken all others. In
    WaterWorld a strip in the east and the south is empty: the agent's position is that of its upper left corner.

    track, cell, bins: as in `rate_map`. Raises ValueError for anything else.

    >>> run = neorl.Run(neorl.object_vector_cells([3]), neorl.WaterWorld())
    >>> seen = drawing.track(run, seconds=60)
    >>> axes = drawing.draw_rate_map(seen, cell=4)
    """
    rates = rate_map(track, cell, bins)
    axes = as_board(axes_or_new(ax))
    shown = np.where(rates > 0, rates, np.nan) if cell is None else rates
    norm = PowerNorm(0.5, vmin=0) if cell is None else Normalize(vmin=0)
    image = axes.imshow(shown, extent=(0, 1, 1, 0), cmap="viridis", norm=norm, interpolation="nearest")
    axes.set(xlim=(-0.02, 1.02), ylim=(1.02, -0.02))
    axes.add_patch(Rectangle((0, 0), 1, 1, fill=False, edgecolor=INK, linewidth=1.4))
    scale = axes.figure.colorbar(image, ax=axes, shrink=0.8,
                                 label="seconds" if cell is None else f"share of time with cell {cell} active")
    scale.outline.set_visible(False)
    return axes
