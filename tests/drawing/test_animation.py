"""Animations of runs."""

import numpy as np
import pytest
from PIL import Image

from neorl import Run, WaterWorld, drawing, place_cells


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
