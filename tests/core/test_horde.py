"""Learning and superposition against NumPy, and against the exact values of a grid world."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from neorl.core.horde import learn, superpose

shares = st.floats(0, 1, width=32)


def learned_by_numpy(q, cell_tm1, cell_t, credit, learning_rate, discount, terminal):
    """Equation 4.8 for all goals at once, in the precision of the kernel."""
    q = q.copy()
    target = np.float32(discount) * q[cell_t].max(axis=0)
    target[cell_t] = 1 if terminal else 1 + target[cell_t]
    rates = np.float32(learning_rate) * np.array(credit, np.float32)[:, None]
    new = q[cell_tm1] + rates * (target - q[cell_tm1])
    q[cell_tm1] = np.where(rates > 0, np.where(new > 1e-30, new, 0), q[cell_tm1])
    return q


small_or_0 = shares.map(lambda value: value if value > 1e-6 else 0.0)


@st.composite
def tables_and_credits(draw):
    """Values of any number of actions, which the kernel processes four at a time, and the credit of each action."""
    actions = draw(st.sampled_from([4, 4, 1, 2, 3, 5, 6, 7, 8, 9, 13]))
    return (draw(arrays(np.float32, (6, actions, 6), elements=small_or_0)),
            draw(st.lists(shares, min_size=actions, max_size=actions)))


@given(tables_and_credits(), st.integers(0, 5), st.integers(0, 5), shares, shares, st.booleans())
def test_an_update_equals_numpy(table, cell_tm1, cell_t, learning_rate, discount, terminal):
    q, credit = table
    expected = learned_by_numpy(q, cell_tm1, cell_t, credit, learning_rate, discount, terminal)
    learn(q, cell_tm1, cell_t, credit, learning_rate, discount, terminal)
    np.testing.assert_array_equal(q, expected)


def test_every_goal_of_a_grid_world_is_learned_from_one_random_walk():
    """If each action moves by one cell, the value of the best action is γ to the power of the moves left after it."""
    side, discount = 4, 0.8
    rng = np.random.default_rng(0)
    q = np.zeros((side**2, 4, side**2), np.float32)
    x, y = 0, 0
    for _ in range(15_000):
        action = rng.integers(4)
        dx, dy = [(0, -1), (0, 1), (1, 0), (-1, 0)][action]
        new_x, new_y = np.clip(x + dx, 0, side - 1), np.clip(y + dy, 0, side - 1)
        learn(q, y * side + x, new_y * side + new_x, np.eye(4)[action], 0.5, discount)
        x, y = new_x, new_y
    cells = np.arange(side**2)
    moves = (np.abs(cells[:, None] % side - cells % side) + np.abs(cells[:, None] // side - cells // side))
    away = moves > 0
    np.testing.assert_allclose(q.max(axis=1)[away], discount ** (moves[away] - 1.0), rtol=1e-4)


def test_superposition_is_the_weighted_sum_over_elements():
    q = np.random.default_rng(0).random((9, 4, 9)).astype(np.float32)
    goals, valences = [2, 2, 5, 7], [1.0, 0.5, -1.0, 0.25]
    np.testing.assert_allclose(superpose(q, 4, goals, valences), q[4][:, goals] @ valences, rtol=1e-6)


def test_an_element_in_the_own_cell_counts_unless_it_is_silent():
    q = np.ones((4, 4, 4), np.float32)
    assert superpose(q, 1, [1, 2], [1.0, 1.0]).tolist() == [2.0] * 4
    assert superpose(q, 1, [1, 2], [1.0, 1.0], own_cell="silent").tolist() == [1.0] * 4
    assert superpose(np.asfortranarray(q), 1, [1, 2], [1.0, 1.0]).tolist() == [2.0] * 4  # a view, as Run.q returns
    with pytest.raises(ValueError, match="q must be C-contiguous, but is not; pass a copy"):
        learn(np.asfortranarray(q), 0, 1, [1, 0, 0, 0])
