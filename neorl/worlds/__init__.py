"""Worlds for agents to act in, and the rollout of an agent in any of them.

`WaterWorld` is the world of the papers; an `Arena` has walls and places of interest. Three more have other spaces: the
joints of an `Arm`, the waters of a `Vessel` with a rudder, and the pool of a `WaterMaze`. `neorl.worlds.walls` has
walls that any world can hold. `neorl.worlds.world` says how to write a world, with `kinds` of things, `actions` and
`rules`.
"""

from neorl.worlds.arena import Arena as Arena
from neorl.worlds.arm import Arm as Arm
from neorl.worlds.vessel import Vessel as Vessel
from neorl.worlds.water_maze import WaterMaze as WaterMaze
from neorl.worlds.waterworld import WaterWorld as WaterWorld
