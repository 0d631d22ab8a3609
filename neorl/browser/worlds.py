"""The worlds of the Explorer as one, so that its module holds the life of an agent once: WaterWorld or the arena.

The state has room for what either needs, and the rules say which of the two it is.
"""

from typing import NamedTuple

from neorl.core.kernel import array, kernel
from neorl.core.scene import Scene
from neorl.worlds import arena, waterworld
from neorl.worlds.arena import Arena, ArenaRules, ArenaState
from neorl.worlds.waterworld import WaterWorld, WaterWorldState
from neorl.worlds.world import Dynamics


class EitherState(NamedTuple):
    """The fields of `WaterWorldState` and of `ArenaState`."""

    scene: Scene
    direction: array("float64", "things", 2)
    speed: array("float64", "things")
    jitter: array("float64", "things")
    inside: array("bool", "things")
    clock: array("int64", 1)
    stream: array("uint64", 4)


class EitherRules(NamedTuple):
    """The rules of both worlds, and which of them holds."""

    in_arena: bool
    waterworld: waterworld.Rules
    arena: ArenaRules


def rules_of(world):
    """The `EitherRules` of a `WaterWorld` or an `Arena`; those of the other mean nothing."""
    if isinstance(world, Arena):
        return EitherRules(True, WaterWorld().rules, world.rules)
    return EitherRules(False, world.rules, Arena(places=[("", 0.0, 0.0)] * world.things).rules)


@kernel
def reset(state: EitherState, rules: EitherRules) -> None:
    """Start an episode."""
    if rules.in_arena:
        arena.reset(ArenaState(state.scene, state.inside, state.clock, state.stream), rules.arena)
    else:
        waterworld.reset(WaterWorldState(state.scene, state.direction, state.speed, state.jitter, state.stream),
                         rules.waterworld)


@kernel
def step(state: EitherState, rules: EitherRules, action: int):
    """One step. Returns (reward, done)."""
    if rules.in_arena:
        return arena.step(ArenaState(state.scene, state.inside, state.clock, state.stream), rules.arena, action)
    return waterworld.step(WaterWorldState(state.scene, state.direction, state.speed, state.jitter, state.stream),
                           rules.waterworld, action)


EITHER = Dynamics(reset, step)
