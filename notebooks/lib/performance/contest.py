"""How long rival implementations take for the same stretch, measured in turns."""

from time import perf_counter
from typing import NamedTuple

import numpy as np

from lib.performance import rivals
from lib.performance.bound import LIVED, bare
from lib.performance.timing import in_turns, times_as_long
from neorl.worlds.waterworld import WaterWorld

STRETCH = 1_000  # timed steps, at most


class Contest(NamedTuple):
    """Seconds per step of several implementations, {name: float64 (rounds,)}, the package's own first."""

    what: str
    seconds: dict
    absent: tuple  # names of packages that are not installed

    @property
    def ratios(self):
        """Time of each implementation as a multiple of the package's, {name: `Estimate`}."""
        own, *others = self.seconds
        return {name: times_as_long(self.seconds[name], self.seconds[own]) for name in others}


def agents(steps, rounds, seed=0, resolution=23):
    """Time the steps of one agent without a world, at most `STRETCH`: a `Contest`."""
    stretch = rivals.record(resolution, min(steps, STRETCH), LIVED, seed)
    heads = rivals.heads_of(stretch.q)
    ways = {"neoRL": lambda: _of_copies(rivals.by_kernel, stretch, stretch.q, stretch.goal_range),
            "NumPy": lambda: _of_copies(rivals.by_numpy, stretch, stretch.q),
            "an object for each goal": lambda: lambda: rivals.by_heads(stretch, heads)}
    if rivals.is_installed("jax"):
        scan = rivals.by_jax(stretch)
        ways["JAX"] = lambda: _of_device(scan, stretch.q)
    return _contest(f"a step of an agent with N{resolution}", ways, len(stretch.learns), rounds,
                    () if "JAX" in ways else ("JAX",))


def worlds(steps, rounds, seed=0):
    """Time steps of WaterWorld with three creeps and random actions, at most `STRETCH`: a `Contest`."""
    world, steps = WaterWorld(), min(steps, STRETCH)
    ways = {"neoRL": bare(world, steps, seed)}
    if rivals.is_installed("ple"):
        original = rivals.ple_steps(world.width, world.n_creeps, steps, seed)
        ways["PLE"] = lambda: original
    return _contest("a step of WaterWorld", ways, steps, rounds, () if "PLE" in ways else ("PLE",))


def _contest(what, ways, steps, rounds, absent):
    seconds = in_turns(ways, rounds, perf_counter)
    return Contest(what, {name: each / steps for name, each in seconds.items()}, absent)


def _of_copies(function, stretch, *arrays):
    """A call with copies of arrays that are made before the timing."""
    copies = [array.copy() for array in arrays]
    return lambda: function(stretch, *copies)


def _of_device(scan, q):
    """A call of a JAX program whose values are put on its device before the timing."""
    import jax

    values = jax.block_until_ready(jax.device_put(np.array(q), jax.devices("cpu")[0]))
    return lambda: scan(values)
