"""The direction of a vector in turns, and its inverse, by series whose bits are the same on every platform."""

import math

import numpy as np

from neorl.kernels.kernel import kernel

TAU = 2.0 * math.pi
SQRT_3 = math.sqrt(3.0)
TAN_15_DEGREES = 2.0 - SQRT_3
TERMS = 14  # of the series of the arctangent, exact to the last few bits
CIRCLE_TERMS = 9  # of the series of sine and cosine up to an eighth of a turn, likewise


@kernel
def turn(x, y):
    """The direction of a vector in turns, 0 ≤ turn < 1: 0 along +x, a quarter along +y."""
    wide, high = abs(x), abs(y)
    longer = max(wide, high)
    if longer == 0.0:
        return 0.0
    # The arctangent of a slope in 0 … 1 by its series, which converges fast below tan 15°.
    slope, turned = min(wide, high) / longer, 0.0
    if slope > TAN_15_DEGREES:
        slope, turned = (slope * SQRT_3 - 1.0) / (slope + SQRT_3), 1.0 / 12.0
    series = 0.0
    for n in range(TERMS - 1, -1, -1):
        series = 1.0 / (2 * n + 1) - slope * slope * series
    turned += slope * series / TAU
    if high > wide:
        turned = 0.25 - turned
    if x < 0.0:
        turned = 0.5 - turned
    if y < 0.0:
        turned = 1.0 - turned
    return turned if turned < 1.0 else 0.0


@kernel
def heading(turns):
    """The vector of length 1 in a direction given in turns, (x, y): the inverse of `turn`, for any finite number.

    It stands in for cosine and sine, whose last bits differ between platforms.
    """
    return circle(turns, CIRCLE_TERMS)


@kernel
def circle(turns, terms):
    """Cosine and sine of an angle in turns, by so many terms of their series."""
    quarters = np.floor(4.0 * (turns - np.floor(turns)) + 0.5)
    angle = TAU * (turns - np.floor(turns) - 0.25 * quarters)  # within an eighth of a turn from the nearest axis
    square, cosine, sine = angle * angle, 1.0, 1.0
    for n in range(terms - 1, -1, -1):
        cosine = 1.0 - square / ((2 * n + 1) * (2 * n + 2)) * cosine
        sine = 1.0 - square / ((2 * n + 2) * (2 * n + 3)) * sine
    sine *= angle
    if quarters == 1.0:
        return 0.0 - sine, cosine
    if quarters == 2.0:
        return -cosine, 0.0 - sine
    if quarters == 3.0:
        return sine, -cosine
    return cosine, sine
