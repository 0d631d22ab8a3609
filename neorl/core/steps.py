"""The life of an agent in single steps, for worlds that are not made of kernels: `begin`, `act`, `observe`.

Each combination of an agent's constants is compiled once in a process.
"""

import functools
from typing import NamedTuple

from neorl.core import life
from neorl.core.constants import Constants
from neorl.core.kernel import Kernel, kernel
from neorl.core.parameters import Parameters
from neorl.core.scene import Scene
from neorl.core.state import State


class Steps(NamedTuple):
    """Kernels that take (parameters, state, scene)."""

    begin: Kernel
    act: Kernel  # returns the action
    observe: Kernel


@functools.cache
def steps_with(constants):
    """The `Steps` of agents with certain `Constants`."""
    feature, credit, choose, actions, axes = constants

    @kernel
    def begin(parameters: Parameters, state: State, scene: Scene) -> None:
        life.begin(parameters, Constants(feature, credit, choose, actions, axes), state, scene)

    @kernel
    def act(parameters: Parameters, state: State, scene: Scene) -> int:
        return life.act(parameters, Constants(feature, credit, choose, actions, axes), state, scene)

    @kernel
    def observe(parameters: Parameters, state: State, scene: Scene) -> None:
        life.observe(parameters, Constants(feature, credit, choose, actions, axes), state, scene)

    return Steps(begin, act, observe)
