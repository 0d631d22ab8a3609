"""Separation of concerns: a small game of fruits and a ghost, learned by one learner or by many (thesis section 3.3).

The game, after Ms. Pac-Man. Fruits lie at some of a few places, drawn for each game. A fruit pays 1. The ghost moves
after the agent: with probability ``chase`` a step along a shortest path to it, else in a random direction. Being caught
costs 10. A game ends when all fruits are eaten, when the agent is caught, or after ``limit`` steps.

The learners, all by Q-learning (van Seijen et al. 2017, Hybrid reward architecture for reinforcement learning):

1. *one learner*: its state is that of the whole game: the agent's cell, the ghost's, and which fruits are left.
2. *heads*: a head for each place, whose state is the agent's cell and whose reward is the fruit there; and a head for
   the ghost, whose state is both cells and whose reward is the −10 for being caught. The value of an action is the sum
   over the ghost's head and the heads of the places that hold a fruit. A head learns while its fruit is there.
3. *latent heads*: the same, but the head of a place learns at every step how to get there, fruit or no fruit: a general
   value function per place (thesis section 4.1.3), with the fruits as elements of interest.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from scipy.sparse import csgraph

from companion.shared.grid import Grid
from companion.shared.runs import each_run
from companion.shared.tabular import Rates, exploring_action, learn_q
from neorl.core.stream import randint, new_stream, uniform
from neorl import kernel
from neorl.custom import execute

KINDS = ("one learner", "heads", "latent heads")
ENDS = ("all eaten", "caught", "out of time")
CAUGHT = -10.0
BINS, SHARE = 21, 0.8  # each bin ends at this share of where the next one ends, so the last is the last fifth of a run
MAZE = ("o..#..o",
        ".#.g.#.",
        ".#.#.#.",
        "o.o.o.o",
        ".#.#.#.",
        ".#.a.#.",
        "o..#..o")


@dataclass(frozen=True)
class Game:
    """The game on a grid that marks the agent, "a", the ghost, "g", and places for fruits, "o"."""

    rows: tuple[str, ...] = MAZE
    fruits: int = 5
    chase: float = 0.3
    limit: int = 100

    @cached_property
    def grid(self):
        """The `Grid` that the game is played on."""
        return Grid(self.rows)

    @property
    def places(self):
        """The states where fruits may lie, as a list."""
        return self.grid.marked("o")

    def states(self, kind):
        """The number of states of a learner of a kind (one of `KINDS`), over all its heads."""
        cells, places = self.grid.states, len(self.places)
        return cells**2 * 2**places if kind == "one learner" else cells * places + cells**2


@dataclass(frozen=True)
class Learner:
    """A learner by its kind, one of `KINDS`, and the three rates of Q-learning."""

    kind: str
    learning_rate: float = 0.2
    discount: float = 0.5
    exploration: float = 0.05  # the probability of a random action instead of the best one


@dataclass(frozen=True)
class Played:
    """The results of runs of the game."""

    edges: np.ndarray  # int64 (bins + 1,), steps
    rewards: np.ndarray  # float64 (runs, bins), per 100 steps
    ends: np.ndarray  # int64 (runs, bins, 3), the number of games with each of `ENDS`
    known: np.ndarray  # int64 (runs,), states about which anything has been learned

    @property
    def final(self):
        """Reward per 100 steps in the last fifth of the run: float64 (runs,)."""
        return self.rewards[:, -1]

    def share(self, end):
        """The share of games with this end in the last fifth, over all runs. end: one of `ENDS`."""
        games = self.ends[:, -1].sum(axis=0)
        return float(games[ENDS.index(end)] / max(games.sum(), 1))


def play(game, learner, *, steps, runs, seed=0):
    """Let learners play, one game after the other: `Played`."""
    edges = np.concatenate([[0], np.round(steps * SHARE ** np.arange(BINS - 1, -1, -1))]).astype(int)
    rewards, ends, known = np.zeros((runs, BINS)), np.zeros((runs, BINS, len(ENDS)), int), np.zeros(runs, int)
    board, rates = _board(game), Rates(learner.learning_rate, learner.discount, learner.exploration)

    def play_one(run):
        q = np.zeros((game.states(learner.kind), 4))
        stream = new_stream(np.random.SeedSequence(seed, spawn_key=(run,)))
        execute(_play, board, learner.kind == "one learner", learner.kind == "latent heads", rates, edges, stream, q,
                np.zeros(4), rewards[run], ends[run])
        known[run] = np.any(q, axis=1).sum()

    each_run(play_one, runs)
    return Played(edges, rewards * 100 / np.diff(edges), ends, known)


def settled_values(grid, place, discount):
    """The values of a place's head after learning: float64 (states, 4)."""
    distance, _ = _shortest_ways(grid)
    return discount ** distance[place][grid.next_state]


class _Board(NamedTuple):
    next_state: np.ndarray  # (states, 4)
    toward: np.ndarray  # (states, states), the next state on a shortest path from one to another
    places: np.ndarray
    agent: int
    ghost: int
    fruits: int
    chase: float
    limit: int


def _board(game):
    grid = game.grid
    _, before = _shortest_ways(grid)
    toward = np.where(before < 0, np.arange(grid.states), before).T  # a ghost that has arrived stays
    return _Board(grid.next_state, np.ascontiguousarray(toward), np.array(game.places), *grid.marked("a"),
                  *grid.marked("g"), game.fruits, game.chase, game.limit)


def _shortest_ways(grid):
    """Steps from each state to each other, and the state before it on the path: (states, states) twice."""
    links = np.zeros((grid.states, grid.states))
    links[np.arange(grid.states)[:, None], grid.next_state] = 1
    return csgraph.shortest_path(links, unweighted=True, return_predecessors=True)


@kernel
def _play(board, joint, latent, rates, edges, stream, q, value, rewards, ends):
    """Play until the last edge; `value` is working memory for the sum over heads. `left` has a bit for each place."""
    states, places = board.next_state.shape[0], board.places.shape[0]
    agent_tm1, ghost_tm1, left_tm1, age = board.agent, board.ghost, _laid_out(board, stream), 0
    for part in range(rewards.shape[0]):
        for _ in range(edges[part], edges[part + 1]):
            ghost_row = (left_tm1 * states + agent_tm1 if joint else places + agent_tm1) * states + ghost_tm1
            for action in range(4):
                value[action] = q[ghost_row, action]
                if not joint:
                    for place in range(places):
                        if left_tm1 >> place & 1:
                            value[action] += q[place * states + agent_tm1, action]
            action = exploring_action(value, rates.exploration, stream)

            agent_t, left_t, ghost_t = board.next_state[agent_tm1, action], left_tm1, ghost_tm1
            fruit = 0.0
            for place in range(places):
                if board.places[place] == agent_t and left_tm1 >> place & 1:
                    left_t -= 1 << place
                    fruit = 1.0
            if agent_t != ghost_tm1:
                if uniform(stream) < board.chase:
                    ghost_t = board.toward[ghost_tm1, agent_t]
                else:
                    ghost_t = board.next_state[ghost_tm1, randint(stream, 4)]
            caught = agent_t == ghost_t
            penalty = CAUGHT if caught else 0.0
            rewards[part] += fruit + penalty

            if joint:
                learn_q(q, ghost_row, action, fruit + penalty, (left_t * states + agent_t) * states + ghost_t,
                        caught or left_t == 0, rates.learning_rate, rates.discount)
            else:
                learn_q(q, ghost_row, action, penalty, (places + agent_t) * states + ghost_t, caught,
                        rates.learning_rate, rates.discount)
                for place in range(places):
                    if latent or left_tm1 >> place & 1:
                        reached = board.places[place] == agent_t
                        learn_q(q, place * states + agent_tm1, action, 1.0 if reached else 0.0,
                                place * states + agent_t, reached, rates.learning_rate, rates.discount)

            agent_tm1, ghost_tm1, left_tm1, age = agent_t, ghost_t, left_t, age + 1
            if caught or left_t == 0 or age == board.limit:
                ends[part, 1 if caught else 0 if left_t == 0 else 2] += 1
                agent_tm1, ghost_tm1, left_tm1, age = board.agent, board.ghost, _laid_out(board, stream), 0


@kernel
def _laid_out(board, stream):
    """The places of the fruits, as bits; all sets of places are equally likely."""
    left, needed = 0, board.fruits
    for place in range(board.places.shape[0]):
        if randint(stream, board.places.shape[0] - place) < needed:
            left += 1 << place
            needed -= 1
    return left
