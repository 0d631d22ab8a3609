"""Superposed values over a whole map (thesis eq. 4.3 and 4.4)."""

import numpy as np

from neorl.core.horde import superpose


def superposed_field(q, goals, valences):
    """The superposed value of each action in every cell of a map: float64 (cells, 4)."""
    return np.array([superpose(q, cell, goals, valences) for cell in range(len(q))])
