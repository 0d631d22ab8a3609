"""The interface of worlds, and how to write one.

A world is one file, for which `neorl.custom` has everything: ``from neorl.custom import CARDINAL, Dynamics, Scene,
World, array, kernel, randint, uniform, walls``. It is a frozen dataclass, whose fields users
choose, with a `State`, rules, and two kernels:

1. ``State``, a named tuple of arrays (`neorl.kernels.annotations.array`), holds everything that changes. It has a field
   ``scene``, the `neorl.core.scene.Scene` that agents perceive, and a field ``stream``, uint64 (4,), from which random
   numbers are drawn (`neorl.custom.uniform`, `neorl.custom.randint`).
2. ``rules``, a named tuple of numbers and arrays, holds everything that stays constant, as the kernels take it.
3. ``reset(state, rules)`` starts an episode; ``step(state, rules, action)`` takes a step, and returns the reward and
   whether the episode is over. Both have annotated arguments. For each thing, a step sets ``scene.met`` to 0, or to 1 +
   the number of its kind when it was met. Both keep to the rules of kernels (`neorl.kernels.kernel`).
4. ``kinds`` names the kinds of its things, the one that agents want by default first; ``actions`` are its `Actions`,
   whose numbers ``step`` takes. ``size`` is its unit of length, such as its width; ``fps`` is its number of steps per
   second; ``things`` is its number of things.

`neorl.Run`, `neorl.simulate`, `neorl.sweep` and the cache accept it as it is. `notebooks/own_world.ipynb` has a small
example, `neorl.worlds.arena` is a larger one. `neorl.custom.heading` and `neorl.custom.turn` stand in
for cosine, sine and the arctangent.

With ``NUMBA_DISABLE_JIT=1`` in the environment, the kernels are the Python functions that they were written as, with
the same bits: `breakpoint` and `print` work in them, and an index out of range raises IndexError instead of crashing.
"""

import contextlib
import copyreg
import inspect
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from neorl.common import checks
from neorl.core.scene import Actions, Scene
from neorl.core.stream import new_stream
from neorl.description import Described
from neorl.kernels.annotations import fields, is_again, is_tuple, length, new_tuple
from neorl.kernels.execution import execute
from neorl.kernels.identity import digest_of, is_ours, name_of
from neorl.kernels.kernel import Kernel, check_kernel, full_name, function_of, kernel
from neorl.kernels.pickling import AGAIN, check_digest, pickle_again, present, refused

STREAM = ("uint64", (4,))  # the type and the shape of a stream


class Dynamics(NamedTuple):
    """The two kernels of a world."""

    reset: Kernel  # (state, rules)
    step: Kernel  # (state, rules, action) → (reward, done)


@kernel
def squared_distance(one, other):
    """The squared distance of two places in the plane."""
    dx, dy = one[0] - other[0], one[1] - other[1]
    return dx * dx + dy * dy


class _Checking(type):
    """The type of worlds, which checks the rules of each that is made, whatever its fields and their checks."""

    def __call__(cls, *given, **by_name):
        world = super().__call__(*given, **by_name)
        if world.dynamics is not None:
            check_definition(world)
            pickle_again(world.State)
            pickle_again(type(checked_rules(world)))
        return world

    @property
    def __signature__(cls):  # of `__init__`, which `inspect` would not look for behind a call of its own
        _, *fields_of_world = inspect.signature(cls.__init__).parameters.values()
        return inspect.Signature(fields_of_world)


class World(Described, metaclass=_Checking):
    """A world of kernels; see the module for what a subclass defines, and how to debug it.

    Raises TypeError for a subclass with dynamics that lacks what else a world has, ValueError for a part that is not
    what it must be, and for rules whose arrays do not match their annotations.
    """

    dynamics: Any = None  # a `Dynamics`
    kinds: Any = ()
    actions: Any = None
    things: Any
    size: Any
    fps: Any
    rules: Any
    bounded: Any = False  # whether all its places are from 0 to 1 along every axis, in units of its size
    terminal: Any = None  # for each kind, whether meeting it ends a trial that otherwise ends by a limit of time

    def __init_subclass__(cls, **keywords: Any) -> None:
        super().__init_subclass__(**keywords)
        for name in ("reset", "step"):
            if getattr(cls, name) is not getattr(World, name):
                raise TypeError(f"{cls.__name__} must not have a method {name}, which runs would not call: the {name} "
                                "of a world is a neorl.kernel in its dynamics; give the method another name")

    def __reduce_ex__(self, protocol: Any) -> Any:  # with a digest of what `pickle` would leave to the class
        make, arguments, state = (*super().__reduce_ex__(protocol), None)[:3]
        if is_ours(type(self)) or self.dynamics is None:
            return make, arguments, state
        digest, now = digest_of(self.determinants), present(type(self))
        if now is not type(self):
            with contextlib.suppress(Exception):  # of any class: the user's code is run
                _unpickled(digest, make, (now, *arguments[1:]), state)
                arguments = now, *arguments[1:]
        return _unpickled, (digest, make, arguments, state)

    @property
    def determinants(self) -> tuple[Any, ...]:
        """Everything that runs take from the world besides its fields, for the keys of their results."""
        return (self.dynamics, checked_rules(self), self.kinds, self.actions, self.things, self.size, self.fps,
                new_tuple(self.State, self.sizes, {}))

    @property
    def State(self) -> type:
        """The type of its states."""
        return fields(self.dynamics.reset)["state"]

    @property
    def sizes(self) -> dict[str, int]:
        """The sizes of the arrays in a state, by name."""
        return {"things": self.things, "axes": self.actions.axes}

    def reset(self, seed: int | np.random.SeedSequence) -> Any:
        """A state at the beginning of an episode.

        seed: an integer ≥ 0 or a `numpy.random.SeedSequence`. Raises ValueError for anything else, and for a kernel
        `reset` that leaves a state that breaks a rule.
        """
        if not isinstance(seed, np.random.SeedSequence):
            seed = np.random.SeedSequence(checks.integer("seed", seed, at_least=0))
        state = new_tuple(self.State, self.sizes, {"stream": new_stream(seed)})
        execute(self.dynamics.reset, state, checked_rules(self))
        check_outcome(self, self.dynamics.reset, state)
        return state

    def step(self, state: Any, action: int | str) -> tuple[float, NDArray[np.bool], bool]:
        """Advance `state` in place by one step.

        action: the number of an action, or its name.
        Returns (reward: float, met: bool (things,), done: bool). After `done` the state is the last of its episode;
        `reset` gives the next one.
        Raises ValueError for an unknown action, for a state that does not fit or is not finite, and for a kernel
        `step` that leaves one, or returns a reward that is not finite.
        """
        names = self.actions.all_names
        action = names.index(checks.one_of("action", action, names)) if isinstance(action, str) else action
        action = checks.integer("action", action, at_least=0, at_most=len(names) - 1)
        self.check_state(state)
        returned = execute(self.dynamics.step, state, checked_rules(self), action)
        if not isinstance(returned, tuple) or len(returned) != 2:
            raise checks.error(f"what the kernel {full_name(self.dynamics.step)} returns", "(reward, done)", returned)
        reward, done = returned
        check_outcome(self, self.dynamics.step, state, reward)
        return float(reward), state.scene.met != 0, bool(done)

    def check_state(self, state: Any) -> None:
        """Raise ValueError unless the arrays of a state fit this world, and are finite."""
        check_kind("state", state, self.State)
        check_arrays("state", state, self.sizes)
        kinds, met = state.scene.kinds, state.scene.met
        if kinds.size and not (-1 <= kinds.min() and kinds.max() < len(self.kinds)):
            raise checks.error("state.scene.kinds", f"−1 or the numbers of {self.kinds}", kinds)
        if met.size and not (0 <= met.min() and met.max() <= len(self.kinds)):
            raise checks.error("state.scene.met", "0, or for a thing that was met 1 + the number of its kind among "
                               f"{self.kinds}", met)


def _pickled_class(kind):
    if present(kind) is not kind:
        raise refused(kind)
    return kind.__qualname__


copyreg.pickle(_Checking, _pickled_class)


def _unpickled(digest, make, arguments, state):
    """A world that was pickled. Raises ValueError if its determinants have another digest."""
    world = make(*arguments)
    if hasattr(world, "__setstate__"):
        world.__setstate__(state)
    elif state is not None:
        vars(world).update(state)
    check_digest(type(world), lambda: world.determinants, digest)
    return world


def check_definition(world):
    """Raise TypeError for a world that lacks something, ValueError for a part that is not what it must be."""
    name = type(world).__name__
    for part in ("kinds", "actions", "things", "size", "fps", "rules"):
        if getattr(type(world), part, None) is None and getattr(world, part, None) is None:
            raise TypeError(f"{name} must have {part}, as a World with dynamics, but has none; see neorl.worlds.world "
                            "for what a subclass defines")
    kinds = checks.several(f"kinds of {name}", world.kinds)
    if len(set(map(str, kinds))) < len(kinds) or not all(isinstance(each, str) for each in kinds):
        raise checks.error(f"kinds of {name}", "different names", kinds)
    checks.instance(f"actions of {name}", world.actions, Actions)
    checks.integer(f"things of {name}", world.things, 0, checks.MOST)
    checks.positive(f"size of {name}", world.size)
    checks.positive(f"fps of {name}", world.fps)
    if world.terminal is not None and [type(checks.plain(each)) for each in checks.several(
            f"terminal of {name}", world.terminal)] != [bool] * len(kinds):
        raise checks.error(f"terminal of {name}", f"None, or {len(kinds)} of True and False, for {kinds}",
                           world.terminal)
    for role, dynamic in checks.instance(f"dynamics of {name}", world.dynamics, Dynamics)._asdict().items():
        check_kernel(f"{role} of {name}", dynamic)
        takes = tuple(inspect.signature(function_of(dynamic)).parameters)
        if role == "reset" and not {"state", "rules"} <= fields(dynamic).keys() or len(takes) != 2 + (role == "step"):
            raise ValueError(f"{role} of {name} must take (state, rules{', action' * (role == 'step')}), annotated "
                             f"with their types, but takes ({', '.join(takes)})")
    if (parts := fields(world.State)).get("scene") is not Scene or parts.get("stream") != STREAM:
        raise ValueError(f"the state of {name} must have a field scene, a neorl.Scene, and a field stream, "
                         f"neorl.custom.array('uint64', 4), but has {', '.join(parts)}")
    for part, kind in parts.items():
        if not isinstance(kind, tuple) and not is_tuple(kind):
            raise checks.error(f"{part} in the state of {name}", "annotated as a neorl.custom.array or a named tuple",
                               kind)


def checked_rules(world):
    """The rules of a world, whose arrays match their annotations, or ValueError."""
    check_rules(rules := world.rules, fields(world.dynamics.reset)["rules"], dict(world.sizes))
    return rules


def check_rules(rules, kind, sizes, path="rules"):
    """Raise ValueError unless rules are of their annotated type, with arrays of the annotated types and shapes.

    sizes: of dimensions, by name; a name that is not among them stands for the length where it first occurs.
    """
    check_kind(path, rules, kind)
    for name, field in fields(type(rules)).items():
        value = getattr(rules, name)
        if is_tuple(field):
            check_rules(value, field, sizes, f"{path}.{name}")
        elif field in (bool, int, float, np.float32) and not _is_number(checks.plain(value)):
            raise checks.error(f"{path}.{name}", "a number of at most 64 bits, as it is annotated", value)
        elif isinstance(field, tuple) and not _is_as_annotated(value, *field, sizes):
            found = f"{value.dtype} {value.shape}" if isinstance(value, np.ndarray) else checks.shown(value)
            dtype, shape = field[0], tuple(sizes.get(each, each) for each in field[1])
            raise ValueError(f"{path}.{name} must be an array of {dtype} {shape}, as it is annotated, since kernels "
                             f"read it without a check, but is {found}: change the array, or its annotation")


def _is_number(value):
    return isinstance(value, float) or isinstance(value, int) and abs(value) < 2**63


def _is_as_annotated(value, dtype, shape, sizes):
    if not isinstance(value, np.ndarray) or (value.dtype, value.ndim) != (np.dtype(dtype), len(shape)):
        return False
    for each, actual in zip(shape, value.shape):
        if isinstance(each, str):
            size, _, more = each.partition(" + ")
            sizes.setdefault(size, actual - int(more or 0))
    return value.shape == tuple(length(each, sizes) for each in shape)


def check_kind(name, value, kind):
    """Raise ValueError unless a value is a named tuple of a kind, perhaps as it was before it was defined again."""
    if not isinstance(value, kind) and not is_again(type(value), kind):
        remedy = AGAIN.format(name_of(kind)) if name_of(type(value)) == name_of(kind) else ""
        raise checks.error(name, checks.with_article(kind.__name__), value, remedy)


def check_outcome(world, kernel, state, reward=0.0):
    """Raise ValueError, which names the kernel, unless the state that it left and the reward keep the rules."""
    try:
        world.check_state(state)
        checks.real("reward", reward)
    except ValueError as error:
        raise ValueError(f"the kernel {full_name(kernel)} broke a rule of worlds: after it, {error}") from None


def check_arrays(name, values, sizes):
    """Raise ValueError unless the arrays of a named tuple are finite and match their annotations."""
    for field, kind in fields(type(values)).items():
        value, path = getattr(values, field), f"{name}.{field}"
        if is_tuple(kind):
            check_kind(path, value, kind)
            check_arrays(path, value, sizes)
            continue
        dtype, shape = kind
        expected = tuple(length(each, sizes) for each in shape)
        if (type(value) is not np.ndarray or (value.dtype, value.shape) != (np.dtype(dtype), expected)
                or not value.flags.c_contiguous or not value.flags.writeable):
            found = f"{value.dtype} {value.shape}" if isinstance(value, np.ndarray) else checks.shown(value)
            raise ValueError(f"{path} must be {dtype} {expected}, contiguous and writeable, but is {found}")
        if value.dtype.kind == "f":
            checks.finite(path, value)
