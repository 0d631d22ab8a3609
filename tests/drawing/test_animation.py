"""Animations of runs."""

import numpy as np
import pytest
from PIL import Image

from neorl import Agent, Arena, Desire, Node, Run, WaterWorld, drawing, place_cells
from neorl.core.modality import PLACE_CELL


@pytest.fixture
def run():
    return Run(place_cells([3]), WaterWorld())


def frames(path):
    with Image.open(path) as film:
        for number in range(film.n_frames):
            film.seek(number)
            yield film.info["duration"], np.asarray(film.convert("RGB"))


def test_a_film_is_as_long_and_as_large_as_it_was_asked_for_and_advances_the_run(run, tmp_path):
    run.advance(123)
    path = drawing.animate(run, tmp_path / "run.gif", seconds=0.4, fps=10, size=150, background="#121212")
    durations, pictures = zip(*frames(path))
    assert durations == (100,) * 4 and run.step == 123 + 15
    assert {picture.shape for picture in pictures} == {(162, 150, 3)}
    assert all(np.all(picture[0, 0] == 0x12) for picture in pictures)
    assert not np.array_equal(pictures[0], pictures[-1])


def test_filming_does_not_change_the_run(run, tmp_path):
    other = run.copy()
    drawing.animate(run, tmp_path / "run.gif", seconds=0.3, fps=10, size=64)
    other.advance(run.step)
    np.testing.assert_array_equal(run.world_state.scene.position, other.world_state.scene.position)


def test_a_slow_world_repeats_frames_and_an_arena_is_filmed(tmp_path):
    arena = Arena(fps=5)
    run = Run(Agent([Node("PC", PLACE_CELL, [3])], [Desire("platform", "PC", 1.0)]), arena)
    path = drawing.animate(run, tmp_path / "arena.GIF", seconds=0.5, fps=20, size=64)
    assert run.step == 2 and sum(duration for duration, _ in frames(path)) == 500


@pytest.mark.parametrize("change, message", [
    ({"run": "run"}, "run must be a Run, but is 'run'"), ({"path": "run.mp4"}, "path must be a file that ends in '.g"),
    ({"seconds": 0}, r"seconds must be a finite number from 1e-30 to 1e\+30, but is 0"),
    ({"seconds": float("nan")}, "seconds must be .*, but is nan"),
    ({"seconds": 1e6}, "seconds must be at most 200 at 25 frames per second, 5000 in all, but is 1000000.0"),
    ({"fps": 0}, "fps must be an integer from 1 to 50, but is "),
    ({"fps": 2**80}, "fps must be .*, but is 1208925819614629174706176"),
    ({"fps": 12.5}, "fps must be .*, but is 12.5"), ({"size": 10}, "size must be an integer from 64 to 2000, but is "),
    ({"background": "a dark one"}, "background must be a colour of matplotlib's, but is 'a dark one'"),
])
def test_a_film_that_cannot_be_made_is_refused_before_the_run_goes_on(run, tmp_path, monkeypatch, change, message):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(ValueError, match=message):
        drawing.animate(**{"run": run, "path": "run.gif"} | change)
    assert run.step == 0 and not list(tmp_path.iterdir())
