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
"""

import numpy as np

from lib.alternatives.living import Contestant
from lib.alternatives.sight import (ACTIONS, nearest_cells, new_memory, object_cell, place_cell,
                                               velocity_cell)
from lib.shared.tabular import exploring_action, learn_q
from neorl.core.kernel import inlined_kernel, kernel
from neorl.worlds.waterworld import GREEN

HASHED_BITS = 20
HASH, SHIFT = np.uint64(0x9E3779B97F4A7C15), np.uint64(64 - HASHED_BITS)  # Fibonacci hashing
POLICIES, FEATURES = 3, 2
WORTH_RATE = 0.1  # learning rate of the worth of a contact


def monolithic(setting):
    """The `Contestant` that treats the whole scene as one state."""
    return Contestant(act_monolithic, learn_monolithic, setting, lambda world, stream: new_memory(
        world, stream, 2**HASHED_BITS, ACTIONS, setting.first))


def joint_cells(setting):
    """The `Contestant` whose state is the cells of the nearest creep of either kind and of its own velocity."""
    return Contestant(act_joint, learn_joint, setting, lambda world, stream: new_memory(
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
def monolithic_row(setting, codes, scene, width):
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
def joint_row(setting, scene, width):
    return (nearest_cells(setting, scene, width) * setting.speeds * setting.speeds
            + velocity_cell(setting, scene, width))


@inlined_kernel
def head_row(setting, scene, width, thing):
    row = scene.kinds[thing] * setting.cells * setting.cells + object_cell(setting, scene, width, thing)
    return row * setting.speeds * setting.speeds + velocity_cell(setting, scene, width)


@kernel
def act_monolithic(setting, memory, state, rules):
    """ε-greedy in the state of the whole scene."""
    memory.rows[0] = monolithic_row(setting, memory.codes, state.scene, rules.width)
    return exploring_action(memory.table[memory.rows[0]], setting.exploration, memory.stream)


@kernel
def learn_monolithic(setting, memory, state, rules, action, reward, restarted):
    """One Q-learning update of the state before the step."""
    row_t = monolithic_row(setting, memory.codes, state.scene, rules.width)
    learn_q(memory.table, memory.rows[0], action, reward, row_t, False, setting.learning_rate, setting.discount)


@kernel
def act_joint(setting, memory, state, rules):
    """ε-greedy in the state of the nearest creeps."""
    memory.rows[0] = joint_row(setting, state.scene, rules.width)
    return exploring_action(memory.table[memory.rows[0]], setting.exploration, memory.stream)


@kernel
def learn_joint(setting, memory, state, rules, action, reward, restarted):
    """One Q-learning update of the state before the step."""
    learn_q(memory.table, memory.rows[0], action, reward, joint_row(setting, state.scene, rules.width), False,
            setting.learning_rate, setting.discount)


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
    row = joint_row(setting, state.scene, rules.width)
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
    row_t = joint_row(setting, state.scene, rules.width)
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
