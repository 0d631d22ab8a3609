"""Controllers that know the physics, and a planner with the exact model: reference levels without learning.

1. *nearest green*: accelerates towards the nearest green creep, along the axis of the larger distance.
2. *PD*: its target velocity is proportional to the vector to a green creep, with a lead for the creep's motion on the
   way, plus a repulsion from red creeps ahead. It accelerates along the axis of the larger velocity error. The green
   creep is the one nearest to where the agent's own velocity carries it. The `Gains` are found by random search
   (`companion.alternatives.search`).
3. *planner*: at every step it copies the world, tries some first moves in the copy, each followed by the PD controller
   up to a horizon, and takes the first action of the best one (a rollout policy; Tesauro and Galperin 1996). Creeps yet
   to appear are left out: it knows the rules, not the future. Its reward is an achieved level, not a bound. Parts of
   its knowledge can be removed: the creeps' motion, the red creeps, what follows a capture.
"""

import math
from typing import NamedTuple

import numpy as np

from companion.alternatives.contests import Contestant, learn_nothing
from companion.alternatives.tabular_learners import ACTIONS, nearest
from neorl.core.choices import Action
from neorl.custom import ABSENT, array
from neorl.kernels.kernel import inlined_kernel, kernel
from neorl.worlds.waterworld import GREEN, RED, WaterWorldState, step

PLANNED = 1 / 30  # length of the planner's runs, which does not learn, as a share of a learner's
PUSH = 0.25  # board widths per second that an action adds to the velocity
HOLDS = (1, 2, 4, 8, 16)


class Gains(NamedTuple):
    """Parameters of a PD controller; lengths in board widths, times in seconds."""

    approach: float  # target velocity per distance, in 1/s
    fastest: float  # largest target velocity towards a green creep
    braking: float  # time over which the agent's own velocity is extrapolated
    lead: float  # time over which a green creep's velocity is extrapolated, per board width to it
    fear: float  # velocity away from a red creep at distance 0
    fear_reach: float  # distance at which a red creep begins to repel
    fear_lead: float  # time over which the velocities of the agent and a red creep are extrapolated
    rest: float  # velocity error below which no action is taken, as a share of a push


class Plan(NamedTuple):
    """Parameters of a planner: its controller, how far it looks ahead, and what its model contains."""

    gains: Gains
    horizon: int  # steps
    discount: float  # per step
    captures: int  # number of green creeps after which a plan ends
    moving: bool  # whether creeps move in the copy of the world
    avoiding: bool  # whether the copy has red creeps


class Nothing(NamedTuple):
    """The memory of a controller, which needs none."""

    unused: array("float64", 1)


class Copy(NamedTuple):
    """The memory of a planner: a copy of the world."""

    world: WaterWorldState


def nearest_green():
    """The `Contestant` that accelerates towards the nearest green creep."""
    return Contestant(act_nearest, learn_nothing, (), _nothing)


def pd(gains):
    """The `Contestant` that leads green creeps and avoids red ones, with these `Gains`."""
    return Contestant(act_pd, learn_nothing, gains, _nothing)


def planner(gains, horizon=100, discount=0.99, captures=100, moving=True, avoiding=True):
    """The `Contestant` that plans with the exact model, see `Plan`."""
    plan = Plan(gains, horizon, discount, captures, moving, avoiding)
    return Contestant(act_planner, learn_nothing, plan, lambda world, stream: Copy(world.reset(0)))


def _nothing(world, stream):
    return Nothing(np.zeros(1))


@inlined_kernel
def towards(x, y, least):
    """The action along the larger of two components, or no-op if that is at most `least`."""
    if max(abs(x), abs(y)) <= least:
        return Action.no_op
    if abs(x) > abs(y):
        return Action.E if x > 0.0 else Action.W
    return Action.S if y > 0.0 else Action.N


@kernel
def act_nearest(setting, memory, state, rules):
    """The action towards the nearest green creep."""
    scene, target = state.scene, nearest(state.scene, GREEN, 0.0)
    if target < 0:
        return Action.no_op
    return towards(scene.things[target, 0] - scene.position[0], scene.things[target, 1] - scene.position[1], 0.0)


@inlined_kernel
def pd_action(gains, state, width, target):
    """The PD controller's action when it pursues the creep `target`."""
    scene, wanted_x, wanted_y = state.scene, 0.0, 0.0
    if target >= 0:
        dx = (scene.things[target, 0] - scene.position[0]) / width
        dy = (scene.things[target, 1] - scene.position[1]) / width
        ahead = gains.lead * math.sqrt(dx * dx + dy * dy) * state.speed[target] / width
        wanted_x = gains.approach * (dx + ahead * state.direction[target, 0])
        wanted_y = gains.approach * (dy + ahead * state.direction[target, 1])
        length = math.sqrt(wanted_x * wanted_x + wanted_y * wanted_y)
        if length > gains.fastest:
            wanted_x, wanted_y = wanted_x / length * gains.fastest, wanted_y / length * gains.fastest
    for thing in range(scene.kinds.shape[0]):
        if scene.kinds[thing] == RED:
            speed = state.speed[thing]
            dx = (scene.position[0] - scene.things[thing, 0]
                  + gains.fear_lead * (scene.velocity[0] - speed * state.direction[thing, 0])) / width
            dy = (scene.position[1] - scene.things[thing, 1]
                  + gains.fear_lead * (scene.velocity[1] - speed * state.direction[thing, 1])) / width
            distance = math.sqrt(dx * dx + dy * dy)
            if 0.0 < distance < gains.fear_reach:
                force = gains.fear * (1.0 / distance - 1.0 / gains.fear_reach)
                wanted_x += force * dx
                wanted_y += force * dy
    return towards(wanted_x - scene.velocity[0] / width, wanted_y - scene.velocity[1] / width, gains.rest * PUSH)


@kernel
def act_pd(setting, memory, state, rules):
    """The PD controller's action."""
    return pd_action(setting, state, rules.width, nearest(state.scene, GREEN, setting.braking))


@inlined_kernel
def copy_world(source, target, moving, avoiding):
    for axis in range(2):
        target.scene.position[axis] = source.scene.position[axis]
        target.scene.velocity[axis] = source.scene.velocity[axis]
    for thing in range(source.speed.shape[0]):
        for axis in range(2):
            target.scene.things[thing, axis] = source.scene.things[thing, axis]
            target.direction[thing, axis] = source.direction[thing, axis]
        target.scene.kinds[thing] = source.scene.kinds[thing]
        target.speed[thing] = source.speed[thing] if moving else 0.0
        target.jitter[thing] = source.jitter[thing]
        if source.scene.kinds[thing] == RED and not avoiding:
            leave(target, thing)


@inlined_kernel
def leave(world, thing):
    """Remove a creep from the world, so that nothing meets it."""
    world.scene.kinds[thing] = ABSENT
    world.scene.things[thing, 0] = world.scene.things[thing, 1] = np.nan


@inlined_kernel
def value_of_plan(plan, world, state, rules, action, hold, target):
    """Simulate a plan in a copy of the world: (discounted reward, first action)."""
    copy_world(state, world, plan.moving, plan.avoiding)
    total, weight, first, captured = 0.0, 1.0, action, 0
    for now in range(plan.horizon):
        if now >= hold:
            pursued = target if target >= 0 else nearest(world.scene, GREEN, plan.gains.braking)
            action = pd_action(plan.gains, world, rules.width, pursued)
        if now == 0:
            first = action
        reward, done = step(world, rules, action)
        total += weight * reward
        weight *= plan.discount
        if done:
            break
        for thing in range(world.speed.shape[0]):
            if world.scene.met[thing] > 0:
                captured += world.scene.met[thing] == GREEN + 1
                leave(world, thing)  # its replacement is unknown
                target = -1
        if captured >= plan.captures:
            break
    return total, first


@kernel
def act_planner(setting, memory, state, rules):
    """The first action of the best plan; each pursues one green creep, at once or after a push that is held."""
    best, most = Action.no_op, -np.inf
    for target in range(state.speed.shape[0]):
        if state.scene.kinds[target] == GREEN:
            for pushed in range(1 + len(HOLDS) * ACTIONS):
                hold = 0 if pushed == 0 else HOLDS[(pushed - 1) // ACTIONS]
                value, first = value_of_plan(setting, memory.world, state, rules, (pushed - 1) % ACTIONS, hold, target)
                if value > most:
                    best, most = first, value
    return best
