"""Results for other programs: as tables of pandas and xarray, and as self-describing files.

A saved result is an npz file of its arrays, rewards and hits, and a text, about: a table in JSON with the agent, the
world and everything else that determined it, as plain data (`neorl.core.description`), and the version of neorl.
"""

import json
import sys

import numpy as np

from neorl import checks
from neorl.agents.agent import Agent
from neorl.core.description import checked, described, restored
from neorl.experiments.run import bin_steps
from neorl.extras import require
from neorl.files import read_arrays, write_arrays
from neorl.worlds.world import World

OF_A_CONDITION = {"agent": Agent, "world": World, "steps": int, "runs": int, "seed": int,
                  "changes": tuple[tuple[int, Agent], ...]}


def version():
    """The version of neorl, read without an import, since the package is above this room."""
    return sys.modules["neorl"].__version__


def about(condition):
    """Everything that determines a `neorl.Condition` or `neorl.Result`, as plain data.

    Raises ValueError for an agent or a world that cannot be imported by name.
    """
    return {"neorl": version(), **{name: described(getattr(condition, name), kind, name)
                                   for name, kind in OF_A_CONDITION.items()}}


def note(condition, source):
    """The JSON text stored with a condition: the digest of its source, and everything that determines it."""
    try:
        known = about(condition)
    except ValueError:  # its agent or world cannot be imported by name, but it was run, and is cached
        known = {"neorl": version(), **{name: getattr(condition, name) for name in OF_A_CONDITION}}
    return np.array(json.dumps({"source": source, **known}, default=repr))


def to_frame(result):
    """See `neorl.Result.to_frame`."""
    runs, bins = result.rewards.shape
    columns = {"run": np.repeat(np.arange(runs), bins), "time": np.tile(result.time, runs),
               "reward": result.rewards.reshape(-1)}
    columns |= {f"hits_{kind}": result.hits[:, :, i].reshape(-1) for i, kind in enumerate(result.world.kinds)}
    return require("pandas", extra="data").DataFrame(columns, copy=True)


def to_xarray(result):
    """See `neorl.Result.to_xarray`."""
    xarray = require("xarray", extra="data")
    known = about(result)
    texts = {name: json.dumps(known[name], ensure_ascii=False) for name in ("agent", "world", "changes")}
    return xarray.Dataset(
        {"rewards": (("run", "time"), result.rewards.copy(), {"long_name": "reward in the bin that ends then"}),
         "hits": (("run", "time", "kind"), result.hits.copy(), {"long_name": "things met in the bin that ends then"})},
        {"run": np.arange(result.runs), "kind": np.array(result.world.kinds, str),
         "time": ("time", result.time, {"units": "s", "long_name": "simulated time"})},
        {**texts, "steps": result.steps, "runs": result.runs, "seed": str(result.seed), "neorl": known["neorl"]})


def save(result, path):
    """See `neorl.Result.save`."""
    arrays = {"rewards": result.rewards, "hits": result.hits}
    write_arrays(checks.path("path", path), "Result", about(result), arrays, np.savez_compressed)


def load(path):
    """The fields of the `neorl.Result` in a file, see `neorl.Result.load`."""
    path = checks.path("path", path)
    known, arrays = read_arrays(path, "Result")
    try:
        fields = {name: checked(restored(known.get(name), kind, name), kind, name)
                  for name, kind in OF_A_CONDITION.items()}
        steps, runs = (checks.integer(name, fields[name], at_least=1) for name in ("steps", "runs"))
        checks.integer("seed", fields["seed"], at_least=0)
        times = [0, *(step for step, _ in fields["changes"]), steps]
        if times != sorted(times):
            raise checks.error("changes", "pairs in order of time, within the run", fields["changes"])
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from error
    bins = -(-steps // bin_steps(fields["world"]))
    for name, dtype, shape in (("rewards", np.float32, (runs, bins)),
                               ("hits", np.int16, (runs, bins, len(fields["world"].kinds)))):
        found = arrays.get(name, np.empty(0))
        if (found.dtype, found.shape) != (dtype, shape):
            raise ValueError(f"{path}: {name} must be {dtype.__name__} {shape}, but is {found.dtype} {found.shape}")
    return fields | {name: arrays[name] for name in ("rewards", "hits")}
