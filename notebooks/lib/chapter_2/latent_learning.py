"""Latent learning: the experiment of Tolman and Honzik (1930), with simulated learners in place of rats.

An animal runs a maze once a day, and every entry into a blind is an error. Three groups differ only in when there is
food in the goal box: throughout, never, or from day 11 on. Three kinds of animal run the maze:

1. *neoRL* is an `Agent`. It learns from every transition how to reach every place (thesis eq. 4.8), and desires the
   goal box once it has found food there. The event of a transition is the action that caused it; a bump into a wall or
   a closed door changes no cell, so nothing is learned from it. Without a desire all actions have the same value.
2. *Q-learning* (Watkins 1989) learns the reward that its actions lead to, and nothing as long as there is none.
3. *Sarsa(λ)* (Sutton and Barto 2018, section 12.7) has replacing eligibility traces, so that one reward updates the
   whole path that led to it; among actions of equal value it prefers the one that it has tried least.

All perceive the same places, have the same four actions, and take a random one with probability ε.
"""

import functools
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from lib.chapter_2.maze import Maze
from lib.shared.tabular import Rates, exploring_action, greedy_action, learn_q
from neorl import checks
from neorl.agents.agent import Agent, Desire, Node
from neorl.agents.compile import compiled, constants_of
from neorl.agents.learner import Surroundings
from neorl.agents.rules import Learning, Policy
from neorl.core.kernel import array, execute, kernel, new_tuple
from neorl.core.modality import Axis, Modality
from neorl.core.scene import ABSENT, Actions, Scene
from neorl.core.state import new_state
from neorl.core.steps import steps_with
from neorl.core.stream import new_stream
from neorl.evidence.rules_chapters import judge_latent_learning
from neorl.evidence.statistics import Estimate, difference, estimate

LEARNERS = ("neoRL", "Q-learning", "Sarsa(λ)")
GROUPS = ("throughout", "never", "delayed")
DAYS, FIRST_REWARD = 17, 11
LONGEST_TRIAL = 5_000  # steps, after which a lost animal is taken out; a random walk through 14 units takes about 110
LEVEL = 0.1  # groups are level if they differ by less than this share of the effect of food
LEAST = -1e300
# What a neoRL animal knows of the maze: that there are places in a row, and that there may be food.
KNOWN = Surroundings(1, ("food",), Actions(("N", "S", "E", "W"), [(0,)] * 4), size=1.0, fps=1.0)


@dataclass(frozen=True)
class Animal:
    """How an animal learns and explores.

    learner: one of `LEARNERS`. learning_rate α, discount γ, exploration ε, trace λ (of Sarsa(λ) only): from 0 to 1.
    Raises ValueError for anything else.
    """

    learner: str = "neoRL"
    learning_rate: float = 0.1
    discount: float = 0.9
    exploration: float = 0.1
    trace: float = 0.9

    def __post_init__(self):
        checks.one_of("learner", self.learner, LEARNERS)
        for name in ("learning_rate", "discount", "exploration", "trace"):
            checks.real(name, getattr(self, name), 0, 1)


class Record(NamedTuple):
    """The errors and the knowledge of the animals of a group.

    errors: int64 (runs, days), entries into blinds. known: float64 (runs, days), the share of choice points at which,
    at the end of the day, the one best action for reaching the goal box is the true one.
    """

    errors: np.ndarray
    known: np.ndarray


def simulate_groups(animal, maze, runs, seed=0, first_reward=FIRST_REWARD):
    """The three groups of the experiment: {group: `Record`} for "throughout", "never" and "delayed".

    runs: animals per group, each with a random stream of its own, which does not depend on its kind. first_reward: the
    day from which on the delayed group finds food, ≥ 1. Raises ValueError for anything else.
    """
    checks.instance("animal", animal, Animal)
    checks.instance("maze", maze, Maze)
    checks.integer("runs", runs, at_least=1)
    checks.integer("seed", seed, at_least=0)
    checks.integer("first_reward", first_reward, at_least=1)
    first_days = dict(zip(GROUPS, (1, DAYS + 1, first_reward)))
    return {group: _simulate(animal, maze, runs, seed, number, first_days[group])
            for number, group in enumerate(GROUPS)}


def _simulate(animal, maze, runs, seed, group, first_reward):
    errors, known = np.zeros((runs, DAYS), np.int64), np.zeros((runs, DAYS))
    for run in range(runs):
        stream = new_stream(np.random.SeedSequence(seed, spawn_key=(run, group)))
        for day, (errors[run, day], worth) in enumerate(live(animal, maze, first_reward, stream)):
            known[run, day] = _known(maze, worth[maze.choice_points])
    return Record(errors, known)


def _known(maze, worth):
    """The share of choice points where the one best action is the true one. worth: action values there, (units, 4)."""
    best = worth.argmax(axis=1)
    alone = (worth == worth.max(axis=1, keepdims=True)).sum(axis=1) == 1
    return np.mean(alone & (maze.next_state[maze.choice_points, best] == maze.choice_points + 1))


def live(animal, maze, first_reward, stream):
    """For each day in turn, an animal's errors and the values of its actions for reaching the goal box.

    The values are float (states, 4). stream: of the animal's random numbers.
    """
    if animal.learner == "neoRL":
        agent = neorl_animal(animal, maze)
        parameters = compiled(agent, KNOWN)
        state = new_state(parameters, stream, KNOWN.things)
        scene = new_tuple(Scene, {"axes": 1, "things": 1}, {"things": np.array([[maze.goal + 0.5]]),
                                                            "kinds": np.array([ABSENT])})
        day = _day_of(constants_of(agent, KNOWN)), parameters, state, scene
        worth = state.values.q.reshape(maze.states, 4, maze.states)[:, :, maze.goal]
    else:
        rates = Rates(animal.learning_rate, animal.discount, animal.exploration)
        rival = new_tuple(Rival, {"states": maze.states}, {})
        day = _rivals_day, animal.learner == "Sarsa(λ)", rates, animal.trace, stream, rival
        worth = rival.q
    for number in range(1, DAYS + 1):
        yield execute(*day, maze.next_state, maze.goal, number >= first_reward), worth


def neorl_animal(animal, maze):
    """The neoRL `Agent`: place cells, one for each state of the maze, and a desire for food."""
    places = Node("places", Modality("place cell", [Axis("position", high=maze.states)]), [maze.states])
    learning = Learning(animal.learning_rate, animal.discount)
    return Agent([places], [Desire("food", "places", 1.0)], learning, Policy(animal.exploration, choose=greedy_action))


class Finding(NamedTuple):
    """A finding of the original study, its statistic here with an interval, and whether it holds here."""

    text: str
    here: Estimate
    holds: bool


def findings(groups, first_reward=FIRST_REWARD):
    """The findings of Tolman and Honzik (1930), tested on {group: `Record`} of one kind of animal: {name: `Finding`}.

    The statistics are differences in errors per day: the last three days less the first three, a day less the day
    before, or one group less another. Two groups are level if the interval of their difference stays within a tenth of
    the effect of food, which is "never" less "throughout", over the days after ``first_reward``.
    first_reward: the day of the delayed group's first meal. Raises ValueError unless it precedes the last day.
    """
    checks.integer("first_reward", first_reward, at_least=1, at_most=DAYS - 1)
    errors = {group: groups[group].errors for group in GROUPS}
    before = {group: each[:, :first_reward].mean(axis=1) for group, each in errors.items()}
    after = {group: each[:, first_reward:].mean(axis=1) for group, each in errors.items()}
    next_day = {group: each[:, first_reward] for group, each in errors.items()}
    worth = estimate(difference, after["never"], after["throughout"])
    level = LEVEL * worth.value
    fall, decline = (estimate(np.mean, errors[group][:, -3:].mean(axis=1) - errors[group][:, :3].mean(axis=1))
                     for group in ("throughout", "never"))
    apart = estimate(difference, before["delayed"], before["never"])
    drop = estimate(np.mean, next_day["delayed"] - errors["delayed"][:, first_reward - 1])
    beyond = estimate(difference, next_day["delayed"], next_day["throughout"])
    lead = estimate(difference, after["delayed"], after["throughout"])
    saved = estimate(difference, next_day["delayed"], errors["throughout"][:, 1])
    return {
        "fed": Finding("Fed throughout, errors fall", fall, fall.high < 0),
        "worth": Finding("The group never fed makes more errors than the group fed throughout", worth, worth.low > 0),
        "never": Finding("Never fed, errors fall a little", decline, decline.high < 0),
        "before": Finding("Up to its first meal the delayed group performs like the one never fed", apart,
                          max(-apart.low, apart.high) <= level),
        "drop": Finding("The day after, its errors drop", drop, drop.high < 0),
        "level": Finding("to the level of the group fed throughout", beyond, beyond.high <= level),
        "below": Finding("and below it, over all remaining days", lead, lead.high < 0),
        "one meal": Finding("One meal takes it further than it took the group fed throughout", saved, saved.high < 0),
    }


def compare_groups(maze, runs, seed=0):
    """The three groups of each kind of animal, {learner: {group: `Record`}}. Arguments as in `simulate_groups`."""
    return {learner: simulate_groups(Animal(learner), maze, runs, seed) for learner in LEARNERS}


def known_by(by_learner, group):
    """The knowledge of a group's animals at the end of each day, {learner: (animals, days)}, from `compare_groups`."""
    return {learner: groups[group].known for learner, groups in by_learner.items()}


def compare_learners(by_learner):
    """The `findings` of each kind of animal: {learner: {name: `Finding`}}, from {learner: {group: `Record`}}."""
    return {learner: findings(groups) for learner, groups in by_learner.items()}


def judge(by_learner):
    """Judge neoRL on demonstration H1, from {learner: {group: `Record`}} of all `LEARNERS`: a `Claim`."""
    rivals = {learner: by_learner[learner] for learner in LEARNERS[1:]}
    return judge_latent_learning(by_learner["neoRL"], rivals, FIRST_REWARD)


@functools.cache
def _day_of(constants):
    """The kernel that runs an agent through the maze once, and returns its errors. fed: whether there is food."""
    begin, act, observe = steps_with(constants)

    @kernel
    def live_a_day(parameters, state, scene, next_state, goal, fed):
        place, errors = 0, 0
        scene.position[0] = 0.5
        begin(parameters, state, scene)
        for _ in range(LONGEST_TRIAL):
            place_tm1 = place
            place = next_state[place_tm1, act(parameters, state, scene)]
            errors += place > goal and place != place_tm1
            scene.position[0] = place + 0.5
            observe(parameters, state, scene)
            if place == goal:
                break
        if place == goal and fed:
            scene.kinds[0] = 0  # from now on the animal knows where the food is
        return errors

    return live_a_day


class Rival(NamedTuple):
    """The state of an animal of another kind."""

    q: array("float64", "states", 4)
    traces: array("float64", "states", 4)
    tried: array("int64", "states", 4)
    value: array("float64", 4)  # by which the next action is selected


@kernel
def _rivals_day(by_traces, rates, trace, stream, animal, next_state, goal, fed):
    """Run an animal of another kind through the maze once, and return its errors. by_traces: as Sarsa(λ)."""
    state, errors = 0, 0
    animal.traces[:] = 0.0
    action = _choose(by_traces, state, rates.exploration, animal, stream)
    for _ in range(LONGEST_TRIAL):
        state_tm1, action_tm1 = state, action
        state = next_state[state_tm1, action_tm1]
        ended = state == goal
        errors += state > goal and state != state_tm1
        reward = 1.0 if ended and fed else 0.0
        if by_traces:
            action = _choose(by_traces, state, rates.exploration, animal, stream)
            _learn_by_traces(animal, state_tm1, action_tm1, reward, state, action, ended, rates, trace)
        else:
            learn_q(animal.q, state_tm1, action_tm1, reward, state, ended, rates.learning_rate, rates.discount)
        if ended:
            break
        if not by_traces:
            action = _choose(by_traces, state, rates.exploration, animal, stream)
    return errors


@kernel
def _choose(by_traces, state, exploration, animal, stream):
    """An action of the animal's behaviour policy."""
    value = animal.value
    for action in range(4):
        value[action] = animal.q[state, action]
    if by_traces:
        best = max(max(value[0], value[1]), max(value[2], value[3]))
        for action in range(4):
            value[action] = -float(animal.tried[state, action]) if value[action] == best else LEAST
    action = exploring_action(value, exploration, stream)
    animal.tried[state, action] += 1
    return action


@kernel
def _learn_by_traces(animal, state_tm1, action_tm1, reward_t, state_t, action_t, terminal, rates, trace):
    """One update of Sarsa(λ): a new trace replaces all others of its state."""
    target = reward_t if terminal else reward_t + rates.discount * animal.q[state_t, action_t]
    error = target - animal.q[state_tm1, action_tm1]
    for action in range(4):
        animal.traces[state_tm1, action] = 1.0 if action == action_tm1 else 0.0
    for state in range(animal.q.shape[0]):
        for action in range(4):
            animal.q[state, action] += rates.learning_rate * error * animal.traces[state, action]
            animal.traces[state, action] *= rates.discount * trace
