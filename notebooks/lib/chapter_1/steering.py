"""Navigation by rule: a helmsman rule that steers to a target, and a captain rule that sets it (thesis chapter 1).

1. *Category 1*: carry out a plan. The helmsman aims at a velocity that covers a fixed share of the distance per second,
   and takes the action that brings the velocity closest to that.
2. *Category 2*: make the plan. This captain follows a rule, too: head for the nearest green creep.

Neither rule learns, so they are automatic and not autonomous (definition 1). They are given the laws of motion.
"""

import numpy as np

from neorl import checks
from neorl.core.choices import Action
from neorl.core.kernel import execute, kernel
from neorl.worlds.waterworld import GREEN, reset, step

HASTE = 4.0  # share of the remaining distance to be covered in one second; higher values earn more, up to about 10
CLOSE = 0.05  # of the width: distance at which a waypoint is reached


def follow_route(world, waypoints, seconds, seed=0):
    """Steer from waypoint to waypoint, from the middle of a tank: category 1 navigation.

    waypoints: float (points, 2), in board widths, in [0, 1]. seconds: simulated, positive. seed: of the creeps, which
    have no effect here. Returns the vessel's positions in board widths, float64 (steps + 1, 2). Raises ValueError for
    anything else.
    """
    waypoints = checks.points("waypoints", waypoints, ("x", "y"))
    if waypoints.ndim != 2 or not np.all((0 <= waypoints) & (waypoints <= 1)):
        raise ValueError(f"waypoints is {waypoints!r}, allowed are places (points, 2) in [0, 1]")
    path = np.zeros((int(checks.real("seconds", seconds, 0, 86_400) * world.fps) + 1, 2))
    state = world.reset(seed)
    execute(sail, state, world.rules, waypoints * world.width, CLOSE * world.width, path)
    return path / world.width


def chase(world, steps, runs, seed=0):
    """The reward that helmsman and captain earn together: float64 (runs,).

    Run k begins on the board of run k of `neorl.experiments.run.Run` with the same seed. Raises ValueError for a bad
    argument.
    """
    checks.integer("steps", steps, at_least=1)
    rewards = np.zeros(checks.integer("runs", runs, at_least=1))
    for k in range(runs):
        state = world.reset(np.random.SeedSequence(checks.integer("seed", seed, at_least=0), spawn_key=(k,)))
        rewards[k] = execute(hunt, state, world.rules, steps)
    return rewards


@kernel
def steer(state, rules, x, y):
    """The action after which the velocity is closest to the one that leads to (x, y)."""
    scene = state.scene
    want_x, want_y = HASTE * (x - scene.position[0]), HASTE * (y - scene.position[1])
    miss_x, miss_y = want_x - scene.velocity[0], want_y - scene.velocity[1]
    vertical = abs(miss_y) > abs(miss_x)
    if max(abs(miss_x), abs(miss_y)) < 0.125 * rules.width:  # half the change that an action makes
        return Action.no_op.value
    if vertical:
        return Action.N.value if miss_y < 0.0 else Action.S.value
    return Action.E.value if miss_x > 0.0 else Action.W.value


@kernel
def sail(state, rules, waypoints, close, path):
    """Steer from waypoint to waypoint, and write the position before each step and after the last to `path`."""
    target = 0
    for now in range(path.shape[0]):
        path[now, 0], path[now, 1] = state.scene.position[0], state.scene.position[1]
        dx, dy = waypoints[target, 0] - path[now, 0], waypoints[target, 1] - path[now, 1]
        if dx * dx + dy * dy < close * close and target < waypoints.shape[0] - 1:
            target += 1
        step(state, rules, steer(state, rules, waypoints[target, 0], waypoints[target, 1]))


@kernel
def hunt(state, rules, steps):
    """The reward of `steps` steps, each towards the nearest green creep."""
    total, scene = 0.0, state.scene
    for _ in range(steps):
        nearest, least = 0, -1.0
        for creep in range(scene.kinds.shape[0]):
            dx = scene.things[creep, 0] - scene.position[0]
            dy = scene.things[creep, 1] - scene.position[1]
            if scene.kinds[creep] == GREEN and (least < 0.0 or dx * dx + dy * dy < least):
                nearest, least = creep, dx * dx + dy * dy
        reward, done = step(state, rules, steer(state, rules, scene.things[nearest, 0], scene.things[nearest, 1]))
        total += reward
        if done:
            reset(state, rules)
    return total
