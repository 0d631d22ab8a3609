"""Maps of values and receptive fields show the right numbers."""

import numpy as np
import pytest
from matplotlib.patches import Wedge
from matplotlib.transforms import Affine2D

from neorl import Agent, Axis, Desire, Modality, Node, NresMap, Run, WaterWorld, drawing
from neorl.core.geometry import TAU
from neorl.core.modality import HEAD_DIRECTION_CELL, OBJECT_VECTOR_CELL, polar

TANK = WaterWorld()
UNEQUAL_POLAR = Modality("polar", [Axis("objects", "length", boundaries=(0, 0.1, 0.3, 0.8)),
                                   Axis("objects", "direction", intervals=5)])


def wedges(axes):
    return [patch for patch in axes.patches if isinstance(patch, Wedge)]


@pytest.mark.parametrize("modality", [OBJECT_VECTOR_CELL, UNEQUAL_POLAR, HEAD_DIRECTION_CELL,
                                      Modality("", polar("objects", 0.5))])
def test_the_sectors_of_a_polar_map_hold_what_the_map_puts_into_them(modality):
    nres_map = NresMap(4, modality)
    patches = wedges(drawing.draw_cells(nres_map))
    assert len(patches) == nres_map.cells
    angles, radii = np.random.default_rng(0).random((2, 500)) * [[TAU], [0.99]]
    places = radii[:, None] * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    points = np.stack([radii, angles], axis=1)[:, -len(modality.axes):]
    large = Affine2D().scale(1_000)  # contains_point is accurate only to about a pixel
    for place, cell in zip(places, nres_map.encode(points)):
        assert patches[cell].get_path().transformed(large).contains_point(1_000 * place, radius=1e-6)


def test_arrows_of_a_polar_map_lie_in_its_sectors_and_point_where_values_pull():
    nres_map = NresMap(3, OBJECT_VECTOR_CELL)
    values = np.zeros((9, 4))
    values[:, 2] = 1.0  # east
    axes = drawing.draw_values(nres_map, values)
    (quiver,) = axes.collections
    np.testing.assert_allclose(quiver.V, 0, atol=1e-12)
    assert np.all(quiver.U > 0)
    middles = np.stack([quiver.X + quiver.U / 2, quiver.Y + quiver.V / 2], axis=1)
    for cell, patch in enumerate(wedges(drawing.draw_cells(nres_map))):
        assert patch.get_path().contains_point(middles[cell])


def learned(modality, resolution):
    run = Run(Agent([Node("node", modality, [resolution])], [Desire("green", "node", 1.0)]), TANK)
    run.advance(20_000)
    return run
