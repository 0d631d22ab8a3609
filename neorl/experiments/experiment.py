"""An experiment as a file: a condition, or several that differ in what the file says::

    steps = 150_000
    runs = 20
    seed = 0                                # what is left out is as by default
    world = { is = "WaterWorld", n_creeps = 8 }

    [agent]
    is = "place_cells"                      # one of the papers', or its nodes and desires in full
    resolutions = [3, 7, 23]
    learning = { memory = 10.0 }

    [variations.coarse]                     # if there are any, each is a condition, and the file without them is none
    agent.resolutions = [3]

    [variations.forgetful]
    agent.learning.memory = 1.0

A variation is what it says, and else what the file says: tables are put together field by field, unless the variation
names what the table is; all else takes the place of what was there. `neorl.core.description` says what tables can hold.
JSON holds the same.
"""

import re

from neorl.core.description import read_data
from neorl.experiments.cache import Condition


def read_experiment(path):
    """The conditions in a file that ends in .toml or .json: {name: `Condition`}, the name "" if there is one.

    Raises OSError if there is no such file, ValueError for anything else, with the path to it in the file.
    """
    data = read_data(path)
    variations = data.pop("variations", {"": {}})
    if not isinstance(variations, dict) or not variations:
        raise ValueError(f"{path}: variations is {variations!r}, allowed are tables, each with a name")
    conditions = {}
    for name, changes in variations.items():
        if not (isinstance(changes, dict) and re.fullmatch(r"[\w .+=-]*", name)):
            raise ValueError(f"{path}: variations.{name!r} is {changes!r}, allowed are tables whose names are letters, "
                             "digits, spaces and _.+=-")
        try:
            conditions[name] = Condition.from_dict(_merged(data, changes))
        except ValueError as error:
            raise ValueError(f"{path}: {f'variations.{name}: ' if name else ''}{error}") from error
    return conditions


def _merged(data, changes):
    both = {name: _merged(data[name], change) for name, change in changes.items()
            if isinstance(change, dict) and isinstance(data.get(name), dict) and not change.keys() & {"is", "kernel"}}
    return data | changes | both
