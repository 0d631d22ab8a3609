"""What can be said of a perceptron without letting it learn (thesis chapter 3, introduction)."""

import numpy as np


def numerical_slope(inputs, outputs):
    """The slope of an activation between neighbouring inputs, (n − 1,): float64 (n,) each, inputs rising."""
    return np.diff(outputs) / np.diff(inputs)


def agreeing_intervals(inputs, slope):
    """In how many intervals the slope of an activation is the step of McCulloch and Pitts (1943).

    inputs: float64 (n,), rising. slope: (n − 1,), of the activation between neighbouring inputs.
    """
    return int(np.isclose(slope, np.heaviside((inputs[1:] + inputs[:-1]) / 2, 0)).sum())


def mistake_bound(inputs, truth):
    """How many mistakes Rosenblatt's rule makes at most (Novikoff 1962): (largest input / margin)².

    inputs: float64 (points, weights), none of them on the line. truth: (weights,), of a line between the classes.
    """
    margin = np.abs(inputs @ truth).min() / np.linalg.norm(truth)
    return float((np.linalg.norm(inputs, axis=1).max() / margin) ** 2)
