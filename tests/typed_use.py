"""Typical uses, which mypy checks against the annotations of the package (`make types`); never run."""

from typing import assert_type

import numpy as np
from numpy.typing import NDArray

from neorl import (Actions, Agent, Desire, Learner, Learning, Node, NresMap, Place, Policy, Run, WaterWorld,
                   multimodal, place_cells)
from neorl.core.horde import learn, superpose
from neorl.custom import Axis, Modality, softmax
from neorl.worlds import Arena
from neorl.core.modality import cartesian, polar

TILES = Modality("place cell", cartesian("position", (0, 1), (0.0, 1.0)))
AGENT = Agent([Node("PC", TILES, [3, 7])], [Desire("green", "PC", 1.0), Desire(Place(0.5, 0.5), "PC", -1)],
              Learning(learning_rate=0.1), Policy(choose=softmax(0.1)))
assert_type(place_cells([3]), Agent)
assert_type(multimodal(resolutions=(2, 3), learning=Learning()), Agent)
assert_type(NresMap(3, TILES).encode([[0.1, 0.2]]), NDArray[np.int64])
assert_type(polar("objects", 1.0), tuple[Axis, ...])

WORLD = WaterWorld(n_creeps=3)
POOL = Arena(places=[("food", 0.5, 0.5)], start=(0.1, 0.5), shape="square")
reward, met, done = WORLD.step(WORLD.reset(0), "N")
assert_type(reward, float)
assert_type(done, bool)

run = Run(AGENT, WORLD)
assert_type(run.q(0), NDArray[np.float32])
assert_type(run.copy(), Run)
assert_type(Run.load("run.npz"), Run)

learner = Learner(AGENT, things=2, kinds=["green", "red"], actions=Actions(["l", "r"], [[-1.0], [1.0]]))
assert_type(learner.act(), int)

Q = np.zeros((4, 2, 4), np.float32)
learn(Q, 0, 1, [0.5, 0.5])
assert_type(superpose(Q, 0, [1], [1.0]), NDArray[np.float64])

place_cells("3")  # type: ignore[arg-type, unused-ignore]
NresMap("3")  # type: ignore[arg-type]
WaterWorld(creeps=3)  # type: ignore[call-arg]
