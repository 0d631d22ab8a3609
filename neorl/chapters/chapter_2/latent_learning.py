"""Latent learning: the experiment of Tolman and Honzik (1930), with learners for rats.

An animal runs a maze once a day, and every entry into a blind is an error. Three groups differ only in when there is
food in the goal box: throughout, never, or from day 11 on. Three kinds of animal run it:

1. *neoRL* learns how to reach every place from all that happens, by the Horde's rule (`neorl.core.horde`; thesis eq.
   4.8), and wants the goal box once it has met food there. The event of a transition is the action that made it; a bump
   into a wall or a closed door changes no cell and teaches nothing. Without a wish every action is as good as any
   other.
2. *Q-learning* (Watkins 1989) learns what its actions bring, and nothing where they bring nothing.
3. *Sarsa(λ)* (Sutton and Barto 2018, section 12.7) has replacing eligibility traces, so that one reward teaches all of
   the way that led to it, and prefers, among actions of equal value, the one that it has tried least.

All see the same places, have the same four actions, and draw any of them with probability ε.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from neorl import checks
from neorl.chapters.chapter_2.maze import Maze
from neorl.chapters.shared.tabular import Rates, exploring_action, learn_q
from neorl.core.kernel import execute, kernel
from neorl.core.learning import MapValues, Rule, learn_all_goals
from neorl.core.stream import new_stream
from neorl.evidence.rules_chapters import judge_latent_learning
from neorl.evidence.statistics import Estimate, difference, estimate

LEARNERS = ("neoRL", "Q-learning", "Sarsa(λ)")
NEORL, Q_LEARNING, SARSA = range(3)
GROUPS = ("throughout", "never", "delayed")
DAYS, FIRST_REWARD = 17, 11
LONGEST_TRIAL = 5_000  # steps, after which who is lost is taken out; a random walk through 14 units takes about 110
LEVEL = 0.1  # groups are on one level if they differ by less than this share of what food makes of a difference
LEAST = -1e300


@dataclass(frozen=True)
class Animal:
    """How an animal learns and explores.

    learner: one of ``LEARNERS``. learning_rate α, discount γ, exploration ε, trace λ (of Sarsa(λ) only): from 0 to 1.
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
    """What the animals of a group did and knew.

    errors: int64 (runs, days), entries into blinds. known: float64 (runs, days), the share of choice points at which,
    when the day is over, the one best action is the true one, to an animal that wants to be in the goal box.
    """

    errors: np.ndarray
    known: np.ndarray


def simulate_groups(animal, maze, runs, seed=0, first_reward=FIRST_REWARD):
    """The three groups of the experiment: {group: `Record`} for "throughout", "never" and "delayed".

    runs: animals a group, each with its own stream, whatever its kind. first_reward: the day from which the delayed
    group finds food, from 1 on. Raises ValueError for anything else.
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
    errors, known = np.zeros((runs, DAYS), np.int64), np.zeros((runs, DAYS), np.int64)
    rates = Rates(animal.learning_rate, animal.discount, animal.exploration)
    table = MazeArrays(maze.next_state, maze.goal, maze.choice_points)
    for run in range(runs):
        stream = new_stream(np.random.SeedSequence(seed, spawn_key=(run, group)))
        execute(_live, LEARNERS.index(animal.learner), rates, animal.trace, table, first_reward,
                new_state(maze.states), stream, errors[run], known[run])
    return Record(errors, known / len(maze.turns))


class Finding(NamedTuple):
    """One of the original's findings, the number that tells with its interval, and whether it is found here."""

    text: str
    here: Estimate
    holds: bool


def findings(groups, first_reward=FIRST_REWARD):
    """What Tolman and Honzik (1930) found, put to {group: `Record`} of one kind of animal: {name: `Finding`}.

    The numbers are differences in errors a day: of the last three days to the first three, of a day to the day before,
    and of a group to another. Two groups are on one level where the interval of their difference keeps to a tenth of
    what food makes of a difference, which is never less throughout, over the days after ``first_reward``.
    first_reward: the day of the delayed group's first meal. Raises ValueError unless that is a day, and not the last.
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
        "worth": Finding("The never fed make more than those fed throughout", worth, worth.low > 0),
        "never": Finding("Never fed, errors fall a little", decline, decline.high < 0),
        "before": Finding("Up to its first meal the delayed group runs as the never fed", apart,
                          max(-apart.low, apart.high) <= level),
        "drop": Finding("The day after, its errors drop", drop, drop.high < 0),
        "level": Finding("to the level of those fed throughout", beyond, beyond.high <= level),
        "below": Finding("and below it, over all days that are left", lead, lead.high < 0),
        "one meal": Finding("One meal takes it further than it took those fed throughout", saved, saved.high < 0),
    }


def compare_learners(by_learner):
    """The `findings` of each kind of animal: {learner: {name: `Finding`}}, from {learner: {group: `Record`}}."""
    return {learner: findings(groups) for learner, groups in by_learner.items()}


def judge(by_learner):
    """Demonstration H1, from {learner: {group: `Record`}} of all ``LEARNERS``: a `Claim`, in which neoRL is judged."""
    rivals = {learner: by_learner[learner] for learner in LEARNERS[1:]}
    return judge_latent_learning(by_learner["neoRL"], rivals, FIRST_REWARD)


class MazeArrays(NamedTuple):
    """A `Maze` as the kernel takes it."""

    next_state: np.ndarray
    goal: int
    choice_points: np.ndarray


class AnimalState(NamedTuple):
    """What changes while an animal lives."""

    horde: MapValues  # of neoRL
    rates: np.ndarray  # float32 (4,), α for the event that occurred
    q: np.ndarray  # float64 (states, 4), of the others
    traces: np.ndarray  # float64 (states, 4)
    tried: np.ndarray  # int64 (states, 4)
    value: np.ndarray  # float64 (1, 4), what the actions are worth now


def new_state(states):
    """The `AnimalState` of an animal that has never been in a maze of so many states."""
    each, every_goal = (states, 4), np.tile([0, states], (states, 1))
    horde = MapValues(np.zeros(states * 4 * states, np.float32), 0, states, 4, every_goal,
                      np.zeros(states, np.float32))
    return AnimalState(horde, np.zeros(4, np.float32), np.zeros(each), np.zeros(each), np.zeros(each, np.int64),
                       np.zeros((1, 4)))


@kernel
def _live(learner, rates, trace, maze, first_reward, animal, stream, errors, known):
    """Run the maze once a day, and count errors and what is known in `errors` and `known`, a number a day."""
    wants_food, goal = False, maze.goal
    for day in range(errors.shape[0]):
        state, ended = 0, False
        for each in range(animal.traces.size):
            animal.traces.flat[each] = 0.0
        action = _choose(learner, wants_food, state, goal, rates.exploration, animal, stream)
        for _ in range(LONGEST_TRIAL):
            state_tm1, action_tm1 = state, action
            state = maze.next_state[state_tm1, action_tm1]
            ended = state == goal
            errors[day] += state > goal and state != state_tm1
            reward = 1.0 if ended and day + 1 >= first_reward else 0.0
            if learner == SARSA:
                action = _choose(learner, wants_food, state, goal, rates.exploration, animal, stream)
                _learn_by_traces(animal, state_tm1, action_tm1, reward, state, action, ended, rates, trace)
            elif learner == Q_LEARNING:
                learn_q(animal.q, state_tm1, action_tm1, reward, state, ended, rates.learning_rate, rates.discount)
            elif state != state_tm1:
                for each in range(4):
                    animal.rates[each] = np.float32(rates.learning_rate if each == action_tm1 else 0.0)
                rule = Rule(np.float32(rates.discount), True, np.float32(0.0), False)
                learn_all_goals(animal.horde, rule, state_tm1, state, animal.rates)
            if ended:
                break
            if learner != SARSA:
                action = _choose(learner, wants_food, state, goal, rates.exploration, animal, stream)
        wants_food = wants_food or ended and day + 1 >= first_reward
        for choice in maze.choice_points:
            known[day] += _knows(learner, choice, maze.next_state, goal, animal)


@kernel
def _choose(learner, wants_food, state, goal, exploration, animal, stream):
    """An action of the animal's behaviour policy."""
    if learner != NEORL or wants_food:
        _evaluate(learner, state, goal, animal)
    else:
        for action in range(4):
            animal.value[0, action] = 0.0
    if learner == SARSA:
        best = max(max(animal.value[0, 0], animal.value[0, 1]), max(animal.value[0, 2], animal.value[0, 3]))
        for action in range(4):
            novelty = -float(animal.tried[state, action])
            animal.value[0, action] = novelty if animal.value[0, action] == best else LEAST
    action = exploring_action(animal.value, 0, exploration, stream)
    animal.tried[state, action] += 1
    return action


@kernel
def _evaluate(learner, state, goal, animal):
    """What each action is worth to an animal that wants to be in the goal box, put into `value`."""
    horde = animal.horde
    for action in range(4):
        of_goal = horde.q[(4 * state + action) * horde.cells + goal]
        animal.value[0, action] = of_goal if learner == NEORL else animal.q[state, action]


@kernel
def _knows(learner, choice, next_state, goal, animal):
    """Whether the one best action at a choice point is the true one."""
    _evaluate(learner, choice, goal, animal)
    best = 0
    for action in range(4):
        if animal.value[0, action] > animal.value[0, best]:
            best = action
    for action in range(4):
        if action != best and animal.value[0, action] == animal.value[0, best]:
            return False
    return next_state[choice, best] == choice + 1


@kernel
def _learn_by_traces(animal, state_tm1, action_tm1, reward_t, state_t, action_t, terminal, rates, trace):
    """One update of Sarsa(λ): a trace replaces all those of its state."""
    target = reward_t if terminal else reward_t + rates.discount * animal.q[state_t, action_t]
    error = target - animal.q[state_tm1, action_tm1]
    for action in range(4):
        animal.traces[state_tm1, action] = 1.0 if action == action_tm1 else 0.0
    for state in range(animal.q.shape[0]):
        for action in range(4):
            animal.q[state, action] += rates.learning_rate * error * animal.traces[state, action]
            animal.traces[state, action] *= rates.discount * trace
