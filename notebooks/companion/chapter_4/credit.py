"""Two levers, a light and a bell: what inference inversion and temporal difference learn from one stream of events.

Chapter 4 describes the chamber. Lever, light and bell stay the same for a *bout*, then all are redrawn; a bout ends
after each step with probability 1 / ``hold``, even in the middle of a visit. With *inference inversion* (thesis eq.
4.7, 4.8) the agent learns once per visit, when its cell changes from the chamber to an exit. With *temporal difference*
(eq. 4.6) it learns after every step, and every event that occurs on a step counts as an action of that step. The stream
does not depend on what is learned, and nothing is learned about the way back.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from neorl import CALIBRATED, Learning, kernel
from neorl.custom import array, execute
from neorl.core.choices import Credit
from neorl.core.learning import UNIT, ZERO, MapValues, Order, Rule, learn_all_goals, learn_one_goal
from neorl.core.stream import randint, new_stream, uniform

ROLES = ("cause", "other lever", "light", "bell")
N_EVENTS = len(ROLES)
CELLS = 3  # the chamber, and one behind each exit
CREDITS = ("share", "happened", "count", "last")
INVERSION = Learning(learning_rate=0.03, discount=0.8, credit="share")
DIFFERENCE = replace(INVERSION, update_on="step")
# The rule of the book's agents, with the α and γ of the other two.
DEFAULT = replace(CALIBRATED, learning_rate=INVERSION.learning_rate, discount=INVERSION.discount)


class Chamber(NamedTuple):
    """A chamber with two levers.

    effort: steps for which a lever has to be pressed, ≥ 1. delay: steps from then until the exit opens.
    hold: mean length of a bout in steps, ≥ 1. light, bell: probability that it is on during a bout.
    """

    effort: int = 10
    delay: int = 0
    hold: float = 20.0
    light: float = 0.5
    bell: float = 0.1


class Learner(NamedTuple):
    """How an agent in a chamber learns, and what it has learned; arrays of events are working memory."""

    by_step: bool
    bootstrap: bool
    credit: int
    rate: np.float32
    rule: Rule
    learned: MapValues
    counts: array("int64", N_EVENTS)
    occurs: array("bool", N_EVENTS)
    rates: array("float32", N_EVENTS)


def learn_in(chamber, learning, visits, runs, seed=0):
    """Learn the values of a chamber's events for either exit: float32 (runs, visits, 4, 2), after each visit.

    The four events are the levers of the two exits, the light and the bell.
    Run k is the same for any number of runs, and has the same stream of events under any ``learning``.
    """
    values = np.zeros((runs, visits, N_EVENTS, 2), np.float32)
    by_step, rate = learning.update_on == "step", np.float32(learning.learning_rate)
    absent_rate = ZERO if by_step else rate * np.float32(learning.absent_decay)
    rule = Rule(np.float32(learning.discount), learning.terminal, absent_rate, learning.absent_form == "away")
    chamber = chamber._replace(hold=float(chamber.hold))
    for run in range(runs):
        learned = MapValues(np.zeros(CELLS * N_EVENTS * CELLS, np.float32), 0, CELLS, N_EVENTS,
                            np.tile([0, CELLS], (CELLS, 1)), np.zeros(CELLS, np.float32))
        learner = Learner(by_step, learning.bootstrap, int(Credit[learning.credit]), rate, rule, learned,
                          *(np.zeros(N_EVENTS, kind) for kind in (np.int64, np.bool_, np.float32)))
        execute(_run_in, chamber, learner, new_stream(np.random.SeedSequence(seed, spawn_key=(run,))), values[run])
    return values


def by_role(values):
    """Values by the role of an event for an exit, see `ROLES`: float32 (…, 4)."""
    cause = values[..., 0, 0] + values[..., 1, 1]
    other = values[..., 1, 0] + values[..., 0, 1]
    return np.stack([cause, other, values[..., 2, :].sum(axis=-1), values[..., 3, :].sum(axis=-1)], axis=-1) / 2


def lead_of_cause(values):
    """Value of an exit's cause less that of the best other role: float32 (…)."""
    roles = by_role(values)
    return roles[..., 0] - roles[..., 1:].max(axis=-1)


@kernel
def _run_in(chamber, learner, stream, values):
    """Run a visit for each row of `values`, and store the chamber's values after it there."""
    counts, occurs, q = learner.counts, learner.occurs, learner.learned.q
    over = True
    lever = 0
    for visit in range(values.shape[0]):
        cell, opening, wait = 0, 0, chamber.delay
        for event in range(N_EVENTS):
            counts[event] = 0
        while cell == 0:
            if over:
                lever = randint(stream, 2)
                occurs[0], occurs[1] = lever == 0, lever == 1
                occurs[2], occurs[3] = uniform(stream) < chamber.light, uniform(stream) < chamber.bell
            for event in range(N_EVENTS):
                counts[event] += occurs[event]
            if opening > 0:
                wait -= 1
            elif counts[lever] >= chamber.effort:
                opening = 1 + lever
            if opening > 0 and wait == 0:
                cell = opening
            if learner.by_step:
                for event in range(N_EVENTS):
                    learner.rates[event] = learner.rate if occurs[event] else ZERO
                learn_all_goals(learner.learned, learner.rule, 0, cell, learner.rates)
            over = uniform(stream) * chamber.hold < 1.0
        if not learner.by_step:
            _learn_from_visit(learner, cell)
        for event in range(N_EVENTS):
            values[visit, event, 0], values[visit, event, 1] = q[event * CELLS + 1], q[event * CELLS + 2]


@kernel
def _learn_from_visit(learner, cell):
    """Learn from leaving the chamber through an exit into a cell."""
    steps = learner.counts[0] + learner.counts[1]  # one of the levers is pressed at every step
    for event in range(N_EVENTS):
        count = learner.counts[event]
        share = np.float32(count) / np.float32(steps)
        if learner.credit == Credit.happened:
            share = UNIT if count > 0 else ZERO
        elif learner.credit == Credit.last:
            share = UNIT if learner.occurs[event] else ZERO
        elif learner.credit == Credit.count:
            share = np.float32(count)
        learner.rates[event] = min(learner.rate * share, UNIT)
    if learner.bootstrap:
        learn_all_goals(learner.learned, learner.rule, 0, cell, learner.rates)
    else:
        order = Order(np.uint64(0), np.uint64(1), np.uint64(CELLS))
        learn_one_goal(learner.learned, order, learner.rule, 0, cell, learner.rates)
