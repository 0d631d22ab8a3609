"""Action selection from the values of all actions: greedy, or by a softmax.

A user-defined policy is a kernel of the same form, ``(value, stream) → action``: value, float64 (actions,), has the
values of the actions; stream provides random numbers by `neorl.core.stream.uniform` and `randint`.

In `notebooks/companion/one_file.py`, `greedy` is the end of `choose` in section 3.
"""

import math
from collections.abc import Callable

import numpy as np

from neorl.common import checks
from neorl.core.stream import randint, uniform
from neorl.kernels.kernel import inlined_kernel, kernel, kernel_maker

LN_2 = math.log(2.0)
LN_2_HIGH, LN_2_LOW = 6.93147180369123816490e-01, 1.90821492927058770002e-10  # in two parts, so that few bits are lost
TERMS = 20  # of the series of the exponential function, exact to the last few bits


@inlined_kernel
def highest(value):
    """The value of the best action."""
    best = value[0]
    for action in range(1, value.shape[0]):
        best = max(best, value[action])
    return best


@kernel
def greedy(value, stream):
    """The action of highest value, ties broken at random."""
    best, ties = highest(value), 0
    for action in range(value.shape[0]):
        ties += value[action] == best
    skip = randint(stream, ties) if ties > 1 else 0
    action = 0
    while action < value.shape[0] - 1 and (value[action] != best or skip > 0):
        skip -= value[action] == best
        action += 1
    return action


@kernel_maker
def softmax(temperature: float) -> Callable:
    """The policy that draws an action a with probability proportional to exp(value[a] / temperature).

    temperature: > 0, in units of value. Raises ValueError for anything else. It explores by itself; the exploration of
    a `neorl.Policy`, a tenth by default, comes in addition.
    """
    temperature = checks.positive("temperature", temperature)

    @kernel
    def choose(value, stream):
        best, total = highest(value), 0.0
        for action in range(value.shape[0]):
            total += exponential((value[action] - best) / temperature)
        rest = uniform(stream) * total
        action = 0
        while action < value.shape[0] - 1:
            rest -= exponential((value[action] - best) / temperature)
            if rest < 0.0:
                break
            action += 1
        return action

    return choose


@kernel
def exponential(x):
    """e to the power of x ≤ 0, by its series near 0 and repeated halving."""
    if not x > -700.0:
        return 0.0
    halvings = np.floor(-x / LN_2)
    rest = x + halvings * LN_2_HIGH + halvings * LN_2_LOW
    series = 1.0
    for n in range(TERMS, 0, -1):
        series = 1.0 + rest / n * series
    while halvings > 0.0:
        series *= 0.5
        halvings -= 1.0
    return series
