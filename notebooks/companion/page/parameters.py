"""What each parameter of a page must be, checked before anything runs.

A parameter is the same thing on every page that has it. Lists have no order and no duplicates: pages receive them
sorted. They may be texts, as papermill's option -p passes them.
"""

import ast
from functools import partial
from pathlib import Path

from companion.thesis.reading import READINGS
from neorl.common import checks

FINEST = 90  # intervals per axis, of the finest map in the thesis
MOST_CREEPS = 20  # as in the Explorer


def listed(values):
    """A list of numbers, or its text, as a sorted tuple."""
    return tuple(sorted(_from_text(values)))


def _list(name, values, each, fewest=1):
    """A list of at least `fewest` different values, each checked by `each`; of one value where it is a text of one."""
    try:
        values = checks.several(name, _from_text(values))
    except (ValueError, TypeError, SyntaxError, RecursionError, MemoryError):
        raise checks.error(name, "a list of numbers", values, "write it as [5, 11]") from None
    if fewest <= len({each(name, value) for value in values}) == len(values):
        return
    raise checks.error(name, f"a list of {fewest} or more numbers, all different", list(values))


def _from_text(values):
    return ast.literal_eval(values) if isinstance(values, str) else values


def _file(name, value):
    path = Path(checks.instance(name, value, str))
    if value and (path.is_dir() or not path.parent.is_dir()):
        raise checks.error(name, "a file in a folder that exists", value)


def _whole(at_least, at_most=None):
    return partial(checks.integer, at_least=at_least, at_most=at_most)


def _number(at_least, at_most):
    return partial(checks.real, at_least=at_least, at_most=at_most)


def _one_of(choices):
    return lambda name, value: checks.one_of(name, value, choices)


RESOLUTION = _whole(1, FINEST)
RULES = {
    "reading": _one_of(tuple(READINGS)), "runs": _whole(1), "steps": _whole(1), "seed": _whole(0),
    "n": RESOLUTION, "resolution": _whole(1, 50),  # of the only map of a page's agents, of up to 0.1 GB
    "resolutions": partial(_list, each=RESOLUTION),
    "layers": partial(_list, each=RESOLUTION), "counts": partial(_list, each=_whole(1, 6)),
    "stays": partial(_list, each=_whole(1, 1_000)), "n_creeps": _whole(1, MOST_CREEPS),
    "place_gain": _number(0, 100), "recursion": _number(-100, 100), "learning_rate": _number(1e-3, 1),
    "exploration": _number(0, 1), "memory": _whole(1, 8), "bonus": _number(0, 10), "begin": _number(0.1, 0.9),
    "traffic": _whole(0, 64), "decisions": _whole(200), "sample": _whole(0, 100), "episodes": _whole(0),
    "keep": _file,
}


def check(fewest=(), /, **parameters):
    """Check parameters by name. fewest: {name: the smallest number, or the length of the shortest list, on this page}.

    Raises ValueError for one that is not what it must be.
    """
    fewest = dict(fewest)
    for name, value in parameters.items():
        rule = RULES[name]
        if name in fewest:
            rule = partial(rule, **{"fewest" if rule.func is _list else "at_least": fewest[name]})
        rule(name, value)
