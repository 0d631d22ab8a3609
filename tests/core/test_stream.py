"""The stream of random numbers against NumPy's."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from neorl.core.stream import new_stream, randint, uniform
from neorl.kernels.execution import execute


@given(st.integers(0, 2**64), st.lists(st.integers(0, 100), max_size=3))
def test_every_draw_equals_that_of_numpy(seed, spawn_key):
    sequence = np.random.SeedSequence(seed, spawn_key=spawn_key)
    numpy = np.random.Generator(np.random.SFC64(sequence))
    stream = new_stream(sequence)
    assert [execute(uniform, stream) for _ in range(100)] == numpy.random(100).tolist()


def test_randint_draws_every_integer_equally_often():
    stream = new_stream(np.random.SeedSequence(0))
    counts = np.bincount([execute(randint, stream, 5) for _ in range(50_000)])
    assert len(counts) == 5
    assert np.all(np.abs(counts - 10_000) < 400)
