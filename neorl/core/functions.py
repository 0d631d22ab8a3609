"""What the kernels of an agent call by address: the user's functions, the learners of other maps, its loop.

So each is compiled once and by itself, for all agents with as many actions and axes in any world, and another policy
compiles nothing but itself. A kernel that the agent does not need is None.
"""

from typing import NamedTuple

import numpy as np

from neorl.core.layout import Memory, Record
from neorl.core.scene import Scene
from neorl.kernels.annotations import function, tabled
from neorl.kernels.kernel import kernel, kernel_maker


@tabled
class UserFunctions(NamedTuple):
    """The user's functions."""

    feature: function(int, Scene, int, returns=float)  # (number, scene, point) → the coordinate along a user's axis
    credit: function(int, int, bool, np.float32, returns=float) = None  # (count, steps, last, activity) → ψ of an event
    choose: function(Record, returns=int) = None  # → the action


@tabled
class AgentFunctions(NamedTuple):
    """The same, and the learners of nodes with the self as their state, or with contacts as their goals.

    They take the number of a node, and of one of its points.
    """

    user: UserFunctions
    begin_self: function(Record, Memory, Scene, UserFunctions, int, int, returns=None) = None
    observe_self: function(Record, Memory, Scene, UserFunctions, int, int, returns=None) = None
    begin_contacts: function(Record, Memory, Scene, UserFunctions, int, int, returns=None) = None
    observe_contacts: function(Record, Memory, Scene, UserFunctions, int, int, returns=None) = None
    evaluate_contacts: function(Record, Memory, Scene, UserFunctions, int, returns=None) = None


@tabled
class Loop(NamedTuple):
    """The same, and the three kernels of `neorl.core.loop`."""

    functions: AgentFunctions
    begin: function(Record, Memory, Scene, AgentFunctions, returns=None) = None
    act: function(Record, Memory, Scene, AgentFunctions, returns=int) = None
    observe: function(Record, Memory, Scene, AgentFunctions, returns=None) = None


@kernel
def no_credit(count, steps, last, activity):
    """The placeholder for agents without a user-defined credit rule."""
    return 0.0


@kernel_maker
def choice(choose):
    """The kernel (agent) of a policy (value, stream): one pointer is passed faster than two arrays."""
    @kernel
    def chosen(agent):
        return 0 | choose(agent.action_value[:], agent.stream[:])  # which only an integer allows

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
