"""Runs of the arm, the vessel and the water maze are the same with the compiler switched off."""

import hashlib
import json
import os
import subprocess
import sys

from golden import plain_rule

from neorl import Agent, Arm, Desire, Node, Run, Vessel, WaterMaze
from neorl.core.kernel import arrays
from neorl.core.modality import CARTESIAN_OBJECT_VECTOR_CELL, PLACE_CELL

WORLDS = {"two links": Arm(targets=2, obstacles=2, radius=0.2), "three links": Arm((3, 2, 1), radius=0.2),
          "vessel": Vessel(traffic=9, radius=0.1), "water maze": WaterMaze(((0.5, 0.3), (0.6, 0.7)), 2, 0.25, 5.0)}
STEPS = 250


def digest(name):
    world = WORLDS[name]
    agent = Agent((Node("PC", PLACE_CELL, [5]), Node("OVC", CARTESIAN_OBJECT_VECTOR_CELL, [4])),
                  [Desire(world.kinds[0], "PC", 1.0), Desire(world.kinds[-1], "OVC", -0.2)], plain_rule())
    run = Run(agent, world, seed=5)
    paid = run.advance(STEPS)
    content = [run.state.values.q, *arrays(run.world_state).values()]
    return f"{paid} {hashlib.sha256(b''.join(each.tobytes() for each in content)).hexdigest()}"


def test_runs_are_the_same_with_the_compiler_switched_off():
    """The other process is this file run as a program, with NUMBA_DISABLE_JIT."""
    printed = subprocess.run([sys.executable, __file__], capture_output=True, check=True, env={
        **os.environ, "NUMBA_DISABLE_JIT": "1", "PYTHONPATH": os.pathsep.join(sys.path)}).stdout
    assert json.loads(printed) == {name: digest(name) for name in WORLDS}


if __name__ == "__main__":
    print(json.dumps({name: digest(name) for name in WORLDS}))
