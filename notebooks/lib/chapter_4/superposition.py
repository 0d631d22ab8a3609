"""Functions of two variables as sums of functions of one (thesis section 4.1.1, equation 4.2).

1. Kolmogorov and Arnold write every continuous function as Σ_q χ_q(Σ_p ψ_qp(x_p)), with 2n + 1 outer functions χ.
2. Here the inner functions are the plainest possible, so each term is a *ridge*: χ(x cos θ + y sin θ).
3. Ridges are added one at a time, each at the angle θ that explains most of the residual of the others (projection
   pursuit, Friedman and Stuetzle 1981). The outer functions are polynomials, fitted jointly by least squares.
"""

from typing import NamedTuple

import numpy as np

from neorl import checks

DEGREE = 10  # of the outer functions
ANGLES = np.pi * np.arange(60) / 60
AXES = np.array([0, np.pi / 2])  # the angles of functions of x alone and of y alone


class Ridges(NamedTuple):
    """A sum of ridges fitted to a function."""

    angles: np.ndarray  # θ of each ridge: float64 (terms,)
    errors: np.ndarray  # root mean square residual of 0, 1, … ridges: float64 (terms + 1,), in standard deviations


def exact_sums(x, y):
    """Functions of two variables with an evident sum: {name: (function, formula of the sum, sum)}.

    x, y: float64 (…). Function and sum have the same shape, and are equal up to rounding.
    """
    return {"product of x and y": (x * y, "((x + y)² − (x − y)²) / 4", ((x + y) ** 2 - (x - y) ** 2) / 4),
            "larger of x and y": (np.maximum(x, y), "(x + y + √((x − y)²)) / 2", (x + y + np.sqrt((x - y) ** 2)) / 2),
            "distance from 0": (np.hypot(x, y), "√(x² + y²)", np.sqrt(x**2 + y**2))}


def fit_ridges(values, terms, angles=ANGLES):
    """Fit `Ridges` to a function on the square from −1 to 1.

    values: float64 (side, side), not all equal, at evenly spaced points; the first axis is y. terms: integer ≥ 1.
    angles: candidates, in radians; by default 60, spread evenly over half a turn.
    Raises ValueError for anything else.
    """
    values = checks.finite("values", np.asarray(values, float))
    if values.ndim != 2 or values.shape[0] != values.shape[1] or np.ptp(values) == 0:
        raise ValueError(f"values has the shape {values.shape}, allowed are squares (side, side), not all equal")
    checks.integer("terms", terms, at_least=1)
    side = np.linspace(-1, 1, len(values))
    x, y = (each.ravel() for each in np.meshgrid(side, side))
    outer = [np.linalg.qr(np.vander((x * np.cos(angle) + y * np.sin(angle)) / 2, DEGREE + 1))[0] for angle in angles]
    left = values.ravel() - values.mean()
    spread = left.std()
    chosen, errors, found = [], [1.0], np.empty((left.size, 0))
    for _ in range(terms):
        best = int(np.argmax([np.square(each.T @ left).sum() for each in outer]))
        new = outer[best] - found @ (found.T @ outer[best])
        directions, sizes, _ = np.linalg.svd(new, full_matrices=False)
        found = np.hstack([found, directions[:, sizes > 1e-8]])  # without what earlier ridges span
        left = left - found @ (found.T @ left)
        chosen.append(angles[best])
        errors.append(left.std() / spread)
    return Ridges(np.array(chosen), np.array(errors))
