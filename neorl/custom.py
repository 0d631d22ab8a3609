"""What worlds, modalities and policies of one's own are written with, by one import.

A world is a frozen dataclass derived from `World`, whose state is a named tuple of a `Scene` and of each `array`; its
`Dynamics` are two functions decorated by `kernel`, which draw from the state's stream by `uniform` and `randint`
(`neorl.worlds.world` has the rules). A `Modality` has an `Axis` for each coordinate; `cartesian` and `polar` list those
of the plane, `heading` and `turn` stand in for cosine, sine and arctangent. `greedy` is the usual policy, `softmax`
makes another, and a function decorated by `kernel_maker` makes kernels with parameters. `walls`
makes walls, and axes on which cells sense them. `execute` calls a kernel from Python.

>>> from neorl.custom import CARDINAL, Dynamics, Scene, World, array, kernel, uniform
"""

from neorl.core.direction import heading, turn
from neorl.core.modality import Axis, Modality, cartesian, polar
from neorl.core.policy import greedy, softmax
from neorl.core.scene import ABSENT, CARDINAL, Actions, Scene
from neorl.core.stream import randint, uniform
from neorl.kernels.annotations import array
from neorl.kernels.execution import execute
from neorl.kernels.kernel import kernel, kernel_maker
from neorl.worlds import walls as walls
from neorl.worlds.world import Dynamics, World

__all__ = ["ABSENT", "Actions", "Axis", "CARDINAL", "Dynamics", "Modality", "Scene", "World", "array", "cartesian",
           "execute", "greedy", "heading", "kernel", "kernel_maker", "polar", "randint", "softmax", "turn", "uniform",
           "walls"]
