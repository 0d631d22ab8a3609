"""Maps of values and receptive fields show the right numbers."""

import numpy as np
import pytest
from matplotlib.patches import Wedge
from matplotlib.transforms import Affine2D

from companion.paper_b.receptive_fields import draw_receptive_fields
from neorl import Agent, Desire, Node, NresMap, Place, Run, WaterWorld, drawing
from neorl.custom import Axis, Modality
from neorl.core.coordinates import sense, tune
from neorl.core.direction import TAU
from neorl.core.modality import HEAD_DIRECTION_CELL, MODALITIES, OBJECT_VECTOR_CELL, PLACE_CELL, polar

TANK = WaterWorld()
UNEQUAL_POLAR = Modality("polar", [Axis("objects", "length", boundaries=(0, 0.1, 0.3, 0.8)),
                                   Axis("objects", "direction", intervals=5)])
UNEQUAL_PLACES = Modality("places", [Axis("position", boundaries=(0, 0.1, 0.25, 0.7, 1)), Axis("position", along=1)])
UNEQUAL_VELOCITIES = Modality("velocities", [Axis("velocity", boundaries=(-1, -0.2, 0.1, 1)),
                                             Axis("velocity", along=1, low=-1)])


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


@pytest.mark.parametrize("modality, goal", [(PLACE_CELL, (0.7, 0.7)), (OBJECT_VECTOR_CELL, (0.1, 0.0))])
def test_a_value_map_is_the_more_opaque_the_more_the_best_action_is_worth(modality, goal):
    run = learned(modality, 3)
    axes = drawing.draw_value_map(run, [goal], valences=[2.0])
    best = run.q()[:, :, run.agent.maps[0].encode(goal)].max(axis=1)
    filled = axes.patches[9:18]
    np.testing.assert_allclose([patch.get_alpha() for patch in filled], 0.45 * best / best.max(), rtol=1e-6)
    assert len(axes.patches) == 19 and axes.patches[-1].get_linewidth() > 2
    shunned = drawing.draw_value_map(run, [goal, goal], valences=[-0.5, -0.5])
    assert {patch.get_facecolor()[:3] for patch in shunned.patches[9:18] if patch.get_alpha()} <= {
        tuple(int(drawing.RED[i : i + 2], 16) / 255 for i in (1, 3, 5))}


@pytest.mark.parametrize("resolution", [1, 2, 5])
@pytest.mark.parametrize("modality", [*MODALITIES, UNEQUAL_PLACES, UNEQUAL_POLAR, UNEQUAL_VELOCITIES],
                         ids=lambda modality: modality.name)
def test_the_active_receptive_fields_are_filled(modality, resolution):
    state, nres_map = TANK.reset(3), NresMap(resolution, modality)
    state.scene.position[:] = np.array([0.61, 0.43]) * TANK.width
    state.scene.velocity[:] = np.array([-0.3, 0.13]) * TANK.width
    axes = draw_receptive_fields(nres_map, TANK, state)
    axes.figure.draw_without_rendering()
    active = set(nres_map.encode(sense(modality, state.scene, TANK.size)))
    fills = [fill for fill in axes.collections if fill.get_alpha()]
    assert len(fills) == len(active)

    places = np.random.default_rng(0).random((300, 2))
    agent = state.scene.position / TANK.size
    seen = {"position": places, "velocity": (places - agent) / 0.5}.get(modality.follows, places - agent)
    filled = np.any([[fill.get_paths()[0].contains_point(place) for place in places] for fill in fills], axis=0)
    expected = np.isin(nres_map.encode(tune(modality, seen)), list(active))
    assert np.mean(filled == expected) > 0.98  # all but where corners are rounded


def same_map(one, other):
    return [(each.get_alpha(), each.get_facecolor(), each.get_linewidth()) for each in one.patches] == [
        (each.get_alpha(), each.get_facecolor(), each.get_linewidth()) for each in other.patches]


def test_without_goals_a_value_map_is_of_what_the_agent_desires_now():
    agent = Agent([Node("PC", PLACE_CELL, [5]), Node("HD", HEAD_DIRECTION_CELL, [6]),
                   Node("OVC", OBJECT_VECTOR_CELL, [3]), Node("idle", PLACE_CELL, [2])],
                  [Desire("green", "PC", 1.0), Desire("red", "PC", -0.5), Desire(Place(0.1, 0.2), "PC", 2.0),
                   Desire((0.9, 0.9), "PC", 0.25), Desire("PC", "HD", 0.5), Desire("green", "OVC", 1.0)])
    run = Run(agent, WaterWorld(n_creeps=4), seed=2)
    run.advance(20_000)
    scene = run.world_state.scene
    creeps = scene.things / run.world.size
    goals = [*creeps[scene.kinds == 0], *creeps[scene.kinds == 1], (0.1, 0.2), (0.9, 0.9)]
    valences = [1.0] * sum(scene.kinds == 0) + [-0.5] * sum(scene.kinds == 1) + [2.0, 0.25]
    assert same_map(drawing.draw_value_map(run), drawing.draw_value_map(run, goals, valences))
    landing = tune(HEAD_DIRECTION_CELL, run.state.desires[4].target_at)
    assert same_map(drawing.draw_value_map(run, index=1), drawing.draw_value_map(run, [landing], [0.5], index=1))
    assert same_map(drawing.draw_value_map(run, index=2), drawing.draw_value_map(run, [(0.0, 0.0)], index=2))
    with pytest.raises(ValueError, match="goals must be given, since the node 'idle' of this map desires nothing now"):
        drawing.draw_value_map(run, index=3)
    with pytest.raises(ValueError, match="valences must be None without goals, but is"):
        drawing.draw_value_map(run, valences=[1.0])
