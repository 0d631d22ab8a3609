"""The constants of an agent's compiled code: user-defined kernels, and the numbers of actions and axes.

As constants, they let the loops of every step be unrolled and user-defined functions be called at no cost.
"""

from typing import NamedTuple

import numpy as np

from neorl.core.kernel import Kernel, kernel, kernel_maker


class Constants(NamedTuple):
    """What is compiled into an agent's kernels."""

    feature: Kernel  # (number, scene, point) → the coordinate along a user-defined axis
    credit: Kernel  # (count, steps, last, activity) → ψ of an event, if the credit is `choices.Credit.own`
    choose: Kernel  # (value, stream) → the action
    actions: tuple  # their numbers; a tuple's length is part of its type, so it is known when loops are compiled
    axes: tuple  # the numbers of the world's axes
    last: int  # the highest number that may be chosen: that of idleness, if the agent can be idle


@kernel
def no_credit(count, steps, last, activity):
    """The placeholder for agents without a user-defined credit rule."""
    return 0.0


@kernel_maker
def features(*kernels):
    """One kernel (number, scene, point) that selects among any number of kernels (scene, point)."""
    if not kernels:
        @kernel
        def feature(number, scene, point):
            return np.nan
    else:
        first, others = kernels[0], features(*kernels[1:])

        @kernel
        def feature(number, scene, point):
            if number == 0:
                return first(scene, point)
            return others(number - 1, scene, point)

    return feature
