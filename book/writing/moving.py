"""Draw the moving picture of the README and the still one of the front page, from the kernels: ``make pictures``.

Two agents in tanks that begin alike, as on the front page (`star.py`), and a star that moves: on the left the one with
experience, on the right the one without. Pictures are the same in every run with one version of matplotlib and Pillow.
"""

from io import BytesIO
from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt
from PIL import Image

import neorl
from neorl import drawing
from neorl.common.files import write_whole
from writing.star import AGENT, LESSON, SEED, TANK, experienced, with_star

FOLDER = Path(__file__).parents[1] / "vendor"
PLACES = ((0.82, 0.18), (0.15, 0.85), (0.85, 0.8), (0.2, 0.15), (0.5, 0.55))  # of the star, in turn
SECONDS, FRAMES = 3, 10  # that the star stays; a second, at the pace of the tank
COLOURS, DOTS = 32, 72  # of the moving picture; dots per inch
TRAIL = 100  # steps
STILL = 1.5  # turns of the star, after which the still picture is taken


def main():
    moving, last = film()
    write_whole(FOLDER / "star.gif", moving)
    write_whole(FOLDER / "star.png", last)


def film(places=PLACES, seconds=SECONDS, lesson=LESSON, dots=DOTS):
    """(the moving picture as a GIF, a moment in the left tank as a PNG), as bytes."""
    runs = [experienced(places[0], lesson), neorl.Run(with_star(AGENT, places[0]), TANK, SEED)]
    pictures, paths, still = [], [[], []], BytesIO()
    for place in places:
        for run in runs:
            run.change(with_star(AGENT, place))
        for _ in range(seconds * FRAMES):
            for run, path in zip(runs, paths):
                path += [*run.record(TANK.fps // FRAMES).positions / TANK.width]
            pictures.append(picture(runs, [path[-TRAIL:] for path in paths], place, dots))
            if len(pictures) == int(seconds * FRAMES * STILL):
                save_still(still, runs[0], paths[0][-TRAIL:], place, dots)
    palette = pictures[len(pictures) // 2].quantize(COLOURS)
    first, *others = (each.quantize(palette=palette, dither=Image.Dither.NONE) for each in pictures)
    moving = BytesIO()
    first.save(moving, "gif", save_all=True, append_images=others, duration=1000 // FRAMES, loop=0, optimize=True)
    return moving.getvalue(), still.getvalue()


def save_still(file, run, path, place, dots):
    """Save one tank as a PNG without a background, for light and dark pages."""
    axes = drawing.new_board(size=5)
    draw(axes, run, path, place)
    axes.figure.savefig(file, format="png", dpi=2 * dots, transparent=True)
    plt.close(axes.figure)


def picture(runs, paths, place, dots):
    """Both tanks at one moment, as an image."""
    boards = drawing.new_boards(columns=2, rows=1)
    figure = boards[0].figure
    figure.set(size_inches=(10, 5.4), dpi=dots, facecolor="white")
    for axes, run, path, title in zip(boards, runs, paths, ("100 minutes of experience", "none")):
        draw(axes, run, path, place)
        axes.set_title(title, size=17)
    figure.canvas.draw()
    image = Image.fromarray(np.asarray(figure.canvas.buffer_rgba())).convert("RGB")
    plt.close(figure)
    return image


def draw(axes, run, path, place):
    """A tank with the agent's path and the star."""
    across, down = np.transpose(path)
    axes.plot(across, down, color=drawing.AGENT, linewidth=2.5, alpha=0.5)
    drawing.draw_world(TANK, run.world_state, axes)
    axes.plot(*place, marker="*", markersize=26, color="#a03fb5", markeredgecolor="white", clip_on=False)


if __name__ == "__main__":
    main()
