"""Valid arguments for the public callables, and what is done with their results, as a run uses an agent."""

import pathlib
import tempfile

import numpy as np
from fuzzing import entry
from same import numbers
from hypothesis import strategies as st

import neorl
from neorl import Agent, Condition, Desire, Learner, Learning, Node, NresMap, Policy, Result, Run, Scene, WaterWorld
from neorl.custom import Axis, Modality
from neorl.worlds import Arena, Vessel, WaterMaze
from neorl.core.coordinates import sense
from neorl.core.modality import CARTESIAN_OBJECT_VECTOR_CELL, PLACE_CELL
from neorl.description import described, restored
from neorl.gym import environment
from neorl.kernels import kernel
from neorl.kernels.annotations import arrays
from neorl.kernels.identity import identity

def learned(individual):
    """The numbers of a `Learner` or `Run`, but for a working memory in which NaN stands for no direction."""
    return {name: each for name, each in numbers(individual).items() if name != "coordinates"}


def live(agent, world=WaterWorld(n_creeps=2), steps=60):
    """All numbers of an agent after a short run, before which it is hashed, shown, described and restored."""
    identity(agent), hash(agent), repr(agent)
    assert restored(described(agent)) == agent
    run = Run(agent, world)
    paid = run.advance(steps)
    return paid, list(learned(run).values())


def live_in(world):
    identity(world), hash(world), repr(world)
    assert restored(described(world)) == world
    kinds = world.kinds[:1]
    return live(Agent([Node("PC", PLACE_CELL, [3])], [Desire(each, "PC", 1.0) for each in kinds]), world)


def tile(axis):
    return use_modality(Modality("cell", [axis], [(0.1, 0.2)] if axis.of == "landmarks" else ()))


def tile_by(kernel):
    return tile(Axis(kernel))


def use_modality(cells):
    identity(cells), hash(cells), repr(cells)
    assert restored(described(cells)) == cells
    board = WaterWorld(n_creeps=2)
    return (NresMap(3, cells).encode(np.full((2, len(cells.axes)), 0.3)),
            sense(cells, board.reset(0).scene, board.size) if cells.least_axes <= 2 else None)


def want_it(desire):
    nodes = [Node("PC", PLACE_CELL, [2]), Node("OVC", CARTESIAN_OBJECT_VECTOR_CELL, [3])]
    return live(Agent(nodes, [Desire("green", "PC", 1.0), desire]))


def in_a_loop(learner):
    axes, things = learner.world.actions.axes, learner.world.things
    here = Scene(np.zeros(axes), None, np.zeros((things, axes)), [None] * things, ())
    learner.begin(here)
    for _ in range(3):
        learner.act()
        learner.observe(here)
    return list(learned(learner).values())


def new_learner():
    return Learner(neorl.place_cells([3]), 2, ("green", "red"))


def acted():
    one = new_learner()
    one.begin(SCENE)
    one.act()
    return one


def new_env():
    return environment.WorldEnv(BOARD)


def begun(env):
    env.reset(seed=0)
    return env


def scene_of(observation, info):
    return Scene(np.array([0.5, 0.5]), np.zeros(2), np.zeros((0, 2)), (), ())


SCENE = Scene((0.5, 0.25), (0.0, 0.1), [(0.1, 0.2), (0.3, 0.4)], ("green", None), (0, 1))
SCENES = st.sampled_from([SCENE, SCENE._replace(velocity=None, met=()), Scene(
    np.array([0.5, 0.5]), np.zeros(2), np.ones((2, 2)), np.array([0, 1]), np.array([True, False]))])
BOARD, POOL = WaterWorld(n_creeps=2), Arena()
VESSEL, MAZE = Vessel(), WaterMaze()
RESULT = Result(Condition(neorl.place_cells([3]), WaterWorld(), 400, 3),
                np.linspace(-1, 1, 120, dtype=np.float32).reshape(3, 40), np.ones((3, 40, 2), np.int16))
CONDITION = Condition(neorl.place_cells([2]), BOARD, 40, 1)
reals = st.floats(-2, 2)
shares = st.floats(0, 1)
seeds = st.integers(0, 2**70)
resolutions = st.sampled_from([(2, 3), [4], range(1, 3), np.array([2, 3])])
q = st.sampled_from([0.0, 0.5]).map(lambda value: np.full((4, 2, 4), value, np.float32))
states = st.integers(0, 5).map(BOARD.reset)
agents = st.sampled_from([neorl.place_cells([3]), neorl.network_d([2])])
paths = st.sampled_from(["run.npz"]).map(lambda name: str(pathlib.Path(tempfile.gettempdir()) / name))
described_paths = st.sampled_from(["value.json", "value.toml"]).map(
    lambda name: str(pathlib.Path(tempfile.gettempdir()) / name))
of_paper = {"learning": [Learning()], "policy": [Policy()], "own_cell": ["counts", "silent"], "weighting": ["cells"],
            "shared_cell": ["each", "once"], "resets": ["noticed", "unnoticed"],
            "tiled_fraction": st.floats(0.1, 2), "object_tiled_fraction": st.floats(0.1, 2)}


def paper(function, **arguments):
    return entry(function, **(of_paper | arguments), resolutions=resolutions, then=live,
                 also=("resolution", "low", "high"))


def method(function, subject):
    """A method as a function of its arguments, called on a fresh subject each time."""
    def call(**arguments):
        return function(subject(), **arguments)
    return call


def scene_then(function, subject):
    def call(**fields):
        one = subject()
        function(one, Scene(**fields))
        one.act()
        return list(learned(one).values()), list(arrays(one._scene).values())
    return call


def step_with(**fields):
    state = BOARD.reset(0)
    scene = Scene(**{name: fields.pop(name) for name in Scene._fields})
    return BOARD.step(state._replace(scene=scene, **fields), 1), state


def fields_of(state):
    found = {**state._asdict(), **state.scene._asdict()}
    return {name: [each] for name, each in found.items() if name != "scene"}


def live_in_state(**fields):
    run = Run(neorl.place_cells([3]), BOARD)
    scene = Scene(**{name: fields.pop(name) for name in Scene._fields})
    run.world_state = run.world_state._replace(scene=scene, **fields)
    return run.advance(50), list(arrays(run.world_state).values())


def saved(path):
    run = Run(neorl.place_cells([3]), BOARD)
    run.save(path)
    return Run.load(path).step


def saved_as(value):
    def save(path):
        value.save(path)
        return type(value).load(path)

    return save


def make_with(function):
    made = kernel.kernel_maker(function)
    return made(1.0)
