"""Streams of random numbers: NumPy's SFC64, in integer arithmetic that a kernel can run.

A stream is four unsigned 64-bit integers, seeded as by NumPy's `SeedSequence`. Draw for draw it equals
``np.random.Generator(np.random.SFC64(seed_sequence)).random()``, so every draw of a run can be checked with NumPy.
"""

import numpy as np
from numpy.typing import NDArray

from neorl.common import checks
from neorl.kernels.kernel import kernel

ONE, U3, U11, U24, U40 = (np.uint64(value) for value in (1, 3, 11, 24, 40))
TO_UNIT = 2.0**-53


def new_stream(seed_sequence: np.random.SeedSequence) -> NDArray[np.uint64]:
    """A fresh stream: uint64 (4,), the words of ``np.random.SFC64(seed_sequence)``.

    Raises ValueError for anything but a seed sequence.
    """
    seeded = np.random.SFC64(checks.instance("seed_sequence", seed_sequence, np.random.SeedSequence))
    return np.array(seeded.state["state"]["state"], np.uint64)


@kernel
def draw(stream):
    """The next 64 random bits of the stream."""
    a, b, c, counter = stream[0], stream[1], stream[2], stream[3]
    drawn = a + b + counter
    stream[0] = b ^ (b >> U11)
    stream[1] = c + (c << U3)
    stream[2] = ((c << U24) | (c >> U40)) + drawn
    stream[3] = counter + ONE
    return drawn


@kernel
def uniform(stream):
    """The next number of the stream, a double in [0, 1)."""
    return (draw(stream) >> U11) * TO_UNIT


@kernel
def randint(stream, count):
    """The next number of the stream as an integer in 0 … count − 1, each equally likely."""
    return int(uniform(stream) * count)
