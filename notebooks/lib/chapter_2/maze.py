"""A maze of T-shaped units, after the one with 14 of them in which Tolman and Honzik (1930) ran their rats.

Each unit is a choice between a blind alley and the true path. The original plan (Elliott 1928) is known here only from
descriptions of its drawing, not as a list of turns, so the order of turns is ours. No learner here distinguishes left
from right or one order from another: a turn is only a label of an action.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from lib.shared.grid import MOVES
from neorl import checks

TURNS = "RLRRLRLLRLRRLL"


@dataclass(frozen=True)
class Maze:
    """A maze of T-shaped units, one after the other.

    turns: the side of each unit, "L" or "R", on which the true path continues; the blind is on the other. The path may
    not cross itself. alley: the number of places between two choice points.

    Doors close behind the animal: there is no way back to a choice point that has been left along the true path.
    Raises ValueError for anything else.
    """

    turns: str = TURNS
    alley: int = 0

    def __post_init__(self):
        checks.integer("alley", self.alley, at_least=0)
        if not self.turns or set(self.turns) - set("LR") or len({*map(tuple, self._path)}) < len(self._path):
            raise ValueError(f"turns is {self.turns!r}, allowed are L and R on a way that does not cross itself")

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
        """The states at which the animal chooses, one per unit: int64 (units,)."""
        return (self.alley + 1) * np.arange(1, len(self.turns) + 1)

    @property
    def blinds(self):
        """The states of the blind alleys: int64 (units,)."""
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


def random_maze(rng, units=14, alley=0):
    """A `Maze` with random turns, uniform over the paths of ``units`` units that do not cross themselves.

    rng: a `numpy.random.Generator`, or the seed of one.
    """
    rng = np.random.default_rng(rng)
    while True:
        try:
            return Maze("".join(rng.choice(["L", "R"], units)), alley)
        except ValueError:
            continue
