"""How a page seeds its streams of random numbers: as `neorl.core.stream.new_stream` does, without NumPy.

A seed sequence is a list of 32-bit words: the seed, lowest word first, filled up to four words if it was spawned, and
then its key.
"""

import numpy as np

from neorl.core.stream import ONE, draw
from neorl.kernels.annotations import array
from neorl.kernels.kernel import kernel

NOTHING, U16, U32 = (np.uint64(value) for value in (0, 16, 32))

# Constants of O'Neill's seed_seq hash, as in NumPy. It multiplies modulo 2**32, hence the mask for 64-bit integers.
POOL = 4
MASK = np.uint64(2**32 - 1)
INIT_A, MULTIPLY_A = np.uint64(0x43B0D7E5), np.uint64(0x931E8875)
INIT_B, MULTIPLY_B = np.uint64(0x8B51F9DD), np.uint64(0x58F38DED)
MIX, MIX_IN = np.uint64(0xCA01F9DD), np.uint64(2**32 - 0x4973F715)
WARM_UP = 12  # draws that a fresh stream discards


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
