"""The life of an agent in single steps, for worlds that are not made of kernels: `begin`, `act`, `observe`.

Each combination of an agent's constants is compiled once (`neorl.core.compile_cache`).
"""

import functools
from typing import NamedTuple

from neorl.core import life
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
    """The `Steps` of agents with given `neorl.core.constants.Constants`."""

    @kernel
    def begin(parameters: Parameters, state: State, scene: Scene) -> None:
        life.begin(parameters, constants, state, scene)

    @kernel
    def act(parameters: Parameters, state: State, scene: Scene) -> int:
        return life.act(parameters, constants, state, scene)

    @kernel
    def observe(parameters: Parameters, state: State, scene: Scene) -> None:
        life.observe(parameters, constants, state, scene)

    return Steps(begin, act, observe)
