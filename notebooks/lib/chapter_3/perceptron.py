"""Properties of a perceptron that need no training (thesis chapter 3, introduction)."""

import numpy as np


def numerical_slope(inputs, outputs):
    """The slope of an activation between neighbouring inputs, (n − 1,). inputs, rising, and outputs: float64 (n,)."""
    return np.diff(outputs) / np.diff(inputs)


def agreeing_intervals(inputs, slope):
    """The number of intervals in which the slope of an activation equals the step of McCulloch and Pitts (1943).

    inputs: float64 (n,), rising. slope: (n − 1,), of the activation between neighbouring inputs.
    """
    return int(np.isclose(slope, np.heaviside((inputs[1:] + inputs[:-1]) / 2, 0)).sum())


def mistake_bound(inputs, truth):
    """The largest possible number of mistakes of Rosenblatt's rule (Novikoff 1962): (largest input / margin)².

    inputs: float64 (points, weights), none of them on the line. truth: (weights,), of a line between the classes.
    """
    margin = np.abs(inputs @ truth).min() / np.linalg.norm(truth)
    return float((np.linalg.norm(inputs, axis=1).max() / margin) ** 2)
