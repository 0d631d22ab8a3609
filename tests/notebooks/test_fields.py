"""The superposition of elements of interest over a whole map."""

import numpy as np
import pytest

from lib.shared.fields import superposed_field
from neorl import superpose


def test_a_field_has_the_superposition_of_every_cell():
    q = np.random.default_rng(0).random((9, 4, 9), np.float32)
    field = superposed_field(q, [2, 7], [1.0, -0.5])
    assert field.shape == (9, 4)
    np.testing.assert_allclose(field, q[:, :, 2] - 0.5 * q[:, :, 7], rtol=1e-5, atol=1e-7)
    np.testing.assert_array_equal(field[4], superpose(q, 4, [2, 7], [1.0, -0.5]))
    with pytest.raises(ValueError, match="valences must have a value for each of the 2 goals, but has 1"):
        superposed_field(q, [2, 7], [1.0])
