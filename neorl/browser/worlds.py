"""The Explorer's worlds in the plane merged into one, so that its module contains the agent's kernels only once.

The state has the fields of all of them, and the rules select the current one.
"""

from typing import NamedTuple

from neorl.core.scene import Scene
from neorl.kernels.annotations import array, fields, is_tuple, new_tuple
from neorl.kernels.kernel import kernel
from neorl.worlds import arena, arm, water_maze, waterworld
from neorl.worlds.arena import Arena, ArenaRules, ArenaState
from neorl.worlds.arm import Arm, ArmRules, ArmState
from neorl.worlds.water_maze import WaterMaze, WaterMazeRules, WaterMazeState
from neorl.worlds.waterworld import WaterWorld, WaterWorldState
from neorl.worlds.world import Dynamics

IN_THE_PLANE = (WaterWorld, Arena, Arm, WaterMaze)  # in the order of their numbers
WATERWORLD, ARENA, ARM, WATER_MAZE = range(len(IN_THE_PLANE))
NAMES = ("waterworld", "arena", "arm", "water_maze")


class PlaneState(NamedTuple):
    """The union of the state fields of all these worlds."""

    scene: Scene
    direction: array("float64", "things", 2)
    speed: array("float64", "things")
    jitter: array("float64", "things")
    inside: array("bool", "things")
    hand: array("float64", 2)
    point: array("float64", "things", 2)
    platform: array("float64", 2)
    trial: array("int64", 1)
    clock: array("int64", 1)
    latency: array("float64", "trials")
    stream: array("uint64", 4)


class PlaneRules(NamedTuple):
    """The rules of all these worlds, and the number of the current one."""

    world: int  # the number of the current world
    waterworld: waterworld.Rules
    arena: ArenaRules
    arm: ArmRules
    water_maze: WaterMazeRules


def rules_of(world):
    """The `PlaneRules` of a world in the plane, all 0 for the other worlds; for any other world its own rules."""
    if not isinstance(world, IN_THE_PLANE):
        return world.rules
    number = IN_THE_PLANE.index(type(world))
    sizes = sizes_of(world)
    rules = {name: world.rules if each == number else _blank(fields(PlaneRules)[name], sizes)
             for each, name in enumerate(NAMES)}
    return PlaneRules(number, **rules)


def sizes_of(world):
    """The sizes of a world's arrays by name, 0 for arrays that only other worlds have."""
    return {"obstacles": 0, "places": 0, "trials": 0} | world.sizes


def _blank(kind, sizes):
    given = {name: field(0) for name, field in fields(kind).items() if isinstance(field, type) and not is_tuple(field)}
    return new_tuple(kind, sizes, given)


@kernel
def reset(state: PlaneState, rules: PlaneRules) -> None:
    """Start an episode."""
    scene, stream = state.scene, state.stream
    if rules.world == ARENA:
        arena.reset(ArenaState(scene, state.inside, state.clock, stream), rules.arena)
    elif rules.world == ARM:
        arm.reset(ArmState(scene, state.hand, state.point, stream), rules.arm)
    elif rules.world == WATER_MAZE:
        water_maze.reset(WaterMazeState(scene, state.platform, state.trial, state.clock, state.latency, stream),
                         rules.water_maze)
    else:
        waterworld.reset(WaterWorldState(scene, state.direction, state.speed, state.jitter, stream), rules.waterworld)


@kernel
def step(state: PlaneState, rules: PlaneRules, action: int):
    """Take one step. Returns (reward, done)."""
    scene, stream = state.scene, state.stream
    if rules.world == ARENA:
        return arena.step(ArenaState(scene, state.inside, state.clock, stream), rules.arena, action)
    if rules.world == ARM:
        return arm.step(ArmState(scene, state.hand, state.point, stream), rules.arm, action)
    if rules.world == WATER_MAZE:
        return water_maze.step(WaterMazeState(scene, state.platform, state.trial, state.clock, state.latency, stream),
                               rules.water_maze, action)
    return waterworld.step(WaterWorldState(scene, state.direction, state.speed, state.jitter, stream),
                           rules.waterworld, action)


PLANE = Dynamics(reset, step)
