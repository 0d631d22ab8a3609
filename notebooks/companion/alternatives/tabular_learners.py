"""Tabular alternatives to the thesis's agents, all ε-greedy, by one-step Q-learning at every step (Watkins 1989).

1. *monolithic*: one learner whose state is the whole scene: the cells of the agent's position and velocity, and the
   kind and relative cell of every creep, in no order. Its many states share the rows of a hash table.
2. *joint cells*: one learner whose state is a hand-made abstraction: the cells of the nearest green creep, of the
   nearest red one, and of the velocity.
3. *hybrid reward*: a head for each creep, whose reward is the contact with it and whose state is its cell and the
   velocity. Heads of one kind share a table, an action's value is the sum over heads, and each head bootstraps from its
   own greedy action (van Seijen et al. 2017, Hybrid reward architecture for reinforcement learning).
4. *successor features*: the discounted numbers of future contacts of either kind under three policies, which seek green
   creeps, avoid red ones, and do both, in the states of *joint cells*. The agent takes the action that is best under
   any of them, at the learned worth of contacts: generalised policy improvement (Barreto et al. 2017, Successor
   features for transfer in reinforcement learning).

A `Setting` has the number of cells along each axis of a creep's position relative to the agent, their reach to either
side, and whether they are equally wide or grow with distance; and the number and width of the cells along each axis of
the agent's velocity. The outermost cells include everything beyond.
"""

import math
from typing import NamedTuple

import numpy as np

from companion.alternatives.contests import Contestant
from companion.shared.tabular import exploring_action, learn_q
from neorl.kernels.annotations import array
from neorl.kernels.kernel import inlined_kernel, kernel
from neorl.worlds.waterworld import GREEN, RED

ACTIONS = 5  # N, S, E, W and no-op
HASHED_BITS = 20
HASH, SHIFT = np.uint64(0x9E3779B97F4A7C15), np.uint64(64 - HASHED_BITS)  # Fibonacci hashing
POLICIES, FEATURES = 3, 2
WORTH_RATE = 0.1  # learning rate of the worth of a contact


class Setting(NamedTuple):
    """Parameters of a tabular learner."""

    cells: int  # along each axis of a creep's position relative to the agent
    reach: float  # board widths to either side
    warped: bool  # cells grow with distance
    speeds: int  # cells along each axis of the velocity
    speed_width: float  # of such a cell, in board widths per second
    places: int  # cells along each axis of the agent's position on the board
    learning_rate: float  # α
    discount: float  # γ per step
    exploration: float  # ε
    first: float  # initial value of every action


class Memory(NamedTuple):
    """The mutable state of a tabular learner."""

    table: array("float64", "rows", "columns")
    rows: array("int64", "things")  # of the table, before the step; only the first where there is one state
    codes: array("int64", "things")  # scratch space
    value: array("float64", ACTIONS)
    weights: array("float64", 2)  # worth of a contact of each kind, where that is learned
    stream: array("uint64", 4)


def new_memory(world, stream, rows, columns, first):
    """A `Memory` before learning, with a table of (rows, columns) that all have the value `first`."""
    things = world.things
    return Memory(np.full((rows, columns), first), np.zeros(things, int), np.zeros(things, int), np.zeros(ACTIONS),
                  np.zeros(2), stream)


@inlined_kernel
def object_cell(setting, scene, width, thing):
    """The cell of a thing's position relative to the agent, below cells²."""
    cell = 0
    for axis in range(2):
        offset = (scene.things[thing, axis] - scene.position[axis]) / (width * setting.reach)
        share = min(abs(offset), 1.0)
        if setting.warped:
            share = math.sqrt(share)
        share = 0.5 + (0.5 * share if offset >= 0.0 else -0.5 * share)
        cell = cell * setting.cells + min(int(share * setting.cells), setting.cells - 1)
    return cell


@inlined_kernel
def velocity_cell(setting, scene, width):
    """The cell of the agent's velocity, below speeds²."""
    cell = 0
    for axis in range(2):
        at = np.floor(scene.velocity[axis] / (width * setting.speed_width) + 0.5 * setting.speeds)
        cell = cell * setting.speeds + int(min(max(at, 0.0), setting.speeds - 1.0))
    return cell


@inlined_kernel
def place_cell(setting, scene, width):
    """The cell of the agent's position on the board, below places²."""
    cell = 0
    for axis in range(2):
        cell = cell * setting.places + min(int(scene.position[axis] / width * setting.places), setting.places - 1)
    return cell


@inlined_kernel
def nearest_cells(setting, scene, width):
    """The cells of the nearest green creep and the nearest red one as one number, below (cells² + 1)²."""
    none = setting.cells * setting.cells
    green, red = nearest(scene, GREEN, 0.0), nearest(scene, RED, 0.0)
    green = object_cell(setting, scene, width, green) if green >= 0 else none
    red = object_cell(setting, scene, width, red) if red >= 0 else none
    return green * (none + 1) + red


@inlined_kernel
def nearest(scene, kind, seconds):
    """The creep of a kind that is nearest to where the agent's velocity carries it in some seconds, or −1."""
    found, least = -1, np.inf
    for thing in range(scene.kinds.shape[0]):
        if scene.kinds[thing] == kind:
            dx = scene.things[thing, 0] - scene.position[0] - seconds * scene.velocity[0]
            dy = scene.things[thing, 1] - scene.position[1] - seconds * scene.velocity[1]
            if dx * dx + dy * dy < least:
                found, least = thing, dx * dx + dy * dy
    return found


def monolithic(setting):
    """The `Contestant` that treats the whole scene as one state."""
    return Contestant(*MONOLITHIC, setting, lambda world, stream: new_memory(
        world, stream, 2**HASHED_BITS, ACTIONS, setting.first))


def joint_cells(setting):
    """The `Contestant` whose state is the cells of the nearest creep of either kind and of its own velocity."""
    return Contestant(*JOINT, setting, lambda world, stream: new_memory(
        world, stream, _joint_rows(setting), ACTIONS, setting.first))


def hybrid_reward(setting):
    """The `Contestant` with a head for each creep."""
    rows = 2 * (setting.cells * setting.speeds) ** 2
    return Contestant(act_heads, learn_heads, setting, lambda world, stream: new_memory(
        world, stream, rows, ACTIONS, setting.first))


def successor_features(setting):
    """The `Contestant` with successor features of three policies."""

    def memory(world, stream):
        made = new_memory(world, stream, _joint_rows(setting), POLICIES * ACTIONS * FEATURES, 0.0)
        made.table[:, GREEN::FEATURES] = setting.first
        return made

    return Contestant(act_features, learn_features, setting, memory)


TABULAR = {"monolithic": monolithic, "joint cells": joint_cells, "hybrid reward": hybrid_reward,
           "successor features": successor_features}


def _joint_rows(setting):
    return (setting.cells**2 + 1) ** 2 * setting.speeds**2


@inlined_kernel
def monolithic_row(setting, memory, scene, width):
    codes = memory.codes
    for thing in range(codes.shape[0]):
        code = object_cell(setting, scene, width, thing) * 2 + scene.kinds[thing]
        at = thing
        while at > 0 and codes[at - 1] > code:
            codes[at] = codes[at - 1]
            at -= 1
        codes[at] = code
    key = place_cell(setting, scene, width) * setting.speeds * setting.speeds + velocity_cell(setting, scene, width)
    for thing in range(codes.shape[0]):
        key = key * setting.cells * setting.cells * 2 + codes[thing]
    return int((np.uint64(key) * HASH) >> SHIFT)


@inlined_kernel
def joint_row(setting, memory, scene, width):
    return (nearest_cells(setting, scene, width) * setting.speeds * setting.speeds
            + velocity_cell(setting, scene, width))


@inlined_kernel
def head_row(setting, scene, width, thing):
    row = scene.kinds[thing] * setting.cells * setting.cells + object_cell(setting, scene, width, thing)
    return row * setting.speeds * setting.speeds + velocity_cell(setting, scene, width)


def one_learner(row_of):
    """The kernels, act and learn, of Q-learning in the state of which `row_of` gives the row of the table."""

    @kernel
    def act(setting, memory, state, rules):
        memory.rows[0] = row_of(setting, memory, state.scene, rules.width)
        return exploring_action(memory.table[memory.rows[0]], setting.exploration, memory.stream)

    @kernel
    def learn(setting, memory, state, rules, action, reward, restarted):
        row_t = row_of(setting, memory, state.scene, rules.width)
        learn_q(memory.table, memory.rows[0], action, reward, row_t, False, setting.learning_rate, setting.discount)

    return act, learn


MONOLITHIC, JOINT = one_learner(monolithic_row), one_learner(joint_row)


@kernel
def act_heads(setting, memory, state, rules):
    """ε-greedy on the sum over heads."""
    for action in range(ACTIONS):
        memory.value[action] = 0.0
    for thing in range(memory.rows.shape[0]):
        row = head_row(setting, state.scene, rules.width, thing)
        memory.rows[thing] = row
        for action in range(ACTIONS):
            memory.value[action] += memory.table[row, action]
    return exploring_action(memory.value, setting.exploration, memory.stream)


@kernel
def learn_heads(setting, memory, state, rules, action, reward, restarted):
    """One update of each head: a contact is terminal; from a reset board the other heads learn nothing."""
    scene = state.scene
    for thing in range(memory.rows.shape[0]):
        met = scene.met[thing]
        if met > 0:
            learn_q(memory.table, memory.rows[thing], action, 1.0 if met - 1 == GREEN else -1.0, 0, True,
                    setting.learning_rate, setting.discount)
        elif not restarted:
            learn_q(memory.table, memory.rows[thing], action, 0.0, head_row(setting, scene, rules.width, thing), False,
                    setting.learning_rate, setting.discount)


@inlined_kernel
def worth(memory, row, policy, action, green, red):
    """The value of an action by its successor features, at a worth of green and of red contacts."""
    at = (policy * ACTIONS + action) * FEATURES
    return green * memory.table[row, at] + red * memory.table[row, at + 1]


@kernel
def act_features(setting, memory, state, rules):
    """ε-greedy by generalised policy improvement."""
    row = joint_row(setting, memory, state.scene, rules.width)
    memory.rows[0] = row
    for action in range(ACTIONS):
        memory.value[action] = -np.inf
        for policy in range(POLICIES):
            memory.value[action] = max(memory.value[action], worth(memory, row, policy, action, memory.weights[0],
                                                                   memory.weights[1]))
    return exploring_action(memory.value, setting.exploration, memory.stream)


@kernel
def learn_features(setting, memory, state, rules, action, reward, restarted):
    """One update of the features of each policy, with its own greedy action, and of the worth of contacts."""
    met = memory.codes
    green_t, red_t = 0.0, 0.0
    for thing in range(met.shape[0]):
        green_t += state.scene.met[thing] == 1 + GREEN
        red_t += state.scene.met[thing] > 1 + GREEN
    error = WORTH_RATE * (reward - memory.weights[0] * green_t - memory.weights[1] * red_t)
    memory.weights[0] += error * green_t
    memory.weights[1] += error * red_t
    row_t = joint_row(setting, memory, state.scene, rules.width)
    for policy in range(POLICIES):
        green, red = 0.0 if policy == 1 else 1.0, 0.0 if policy == 0 else -1.0
        best = 0
        for other in range(1, ACTIONS):
            if worth(memory, row_t, policy, other, green, red) > worth(memory, row_t, policy, best, green, red):
                best = other
        for feature in range(FEATURES):
            seen = green_t if feature == GREEN else red_t
            target = seen + setting.discount * memory.table[row_t, (policy * ACTIONS + best) * FEATURES + feature]
            at = (policy * ACTIONS + action) * FEATURES + feature
            memory.table[memory.rows[0], at] += setting.learning_rate * (target - memory.table[memory.rows[0], at])
