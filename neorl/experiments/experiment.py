"""An experiment as a file: a condition, or several variations of one::

    steps = 150_000
    runs = 20
    seed = 0  # anything left out has its default
    world = { is = "WaterWorld", n_creeps = 8 }

    [agent]
    is = "place_cells"  # one of the papers' agents, or nodes and desires
    resolutions = [3, 7, 23]
    learning = { memory = 10.0 }

    [variations.coarse]  # with variations, they alone are the conditions
    agent.resolutions = [3]

    [variations.forgetful]
    agent.learning.memory = 1.0

A variation overrides the file: tables are merged field by field, unless the variation's table has an ``is`` or
``kernel`` of its own; all other values are replaced. `neorl.core.description` describes what tables can hold. A JSON
file has the same structure.
"""

import re

from neorl import checks
from neorl.core.description import read_data
from neorl.experiments.cache import Condition


def read_experiment(path):
    """The conditions in a .toml or .json file: {name: `Condition`}, with the name "" if there are no variations.

    Raises OSError if there is no such file, ValueError for anything else, with its path within the file.
    """
    data = read_data(path)
    variations = data.pop("variations", {"": {}})
    if not isinstance(variations, dict) or not variations:
        raise checks.error(f"{path}: variations", "tables, each with a name", variations)
    conditions = {}
    for name, changes in variations.items():
        if not (isinstance(changes, dict) and re.fullmatch(r"[\w .+=-]*", name)):
            raise checks.error(f"{path}: variations.{name!r}", "a table whose name has letters, digits, spaces and "
                               "_.+=-", changes)
        try:
            conditions[name] = Condition.from_dict(_merged(data, changes))
        except ValueError as error:
            raise ValueError(f"{path}: {f'variations.{name}: ' if name else ''}{error}") from error
    return conditions


def _merged(data, changes):
    both = {name: _merged(data[name], change) for name, change in changes.items()
            if isinstance(change, dict) and isinstance(data.get(name), dict) and not change.keys() & {"is", "kernel"}}
    return data | changes | both
