"""Worlds for agents to live in, and the rollout of an agent in any of them.

`WaterWorld` is the world of the papers; an `Arena` has walls and places of interest. Three more have other spaces: the
joints of an `Arm`, the waters of a `Vessel` with a rudder, and the pool of a `WaterMaze`. `neorl.walls` has walls that
any world can hold. `neorl.worlds.world` says how to write a world, with `kinds` of things, `actions` and `rules`.
"""
