"""Random search for the settings of tabular learners and of the PD controller, seeded and of equal size for each.

``python -m lib.alternatives.search search.csv`` draws `SETTINGS` settings of each from `RANGES`, tries each
in `RUNS` runs with 3 creeps on a seed that no reported run has, and writes their rewards per second in the last third.
The setting that earned most is used on both boards (`lib.alternatives.contestants`).
"""

import sys

import numpy as np

from lib.alternatives.controllers import Gains, pd
from lib.alternatives.living import BOARDS, live
from lib.alternatives.sight import Setting
from lib.alternatives.stored import FOLDER, SEARCH_FIELDS, append, chosen, read_search
from lib.alternatives.tabular_learners import TABULAR
from neorl import checks

SETTINGS, STEPS, RUNS, SEED = 256, 150_000, 4, 1_000
# A pair has the ends of a range from which a number is drawn log-uniformly; a list has the choices.
LEARNING = {"reach": [0.3, 0.5, 1.0], "warped": [False, True], "speeds": [1, 3, 5], "speed_width": (0.1, 2.0),
            "places": [1], "learning_rate": (0.01, 0.5), "discount": [0.9, 0.93, 0.95, 0.96, 0.97, 0.98, 0.99],
            "exploration": (0.001, 0.1), "first": [0.0, 0.1, 0.3, 0.5, 1.0]}
RANGES = {"monolithic": {"cells": [2, 3, 4, 5], **LEARNING, "places": [1, 2, 3]},
          "joint cells": {"cells": [3, 4, 5, 6, 7, 8, 9], **LEARNING},
          "hybrid reward": {"cells": [5, 7, 9, 11, 13, 15, 17, 19, 21], **LEARNING},
          "successor features": {"cells": [3, 4, 5, 6, 7, 8, 9], **LEARNING},
          "PD": {"approach": (0.5, 20.0), "fastest": (0.3, 8.0), "braking": (0.01, 0.6), "lead": (0.05, 5.0),
                 "fear": (0.01, 3.0), "fear_reach": (0.1, 0.6), "fear_lead": (0.005, 0.3), "rest": (0.2, 1.5)}}
MAKERS = {**TABULAR, "PD": pd}


def drawn(ranges, *place):
    """Draw a value from each of some ranges, {name: choices}, with the seed `place`, integers: {name: value}."""
    rng = np.random.default_rng(place)
    return {name: rng.choice(choices).item() if isinstance(choices, list) else
            float(np.exp(rng.uniform(*np.log(choices)))) for name, choices in ranges.items()}


def setting_of(method, number):
    """The setting at place `number` of a method's search, a `Setting` or `Gains`."""
    checks.one_of("method", method, tuple(RANGES))
    values = drawn(RANGES[method], SEED, [*RANGES].index(method), checks.integer("number", number, at_least=0))
    return (Gains if method == "PD" else Setting)(**values)


def evaluate(method, number):
    """Reward per second of a setting in the last third, a mean over runs."""
    lived = live(MAKERS[method](setting_of(method, number)), BOARDS[3], steps=STEPS, runs=RUNS, bins=3, seed=SEED)
    return float(lived.rewards[:, -1].mean() / (STEPS / 3 / BOARDS[3].fps))


def best_settings():
    """The best settings of the search: {method: `Setting` or `Gains`}."""
    return {method: setting_of(method, number)
            for method, number in chosen(read_search(FOLDER / "search.csv")).items()}


def main(path):
    """Try all settings, and append their rewards to the table at `path`."""
    for method in RANGES:
        for number in range(SETTINGS):
            append(path, SEARCH_FIELDS, (method, number, f"{evaluate(method, number):.4f}"))


if __name__ == "__main__":
    main(*sys.argv[1:])
