"""The constants of an agent's compiled code: what it calls by address, and the numbers of actions and axes.

Kernels are compiled for numbers of actions and axes, so that the loops of every step are unrolled, and not for an agent
or its user-defined functions: the kernels in `Constants` are compiled one by one, once an agent needs them.
"""

from typing import NamedTuple, Self

import numpy as np

from neorl.core.calls import function, tabled
from neorl.core.kernel import kernel, kernel_maker
from neorl.core.parameters import Parameters
from neorl.core.scene import Scene
from neorl.core.state import State


@tabled
class Constants(NamedTuple):
    """What the kernels of an agent call, and the numbers that they are compiled for.

    A kernel that the agent does not need is None. The kernels whose names end in "self" and "contacts" take the number
    of a node with the self as its state, or with contacts as its goals; most also take the number of one of its points.
    """

    actions: tuple  # their numbers; a tuple's length is part of its type, so it is known when loops are compiled
    axes: tuple  # the numbers of the world's axes
    last: int  # the highest number that may be chosen: that of idleness, if the agent can be idle
    feature: function(int, Scene, int, returns=float)  # (number, scene, point) → the coordinate along a user's axis
    credit: function(int, int, bool, np.float32, returns=float) = None  # (count, steps, last, activity) → ψ of an event
    choose: function(State, returns=int) = None  # → the action
    begin: function(Parameters, Self, State, Scene, returns=None) = None
    act: function(Parameters, Self, State, Scene, returns=int) = None
    observe: function(Parameters, Self, State, Scene, returns=None) = None
    begin_self: function(Parameters, Self, State, Scene, int, int, returns=None) = None
    observe_self: function(Parameters, Self, State, Scene, int, int, returns=None) = None
    begin_contacts: function(Parameters, Self, State, Scene, int, int, returns=None) = None
    observe_contacts: function(Parameters, Self, State, Scene, int, int, returns=None) = None
    evaluate_contacts: function(Parameters, Self, State, Scene, int, returns=None) = None


@kernel
def no_credit(count, steps, last, activity):
    """The placeholder for agents without a user-defined credit rule."""
    return 0.0


@kernel_maker
def choice(choose):
    """The kernel (state) of a policy (value, stream): one pointer is passed faster than two arrays."""
    @kernel
    def chosen(state):
        return 0 | choose(state.action_value, state.stream)  # which only an integer allows

    return chosen


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
                return first(Scene(scene.position, scene.velocity, scene.things, scene.kinds, scene.met), point)
            return others(number - 1, scene, point)

    return feature
