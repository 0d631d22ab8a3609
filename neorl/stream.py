"""Streams of random numbers: NumPy's SFC64, in integer arithmetic that a kernel can run.

A stream is four unsigned 64-bit integers, seeded by NumPy's own `SeedSequence`. Draw for draw it equals
``np.random.Generator(np.random.SFC64(seed_sequence)).random()``, so NumPy can check every number of a run.
"""

import numpy as np

from neorl.kernel import kernel

U3, U11, U24, U40, ONE = (np.uint64(value) for value in (3, 11, 24, 40, 1))
TO_UNIT = 2.0**-53


def new_stream(seed_sequence):
    """The stream at its start: uint64 (4,), the words of ``np.random.SFC64(seed_sequence)``."""
    return np.random.SFC64(seed_sequence).state["state"]["state"].astype(np.uint64)


@kernel
def uniform(stream):
    """The next number of the stream, a double in [0, 1)."""
    a, b, c, counter = stream[0], stream[1], stream[2], stream[3]
    drawn = a + b + counter
    stream[0] = b ^ (b >> U11)
    stream[1] = c + (c << U3)
    stream[2] = ((c << U24) | (c >> U40)) + drawn
    stream[3] = counter + ONE
    return (drawn >> U11) * TO_UNIT


@kernel
def below(stream, count):
    """The next number of the stream as an integer in 0 … count − 1, each equally likely."""
    return int(uniform(stream) * count)
