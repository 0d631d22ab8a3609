"""The constants of an agent's compiled code: kernels of the user's own, and the numbers of actions and axes.

They are constants so that the loops of every step are unrolled, and a function of the user's own costs no call.
"""

from typing import NamedTuple

import numpy as np

from neorl.core.kernel import Kernel, kernel, kernel_maker


class Constants(NamedTuple):
    """What is compiled into an agent's kernels."""

    feature: Kernel  # (number, scene, point) → the coordinate along an axis of the user's own
    credit: Kernel  # (count, steps, last, activity) → ψ of an event, if the credit is `choices.Credit.own`
    choose: Kernel  # (value, stream) → the action
    actions: tuple  # their numbers; the length of a tuple is part of its type, and so known where loops are compiled
    axes: tuple  # the numbers of the world's axes


@kernel
def no_credit(count, steps, last, activity):
    """The credit of an agent that has none of the user's own."""
    return 0.0


@kernel_maker
def features(*kernels):
    """One kernel (number, scene, point) for any number of kernels (scene, point)."""
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
