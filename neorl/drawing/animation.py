"""Animations of runs as GIF files, for use without Python: in a talk, a README, a message."""

import io
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

from neorl import checks
from neorl.drawing.boards import MARGIN, as_board, check_run_in_plane, draw_world
from neorl.drawing.style import INK, colour_like
from neorl.experiments.run import Run
from neorl.files import write_whole

INCHES = 3.6  # the size of a board, so that letters are as large as on one
HEAD = 0.08  # of the height, for the time and the reward
MOST_FRAMES = 5_000


def animate(run: Run, path: str | PathLike[str], seconds: float = 10.0, fps: int = 25, size: int = 360,
            background: Any = "white") -> Path:
    """Advance a run, and write it as an animated GIF at the speed of the simulation; returns the path.

    run: a `neorl.Run` in a world of two axes, which is advanced. path: ends in ".gif". seconds: simulated, > 0; at most
    5000 frames at `fps`. fps: frames per second, integer from 1 to 50; a GIF counts in hundredths of a second, so 10,
    20, 25 and 50 are exact. size: the width in pixels, integer from 64 to 2000. background: a matplotlib colour, such
    as "white" or "#121212" for a dark page. Raises ValueError for anything else, before the run is advanced, OSError if
    the file cannot be written.

    >>> run = neorl.Run(neorl.place_cells([5, 7]), neorl.WaterWorld())
    >>> path = drawing.animate(run, "run.gif", seconds=0.2, size=120)
    """
    check_run_in_plane(run)
    path = checks.path("path", path)
    if path.suffix.lower() != ".gif":
        raise checks.error("path", "a file that ends in '.gif'", str(path))
    fps = checks.integer("fps", fps, at_least=1, at_most=50)
    size = checks.integer("size", size, at_least=64, at_most=2000)
    frames = max(1, round(checks.positive("seconds", seconds) * fps))
    if frames > MOST_FRAMES:
        raise checks.error("seconds", f"at most {MOST_FRAMES / fps:g} at {fps} frames per second, {MOST_FRAMES} in all",
                           seconds)
    colour_like("background", background)
    content, pictures = io.BytesIO(), _pictures(run, frames, fps, size, background)
    first = next(pictures)
    first.save(content, format="GIF", save_all=True, append_images=pictures, duration=1000 / fps, loop=0)
    write_whole(path, content.getbuffer())
    return path


def _pictures(run, frames, fps, size, background):
    """Yield the frames, each a `PIL.Image.Image`."""
    figure = Figure(figsize=(INCHES, INCHES * (1 + HEAD)), dpi=size / INCHES, facecolor=background,
                    layout="none")
    canvas = FigureCanvasAgg(figure)
    axes = figure.add_axes((0, 0, 1, 1 / (1 + HEAD)))
    begin, paid = run.step, 0.0
    for frame in range(frames):
        paid += run.advance(begin + round(frame * run.world.fps / fps) - run.step)
        axes.clear()
        as_board(axes)
        draw_world(run.world, run.world_state, axes)
        axes.text(0, -MARGIN, f"{run.step / run.world.fps:.1f} s", color=INK, va="center")
        axes.text(1, -MARGIN, f"reward {paid:+.0f}".replace("-", "−"), color=INK, va="center", ha="right")
        canvas.draw()
        yield Image.fromarray(np.asarray(canvas.buffer_rgba())[..., :3])
