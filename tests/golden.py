"""Runs recorded to the last bit in ``golden.json``, which changes to the code must reproduce.

Each agent states all its choices, so that the record does not depend on defaults. Run as a program, this file prints
digests: ``python tests/golden.py STEPS NAME …``, or rewrites the record: ``python tests/golden.py --write``.
"""

import hashlib
import json
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

from neorl import (Agent, Contacts, Desire, Learning, Node, Place, Policy, Run, WaterWorld, brownian, forager,
                   multimodal, network_a, network_b, network_c, network_d, object_vector_cells, place_cells)
from neorl.custom import softmax
from neorl.worlds import Arena
from neorl.core import modality

RECORD = Path(__file__).parent / "golden.json"
SHORT, LONG = 200, 6_000
SEED, RUN = 7, 3
PLAIN = {"learning_rate": 0.03, "discount": 0.8, "update_on": "cell", "credit": "share", "absent_decay": 0.0,
         "terminal": True,
         "bootstrap": True, "memory": 0.0, "activity": 0.5, "absent_form": "decay"}
OF_OBJECTS = {"object_state": "object", "object_reach": 0.0, "object_beyond": "outermost", "object_centred": False}
PRIMES = (2, 3, 5, 7, 11, 13)
CHOICES = {"policy": Policy(0.02, "random"), "own_cell": "silent", "tiled_fraction": 0.5, "object_tiled_fraction": 0.5,
           "weighting": "resolution", **OF_OBJECTS}


def plain_rule(**changes):
    """The plain rule with some choices changed."""
    return Learning(**PLAIN | changes)


def learning(**changes):
    return CHOICES | {"learning": plain_rule(**changes)}


def every_modality():
    desires = [*(Desire("green", each.name, 1.0) for each in modality.MODALITIES if each.takes_places),
               Desire(Place(0.2, 0.9), "object-vector cell", -1.0), Desire((0.3, 0.3), "place cell", 0.4)]
    each = learning()
    nodes = [Node(each.name, each, [1, 4], "resolution") for each in modality.MODALITIES]
    return Agent(nodes, desires, each["learning"], each["policy"], each["own_cell"])


def seeker(**choices):
    """An agent that seeks the platform of the arena, by place cells and by object-vector cells."""
    nodes = [Node("PC", modality.PLACE_CELL, [3, 7], "cells"), Node("OVC", modality.OBJECT_VECTOR_CELL, [4], "cells")]
    return Agent(nodes, [Desire("platform", node.name, 1.0) for node in nodes], **choices)


CONTACTS = Contacts(0.65, 0.02, 15.0, 0.3, 0.3, 0.4, "avoidance", 0.0)
AFTER_STATES = Contacts(0.65, 0.02, 15.0, 0.3, 0.3, 0.4, "avoidance", 0.3, 0.25, 0)


def contact_network():
    """Contacts and cells as goals, with desires for kinds, for a place and for the desire of a node of place cells."""
    nodes = [Node("PC", modality.PLACE_CELL, [3, 7], "cells"),
             Node("OVC", modality.OBJECT_VECTOR_CELL, [4, 6], gain=0.5, goals="contacts"),
             *forager([5, 9]).nodes]
    desires = [Desire("green", "PC", 1.0), Desire("red", "OVC", -1.0), Desire("green", "OVC", "learned"),
               Desire("PC", "OVC × V"), Desire(Place(0.2, 0.9), "OVC × V", 0.1), Desire("red", "OVC × V", "learned")]
    return Agent(nodes, desires, plain_rule(), Policy(0.05, "random"),
                 contacts=Contacts(1.3, 0.1, 3.0, 0.1, 0.1, 1.5, "approach", 1.0))


def after_state_network():
    """After-states beside places as goals, with desires for kinds, for a place and for the desire of the places."""
    desires = [Desire("green", "PC", 1.0), Desire("green", "OVC × V", "learned"), Desire("PC", "OVC × V"),
               Desire(Place(0.2, 0.9), "OVC × V", 0.1), Desire("red", "OVC × V", "learned")]
    return Agent([Node("PC", modality.PLACE_CELL, [3, 7], "cells"), *forager([5, 9]).nodes], desires, plain_rule(),
                 Policy(0.05, "random"), contacts=replace(AFTER_STATES, lookahead=1))


RULES = {
    "happened": {"credit": "happened"}, "last": {"credit": "last"}, "absence": {"absent_decay": 0.1},
    "not terminal": {"terminal": False}, "no bootstrapping": {"bootstrap": False}, "step": {"update_on": "step"},
    "step, not terminal": {"update_on": "step", "terminal": False},
}
MEMORIES = {
    "memory, bootstrapping": {"memory": 30.0},
    "memory, discounted": {"memory": 40.0, "discount": 0.95, "bootstrap": False},
    "memory, activity": {"memory": 5.0, "credit": "activity", "activity": 0.1, "absent_decay": 0.2,
                         "absent_form": "away"},
    "memory, count": {"memory": 12.0, "credit": "count", "discount": 1.0, "bootstrap": False},
}
# A rule near the calibrated one, and readings of the state of object vectors.
CALIBRATED = {"learning_rate": 0.03, "discount": 1.0, "credit": "happened", "absent_decay": 0.9, "absent_form": "away",
              "memory": 20.0, "bootstrap": False}
STATES = {
    "self": {"object_state": "self"}, "per object": {"object_state": "per object"},
    "self, ends": {"object_state": "self", "object_beyond": "none"},
    "self, centred": {"object_state": "self", "object_centred": True},
    "object, reach": {"object_state": "object", "object_reach": 0.096},
    "object, ends, centred": {"object_state": "object", "object_beyond": "none", "object_centred": True},
}
BOOK = {"policy": Policy(0.0, "random"), "own_cell": "counts", "weighting": "cells"}
MAZE = Arena(obstacles=[(0.4, 0.3, 0.6, 0.5)], trial_seconds=15.0)
BASIN = WaterWorld(width=60, n_creeps=2, fps=50, win_reward=5.0, contact="rounded")  # so small that episodes end often
UNNOTICED, ONCE = {"resets": "unnoticed"}, {"shared_cell": "once"}
NETWORKS = {"A": network_a, "B": network_b, "C": network_c, "D": network_d}
RUNS = {
    "Brownian": (brownian(), 8),
    **{f"place N{n}": (place_cells([n], **learning()), 8) for n in (3, 7, 10, 23)},
    **{f"place, weights {by}": (place_cells([3, 7, 23], **learning() | {"weighting": by}), 8)
       for by in ("equal", "resolution", "cells")},
    "objects": (object_vector_cells(PRIMES, **learning()), 3),
    "objects N5": (object_vector_cells([5], **learning()), 3),
    "both": (multimodal(PRIMES, place_gain=1.0, **learning()), 3),
    "both, gain of place": (multimodal(PRIMES, place_gain=5.0, **learning()), 3),
    "whole board": (multimodal([3, 7], place_gain=1.0, **learning() | {"tiled_fraction": 1.0,
                                                                       "object_tiled_fraction": 1.0}), 3),
    "own cell counts": (multimodal([3, 7], place_gain=1.0, **learning() | {"own_cell": "counts"}), 3),
    "greedy": (multimodal([3, 7], place_gain=1.0, **learning() | {"policy": Policy(0.0, "random")}), 3),
    "no-op": (multimodal([3, 7], place_gain=1.0, **learning() | {"policy": Policy(0.1, "no-op")}), 3),
    **{f"network {name}": (make(PRIMES, scale=2.0, signed=False, **learning()), 3) for name, make in NETWORKS.items()},
    **{f"network {name}, signed": (make([3, 7], scale=1.0, signed=True, **learning()), 3)
       for name, make in NETWORKS.items()},
    "recursion": (network_d([3, 7], recursion=0.5, scale=1.3, signed=False, **learning()), 3),
    "every modality": (every_modality(), 4),
    **{f"place, {name}": (place_cells([4, 9], **learning(**rules)), 8) for name, rules in RULES.items()},
    **{f"both, {name}": (multimodal([4, 7], place_gain=1.0, **learning(**rules)), 3) for name, rules in RULES.items()},
    **{f"both, {name}": (multimodal([4, 7], place_gain=1.0, **learning(**rules)), 3)
       for name, rules in MEMORIES.items()},
    **{f"place N{n}, calibrated": (place_cells([n], **learning(**CALIBRATED) | BOOK), 8) for n in (10, 40)},
    **{f"network {name}, calibrated": (make([3, 7, 23], scale=30.0, signed=False,
                                            **learning(**CALIBRATED) | BOOK | STATES["self"]), 3)
       for name, make in NETWORKS.items()},
    **{f"both, {name}": (multimodal([4, 7, 13], place_gain=3.0, **learning(**CALIBRATED) | BOOK | state), 3)
       for name, state in STATES.items()},
    **{f"both, {name}, bootstrapping": (multimodal([4, 7], place_gain=3.0, **learning(memory=5.0) | BOOK | state), 3)
       for name, state in STATES.items()},
    **{f"both, {name}, resets unnoticed": (multimodal([2, 5], place_gain=3.0, **learning(
        memory=5.0, credit="activity", bootstrap=name == "object") | BOOK | UNNOTICED | {"object_state": name}), BASIN)
       for name in ("object", "self", "per object")},
    "network D, resets unnoticed": (network_d([2, 5], scale=30.0, signed=False, **learning() | UNNOTICED), BASIN),
    **{f"both, {name}, once": (multimodal([2, 5], place_gain=3.0, **learning(**CALIBRATED) | BOOK | ONCE | state), 8)
       for name, state in STATES.items()},
    "every modality, once, resets unnoticed": (replace(every_modality(), **UNNOTICED | ONCE), BASIN),
    "contacts, resets unnoticed": (replace(forager([5, 9], contacts=CONTACTS), **UNNOTICED), BASIN),
    "arena, resets unnoticed": (seeker(learning=plain_rule(), policy=Policy(0.1, "no-op"), **UNNOTICED), MAZE),
    "arena": (seeker(learning=plain_rule(), policy=Policy(0.1, "no-op")), MAZE),
    "arena, calibrated": (seeker(learning=plain_rule(**CALIBRATED), policy=Policy(0.0, "random")), MAZE),
    "softmax": (multimodal([4], place_gain=1.0, **learning(credit="activity", memory=3.0)
                           | {"policy": Policy(0.0, choose=softmax(0.2))}), 3),
    "contacts": (forager([5, 9, 15], contacts=CONTACTS), 3),
    "contacts, network": (contact_network(), 8),
    "after-states": (forager([4, 6, 9, 13], contacts=AFTER_STATES), 3),
    "after-states, looking ahead": (forager([4, 6, 9, 13], contacts=replace(AFTER_STATES, lookahead=2)), 3),
    "after-states, network": (after_state_network(), 8),
    "after-states, resets unnoticed": (replace(forager([5, 9], contacts=AFTER_STATES), **UNNOTICED), BASIN),
}
CHANGES = {
    "joined by objects": ((LONG // 3, "both"),),
    "with a memory, moved": ((LONG // 3, "both, self"), (LONG // 2, "network D, calibrated")),
    "revalued and back": ((LONG // 4, "network C"), (LONG // 2, "network D"), (3 * LONG // 4, "objects")),
    "to after-states and back": ((LONG // 3, "after-states"), (LONG // 2, "contacts"), (3 * LONG // 4, "after-states")),
}
BEFORE = {"joined by objects": "place N7", "with a memory, moved": "network C, calibrated",
          "revalued and back": "network D", "to after-states and back": "contacts"}


def world_of(name):
    """The world of the named run; a number stands for a tank with that many creeps."""
    world = RUNS[BEFORE.get(name, name)][1]
    return tank(world) if isinstance(world, int) else world


def tank(creeps):
    return WaterWorld(width=250, n_creeps=creeps, fps=50, win_reward=5.0 if creeps == 8 else 0.0, contact="rounded")


def agent_of(name):
    """The agent with which the named run begins."""
    return RUNS[BEFORE.get(name, name)][0]


def changes_of(name):
    """The changes of agent in the named run: (step, agent) pairs."""
    return tuple((step, RUNS[later][0]) for step, later in CHANGES.get(name, ()))


def born(name):
    """The named run, before its first step."""
    return Run(agent_of(name), world_of(name), SEED, RUN)


def digest(name, steps):
    """The record of a run: its reward, and a digest of every value and of the world."""
    run = born(name)
    reward = 0.0
    for step, later in changes_of(name):
        reward += run.advance(min(step, steps) - run.step)
        if step < steps:
            run.change(later)
    reward += run.advance(steps - run.step)
    return recorded(name, reward, run.agent, run.memory.q, run.world_state)


def recorded(name, reward, agent, q, state):
    """The record of a run, from its reward, its last agent, its values and the state of its world."""
    scene = state.scene
    own = ((state.inside, state.clock) if isinstance(world_of(name), Arena) else
           (state.direction, state.speed, scene.kinds == 0, state.jitter))
    arrays = (*in_order(agent, q), scene.position, scene.velocity, scene.things, *own, state.stream)
    content = b"".join(np.ascontiguousarray(each).tobytes() for each in arrays)
    return f"{float(reward)} {hashlib.sha256(content).hexdigest()}"


def in_order(agent, q):
    """The values of each map as q[state, action, goal], or as stored if its goals are contacts."""
    for node in agent.nodes:
        for each in node.maps:
            contacts, of_self = node.goals == "contacts", node.state != "object"
            events = 1 if contacts and agent.contacts.efference else 4
            one, q = np.split(q, [events * each.cells * (3 if contacts else 1 if of_self else each.cells)])
            in_place = contacts or of_self or agent.learning.bootstrap
            yield one if in_place else one.reshape(each.cells, each.cells, 4).transpose(1, 2, 0)


if __name__ == "__main__":
    if sys.argv[1:] == ["--write"]:
        record = {name: {str(steps): digest(name, steps) for steps in (SHORT, LONG)} for name in [*RUNS, *CHANGES]}
        RECORD.write_text(json.dumps(record, indent=1) + "\n")
    else:
        print(json.dumps({name: digest(name, int(sys.argv[1])) for name in sys.argv[2:]}))
