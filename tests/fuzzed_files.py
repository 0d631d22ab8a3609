"""Files of a stranger's, altered and with a sound digest: the engine of `test_fuzzed_files.py`.

    python tests/fuzzed_files.py FIRST STEP    loads every so many altered files in a process of their own

A setting alters one array of a file, or one number of its metadata. A process prints each setting before it loads the
file. It must not crash, and the setting must end in an error that is a sentence, or in a run that goes on for 2,000
steps.
"""

import copy
import faulthandler
import itertools
import sys
import tempfile
import warnings
from pathlib import Path

import numpy as np
from saved_files import contents, rewrite

from neorl import (Contacts, Learner, Result, Run, Scene, WaterWorld, forager, multimodal, network_d,
                   object_vector_cells, place_cells, simulate)
from neorl.agents.spaces import pilot, reacher, swimmer
from neorl.worlds import Arm, Vessel, WaterMaze

TANK = WaterWorld(n_creeps=3)
WILD = {"f": (np.nan, np.inf, -1.0, 1e6, 1e30, -1e300, 5e-324), "i": (-1, 0, 3, 10**6, 2**31, 2**62, -(2**63)),
        "u": (0, 1, 2**64 - 1), "b": (0, 1, 255)}
SHAPES = (lambda array: array.reshape(-1)[:0], lambda array: np.repeat(array, 2, axis=0) if array.ndim else array,
          lambda array: array.astype(np.float32), lambda array: array.astype("U9"))
NUMBERS = (-1, 0, 3, 10**6, 2**70, 1e300, "a", None, [], {})


def learner():
    learner = Learner(network_d([3, 5]), 2, ("green", "red"))
    learner.begin(Scene((0.2, 0.2), None, [(0.4, 0.4), (0.8, 0.8)], (0, 1)))
    learner.act()
    return learner


def advanced(agent, world):
    run = Run(agent, world)
    run.advance(1_500)
    return run


SOURCES = {
    "network": lambda: advanced(network_d([3, 5]), TANK), "contacts": lambda: advanced(forager([5, 9]), TANK),
    "after-states": lambda: advanced(forager([5, 9], contacts=Contacts(efference=0.25)), TANK),
    "self": lambda: advanced(object_vector_cells([3, 5], object_state="self"), TANK),
    "objects": lambda: advanced(multimodal([3, 4], object_state="object"), TANK),
    "arm": lambda: advanced(reacher(2), Arm((0.5, 0.5))), "vessel": lambda: advanced(pilot(), Vessel()),
    "maze": lambda: advanced(swimmer(), WaterMaze([(0.5, 0.5), (0.4, 0.6)])), "learner": learner,
    "result": lambda: simulate(place_cells([3]), TANK, steps=500, runs=2, progress=False)}
KINDS = {"learner": Learner, "result": Result}


def alterations(path):
    """All alterations of a file: functions (about, arrays) with their names."""
    about, arrays = contents(path)
    for name, array in arrays.items():
        for value, everywhere in itertools.product(WILD.get(array.dtype.kind, ()), (False, True)):
            yield f"{name} {'all' if everywhere else 'one'} {value}", altering(name, value, everywhere)
        for s, shape in enumerate(SHAPES):
            yield f"{name} shape {s}", lambda about, arrays, name=name, shape=shape: arrays.update(
                {name: shape(arrays[name])})
        yield f"{name} absent", lambda about, arrays, name=name: arrays.pop(name)
    for place, number in itertools.product(list(places_of(about)), NUMBERS):
        yield f"about {place} {number!r}", lambda about, arrays, place=place, number=number: put(about, place, number)


def altering(name, value, everywhere):
    def alter(about, arrays):
        array = arrays[name] = np.array(arrays[name])
        if array.size:
            with np.errstate(all="ignore"):
                wild = np.array(value).astype(array.dtype)
            array[...] = wild if everywhere else array
            array.flat[array.size // 2] = wild

    return alter


def places_of(data, path=()):
    """The places of all numbers and texts in plain data."""
    items = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    for key, value in items:
        yield (*path, key)
        yield from places_of(value, (*path, key))


def put(data, place, value):
    for key in place[:-1]:
        data = data[key]
    data[place[-1]] = copy.deepcopy(value)


def go_on(loaded):
    """Use what was loaded, as its owner would."""
    if isinstance(loaded, Run):
        loaded.advance(2_000)
        loaded.change(loaded.agent)
        loaded.record(100)
    elif isinstance(loaded, Learner):
        for _ in range(200):
            if loaded._progress == "to act":
                loaded.act()
            loaded.observe(Scene((0.3, 0.6), None, [(0.4, 0.4), (0.8, 0.2)], (1, 0)))
    else:
        loaded.rate()


def settings(folder):
    """All settings: (name, path, kind, alteration)."""
    for name, make in SOURCES.items():
        path = Path(folder) / f"{name}.npz"
        make().save(path)
        for which, alter in alterations(path):
            yield f"{name}: {which}", path, KINDS.get(name, Run), alter


def attempt(name, path, kind, alter):
    """Load an altered file, and return "error" or "result"."""
    print(name, flush=True)
    altered = path.with_suffix(".altered.npz")
    rewrite(path, alter, altered)
    try:
        go_on(kind.load(altered))
    except (ValueError, MemoryError, RuntimeError) as error:
        assert "must" in str(error) or isinstance(error, MemoryError), f"{name}: {error}"
        return "error"
    return "result"


def attempt_all(first, step):
    """Load altered files in this process, and return whether all have passed."""
    faulthandler.enable()
    warnings.simplefilter("error")
    outcomes = {"error": 0, "result": 0, "FAILED": 0}
    with tempfile.TemporaryDirectory() as folder:
        for setting in itertools.islice(settings(folder), first, None, step):
            try:
                outcomes[attempt(*setting)] += 1
            except Exception as error:
                outcomes["FAILED"] += 1
                print("FAILED", setting[0], type(error).__name__, str(error)[:600], flush=True)
    print(outcomes, flush=True)
    return not outcomes["FAILED"]


if __name__ == "__main__":
    sys.exit(0 if attempt_all(*map(int, sys.argv[1:])) else 1)
