"""Streams of random numbers: NumPy's SFC64, in integer arithmetic that a kernel can run.

A stream is four unsigned 64-bit integers, seeded as by NumPy's `SeedSequence`. Draw for draw it equals
``np.random.Generator(np.random.SFC64(seed_sequence)).random()``, so every draw of a run can be checked with NumPy.
"""

import numpy as np
from numpy.typing import NDArray

from neorl import checks
from neorl.core.calls import execute
from neorl.core.kernel import array, kernel

NOTHING, ONE, U3, U11, U16, U24, U32, U40 = (np.uint64(value) for value in (0, 1, 3, 11, 16, 24, 32, 40))
TO_UNIT = 2.0**-53

# Constants of O'Neill's seed_seq hash, as in NumPy. It multiplies modulo 2**32, hence the mask for 64-bit integers.
POOL = 4
MASK = np.uint64(2**32 - 1)
INIT_A, MULTIPLY_A = np.uint64(0x43B0D7E5), np.uint64(0x931E8875)
INIT_B, MULTIPLY_B = np.uint64(0x8B51F9DD), np.uint64(0x58F38DED)
MIX, MIX_IN = np.uint64(0xCA01F9DD), np.uint64(2**32 - 0x4973F715)
WARM_UP = 12  # draws that a fresh stream discards


def new_stream(seed_sequence: np.random.SeedSequence) -> NDArray[np.uint64]:
    """A fresh stream: uint64 (4,), the words of ``np.random.SFC64(seed_sequence)``.

    Raises ValueError unless the pool of the seed sequence has 4 words, the default.
    """
    checks.instance("seed_sequence", seed_sequence, np.random.SeedSequence)
    if seed_sequence.pool_size != POOL:
        raise checks.error("pool_size of seed_sequence", str(POOL), seed_sequence.pool_size)
    stream = np.zeros(4, np.uint64)
    execute(start_stream, np.array(_entropy(seed_sequence), np.uint64), stream)
    return stream


def _entropy(seed_sequence):
    """The 32-bit words of a seed sequence, lowest first; if it was spawned, at least four words, then its key."""
    words = _words(seed_sequence.entropy)
    if seed_sequence.spawn_key:
        words += [0] * (POOL - len(words)) + _words(seed_sequence.spawn_key)
    return words


def _words(value):
    if isinstance(value, list | tuple | np.ndarray):
        return [word for each in value for word in _words(each)]
    value = int(value)
    return [value >> shift & 0xFFFFFFFF for shift in range(0, max(value.bit_length(), 1), 32)]


@kernel
def start_stream(words: array("uint64", "words"), stream: array("uint64", 4)) -> None:
    """Seed a stream with 32-bit words."""
    constant = INIT_A
    for i in range(POOL):
        stream[i], constant = scrambled(words[i] if i < words.shape[0] else NOTHING, constant, MULTIPLY_A)
    for source in range(max(POOL, words.shape[0])):
        for i in range(POOL):
            if source != i:
                word, constant = scrambled(stream[source] if source < POOL else words[source], constant, MULTIPLY_A)
                mixed = (MIX * stream[i] & MASK) + (MIX_IN * word & MASK) & MASK
                stream[i] = mixed ^ (mixed >> U16)
    a, constant = scrambled(stream[0], INIT_B, MULTIPLY_B)
    a_high, constant = scrambled(stream[1], constant, MULTIPLY_B)
    b, constant = scrambled(stream[2], constant, MULTIPLY_B)
    b_high, constant = scrambled(stream[3], constant, MULTIPLY_B)
    c, constant = scrambled(stream[0], constant, MULTIPLY_B)
    c_high, constant = scrambled(stream[1], constant, MULTIPLY_B)
    stream[0], stream[1], stream[2], stream[3] = a | (a_high << U32), b | (b_high << U32), c | (c_high << U32), ONE
    for _ in range(WARM_UP):
        draw(stream)


@kernel
def scrambled(word, constant, multiplier):
    """A hashed word, and the constant for the next one."""
    word ^= constant
    constant = constant * multiplier & MASK
    word = word * constant & MASK
    return word ^ (word >> U16), constant


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
