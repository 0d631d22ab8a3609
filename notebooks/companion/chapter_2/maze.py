"""Latent learning: the experiment of Tolman and Honzik (1930), with simulated learners in place of rats.

An animal runs a maze of T-shaped units once a day, and every entry into a blind is an error. The original plan (Elliott
1928) is known here only from descriptions of its drawing, not as a list of turns, so the order of turns is ours.

Groups differ only in when there is food in the goal box: throughout, never, or from some day on. Three kinds of animal
run the maze:

1. *neoRL* is an `Agent`. It learns from every transition how to reach every place (thesis eq. 4.8), and desires the
   goal box once it has found food there. The event of a transition is the action that caused it; a bump into a wall or
   a closed door changes no cell, so nothing is learned from it. Without a desire all actions have the same value.
2. *Q-learning* (Watkins 1989) learns the reward that its actions lead to, and nothing as long as there is none.
3. *Sarsa(λ)* (Sutton and Barto 2018, section 12.7) has replacing eligibility traces, so that one reward updates the
   whole path that led to it; among actions of equal value it prefers the one that it has tried least.

All perceive the same places, have the same four actions, and take a random one with probability ε. None distinguishes
left from right or one order of turns from another: a turn is only a label of an action.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from companion.shared.grid import MOVES
from companion.shared.tabular import Rates, exploring_action, greedy_action, learn_q
from neorl import Actions, Agent, Desire, Learning, Node, Policy, Scene, kernel
from neorl.custom import ABSENT, Axis, Modality, execute
from neorl.agents.embodiment import embodied, loop_of
from neorl.agents.learner import Surroundings
from neorl.common import checks
from neorl.core.building import with_values
from neorl.core.functions import Loop
from neorl.core.layout import Memory
from neorl.core.layout import Record as AgentRecord
from neorl.core.stream import new_stream
from neorl.kernels.annotations import array, new_tuple
from neorl.statistics import Estimate, difference, estimate

LEARNERS = ("neoRL", "Q-learning", "Sarsa(λ)")
GROUPS = ("throughout", "never", "delayed")
DAYS = 17
LONGEST_TRIAL = 5_000  # steps, after which a lost animal is taken out; a random walk through 14 units takes about 110
LEVEL = 0.1  # groups are level if they differ by less than this share of the effect of food
LEAST = -1e300
# What a neoRL animal knows of the maze: that there are places in a row, and that there may be food.
KNOWN = Surroundings(1, ("food",), Actions(("N", "S", "E", "W"), [(0,)] * 4), size=1.0, fps=1.0)
TURNS = "RLRRLRLLRLRRLL"


@dataclass(frozen=True)
class Maze:
    """A maze of T-shaped units, one after the other.

    turns: the side of each unit, "L" or "R", on which the true path continues; the blind is on the other. The path may
    not cross itself, which raises ValueError. alley: the number of places between two choice points.

    Doors close behind the animal: there is no way back to a choice point that has been left along the true path.
    """

    turns: str = TURNS
    alley: int = 0

    def __post_init__(self):
        if not self.turns or set(self.turns) - set("LR") or len({*map(tuple, self._path)}) < len(self._path):
            raise checks.error("turns", "L and R, on a way that does not cross itself", self.turns)

    @cached_property
    def _headings(self):
        """The direction of each stretch of the true path, as (x, y): from the start, then out of each unit."""
        headings = [MOVES[0]]
        for turn in self.turns:
            x, y = headings[-1]
            headings.append(np.array((y, -x) if turn == "L" else (-y, x)))
        return headings

    @cached_property
    def _path(self):
        steps = np.repeat(self._headings, self.alley + 1, axis=0)
        return np.concatenate([[(0, 0)], np.cumsum(steps, axis=0)])

    @property
    def goal(self):
        """The state of the goal box. States are numbered along the true path from the start, 0; the blinds follow."""
        return len(self._path) - 1

    @property
    def choice_points(self):
        """The states at which the animal chooses: int64 (units,)."""
        return (self.alley + 1) * np.arange(1, len(self.turns) + 1)

    @property
    def blinds(self):
        """The states of the blind alleys, one per unit: int64 (units,)."""
        return self.goal + 1 + np.arange(len(self.turns))

    @property
    def states(self):
        """The number of states."""
        return self.goal + 1 + len(self.turns)

    @cached_property
    def places(self):
        """The position of each state, y downward: float64 (states, 2); blinds end short of the next choice point."""
        return np.concatenate([self._path, self._path[self.choice_points] - 0.55 * np.array(self._headings[1:])])

    @cached_property
    def next_state(self):
        """The next state after each action: int64 (states, 4). A wall or a closed door leaves the animal in place."""
        leads = np.tile(np.arange(self.states)[:, None], 4)
        doors = set(self.choice_points.tolist())
        for state, move in enumerate(np.diff(self._path, axis=0)):
            leads[state, _action(move)] = state + 1
            if state not in doors:
                leads[state + 1, _action(-move)] = state
        for choice, blind, heading in zip(self.choice_points, self.blinds, self._headings[1:]):
            leads[choice, _action(-heading)] = blind
            leads[blind, _action(heading)] = choice
        return leads


def _action(move):
    return int(np.flatnonzero((MOVES == move).all(axis=1))[0])


def random_maze(seed):
    """A `Maze` of 14 units with random turns, uniform over the paths that do not cross themselves."""
    rng = np.random.default_rng(seed)
    while True:
        try:
            return Maze("".join(rng.choice(["L", "R"], len(TURNS))))
        except ValueError:
            continue


@dataclass(frozen=True)
class Animal:
    """How an animal learns and explores.

    learner: one of `LEARNERS`. learning_rate α, discount γ, exploration ε, trace λ (of Sarsa(λ) only): from 0 to 1,
    otherwise ValueError is raised.
    """

    learner: str = "neoRL"
    learning_rate: float = 0.1
    discount: float = 0.9
    exploration: float = 0.1
    trace: float = 0.9

    def __post_init__(self):
        for name in ("learning_rate", "discount", "exploration", "trace"):
            checks.real(name, getattr(self, name), 0, 1)


# What demonstration H1 is about: {kind of animal: {group: (animal, maze, first meal)}}.
OF_BOOK = {kind: {group: (Animal(kind), Maze(), first_meal)
                  for group, first_meal in zip(GROUPS, (1, DAYS + 1, 11))} for kind in LEARNERS}


class Record(NamedTuple):
    """The errors and the knowledge of the animals of a group."""

    errors: np.ndarray  # int64 (runs, days), entries into blinds
    known: np.ndarray  # float64 (runs, days), the share of choice points known in the evening, see `_known`
    ran: tuple  # (animal, maze, first_meal), as given to `simulate`


def simulate(animal, maze, first_meal, runs, seed=0, group=0):
    """A group of animals, which find food in the goal box from the day `first_meal` on: a `Record`.

    Animals have random streams of their own, which depend on the number of their `group` and not on their kind.
    """
    errors = np.zeros((runs, DAYS), np.int64)
    known = np.zeros((runs, DAYS))
    for run in range(runs):
        stream = new_stream(np.random.SeedSequence(seed, spawn_key=(run, group)))
        for day, (errors[run, day], worth) in enumerate(run_days(animal, maze, first_meal, stream)):
            known[run, day] = _known(maze, worth[maze.choice_points])
    return Record(errors, known, (animal, maze, first_meal))


def _known(maze, worth):
    """The share of choice points where the one best action is the true one. worth: action values there, (units, 4)."""
    best = worth.argmax(axis=1)
    alone = (worth == worth.max(axis=1, keepdims=True)).sum(axis=1) == 1
    return np.mean(alone & (maze.next_state[maze.choice_points, best] == maze.choice_points + 1))


def run_days(animal, maze, first_meal, stream):
    """For each day in turn, an animal's errors and its values of actions for reaching the goal box, (states, 4)."""
    if animal.learner == "neoRL":
        agent = neorl_animal(animal, maze)
        record, memory = embodied(agent, KNOWN)
        record["stream"], memory = stream, with_values(record, memory)
        scene = new_tuple(Scene, {"axes": 1, "things": 1}, {"things": np.array([[maze.goal + 0.5]]),
                                                            "kinds": np.array([ABSENT])})
        day = _agents_day, record, memory, scene, loop_of(agent)
        worth = memory.q.reshape(maze.states, 4, maze.states)[:, :, maze.goal]
    else:
        rates = Rates(animal.learning_rate, animal.discount, animal.exploration)
        rival = new_tuple(Rival, {"states": maze.states}, {})
        day = _rivals_day, animal.learner == "Sarsa(λ)", rates, animal.trace, stream, rival
        worth = rival.q
    for number in range(1, DAYS + 1):
        yield execute(*day, maze.next_state, maze.goal, number >= first_meal), worth


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


def findings(groups, first_meal):
    """The findings of Tolman and Honzik (1930), tested on {group: `Record`} of one kind of animal: {name: `Finding`}.

    The statistics are differences in errors per day: the last three days less the first three, a day less the day
    before, or one group less another. Two groups are level if the interval of their difference stays within a tenth of
    the effect of food, which is "never" less "throughout", over the days after ``first_meal``.
    """
    errors = {group: groups[group].errors for group in GROUPS}
    before = {group: each[:, :first_meal].mean(axis=1) for group, each in errors.items()}
    after = {group: each[:, first_meal:].mean(axis=1) for group, each in errors.items()}
    next_day = {group: each[:, first_meal] for group, each in errors.items()}
    worth = estimate(difference, after["never"], after["throughout"])
    level = LEVEL * worth.value
    fall, decline = (estimate(np.mean, errors[group][:, -3:].mean(axis=1) - errors[group][:, :3].mean(axis=1))
                     for group in ("throughout", "never"))
    apart = estimate(difference, before["delayed"], before["never"])
    drop = estimate(np.mean, next_day["delayed"] - errors["delayed"][:, first_meal - 1])
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


@kernel
def _agents_day(agent: AgentRecord, memory: Memory, scene: Scene, loop: Loop, next_state, goal, fed):
    """Run an agent through the maze once, and return its errors. fed: whether there is food."""
    place, errors = 0, 0
    scene.position[0] = 0.5
    loop.begin(agent, memory, scene, loop.functions)
    for _ in range(LONGEST_TRIAL):
        place_tm1 = place
        place = next_state[place_tm1, loop.act(agent, memory, scene, loop.functions)]
        errors += place > goal and place != place_tm1
        scene.position[0] = place + 0.5
        loop.observe(agent, memory, scene, loop.functions)
        if place == goal:
            break
    if place == goal and fed:
        scene.kinds[0] = 0  # from now on the animal knows where the food is
    return errors


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
