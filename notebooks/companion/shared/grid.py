"""Grid worlds drawn in text: a "#" is a wall, every other character a state.

The four actions are N, S, E and W, in this order as everywhere in neorl. A step into a wall or over the border leaves
the agent in place. States are numbered row by row from the upper left.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

WALL = "#"
MOVES = np.array([(0, -1), (0, 1), (1, 0), (-1, 0)])  # N, S, E, W as (x, y), y downward


@dataclass(frozen=True)
class Grid:
    """A grid world. rows: strings of equal length, from the top."""

    rows: tuple[str, ...]

    @cached_property
    def places(self):
        """The position of each state: int64 (states, 2), column and row."""
        return np.array([(x, y) for y, row in enumerate(self.rows) for x, mark in enumerate(row) if mark != WALL])

    @property
    def states(self):
        """The number of states."""
        return len(self.places)

    @cached_property
    def next_state(self):
        """The next state after each action: int64 (states, 4)."""
        state_at = {tuple(place): state for state, place in enumerate(self.places)}
        return np.array([[state_at.get(tuple(place + move), state) for move in MOVES]
                         for state, place in enumerate(self.places)])

    def marked(self, mark):
        """The states that a character marks, as a list of integers."""
        return [state for state, (x, y) in enumerate(self.places) if self.rows[y][x] == mark]
