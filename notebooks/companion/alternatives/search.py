"""Random search for the settings of tabular learners, deep learners and the PD controller: seeded ranges and results.

``python -m companion.alternatives.search search.csv`` draws `SETTINGS` settings of each tabular learner and of PD from
`RANGES`, tries each in `RUNS` runs with 3 creeps on a seed that no reported run has, and writes their reward per second
in the last third. Deep learners have fewer and shorter tries (`companion.alternatives.deep_runs`). The setting that
earned most is used on both boards, and in long runs.

The ranges of deep learners are the second ones tried. In the first, with unscaled positions and γ of 0.95 or more, a
search over eight settings of each method for 51,000 steps found 0.28, 0.34 and 0.14 per second in the last third (DQN,
QR-DQN, PPO). Five runs of DQN by hand, with other scales, discounts and more updates, showed which ranges to widen.
"""

import csv
import sys
from pathlib import Path

import numpy as np

from companion.alternatives.controllers import Gains, pd
from companion.alternatives.contests import BOARDS, FOLDER, run_contestant
from companion.alternatives.tabular_learners import TABULAR, Setting
from neorl.common import checks

SETTINGS, STEPS, RUNS, SEED = 256, 150_000, 4, 1_000
DEEP_SETTINGS, DEEP_STEPS = 6, 36_000  # steps: a multiple of three minutes of 3,000
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
ANY = {"position_scale": [1.0, 2.0, 3.0, 5.0], "learning_rate": (1e-4, 2e-3), "gamma": LEARNING["discount"]}
REPLAY = ANY | {"batch_size": [32, 64, 128], "train_freq": [2, 4], "target_update_interval": [250, 500, 1_000, 2_500],
                "exploration_final_eps": [0.02, 0.05, 0.1], "exploration_steps": [10_000, 20_000, 40_000],
                "buffer_size": [20_000, 50_000, 150_000]}
DEEP = {"DQN": REPLAY,
        "QR-DQN": REPLAY,
        "PPO": ANY | {"batch_size": [64, 128], "n_steps": [256, 512, 1_024, 2_048], "n_epochs": [4, 10],
                      "gae_lambda": [0.8, 0.9, 0.95], "ent_coef": [0.0, 0.003, 0.01, 0.03]}}
WITH_DEFAULTS = "DQN", "PPO"  # have runs with nothing tuned too; those of QR-DQN would take most of the time
FIELDS = ("method", "number", "rate")


def drawn(ranges, *place):
    """Draw a value from each of some ranges, {name: choices}, with the seed `place`, integers: {name: value}."""
    rng = np.random.default_rng(place)
    return {name: rng.choice(choices).item() if isinstance(choices, list) else
            float(np.exp(rng.uniform(*np.log(choices)))) for name, choices in ranges.items()}


def setting_of(method, number):
    """The setting at place `number` of a method's search: a `Setting`, `Gains`, or {name: value} for a deep learner."""
    checks.one_of("method", method, (*RANGES, *DEEP))
    of_kind = RANGES if method in RANGES else DEEP
    values = drawn(of_kind[method], SEED, [*of_kind].index(method), checks.integer("number", number, at_least=0))
    return values if method in DEEP else Gains(**values) if method == "PD" else Setting(**values)


def evaluate(method, number):
    """Reward per second of a setting of a tabular learner or of PD in the last third, a mean over runs."""
    contestant = MAKERS[method](setting_of(method, number))
    earned = run_contestant(contestant, BOARDS[3], steps=STEPS, runs=RUNS, bins=3, seed=SEED)
    return float(earned.rates[:, -1].mean())


def rates():
    """The reward per second of every setting tried: {method: [rate of setting 0, …]}."""
    found = {}
    for path in (FOLDER / "search.csv", FOLDER / "deep_search.csv"):
        for method, number, rate in sorted(read(path)):
            found.setdefault(method, []).append(rate)
    return found


def best_settings():
    """The best setting of each method in the search, the first of equal ones: {method: as in `setting_of`}."""
    return {method: setting_of(method, int(np.argmax(each))) for method, each in rates().items()}


def read(path):
    """The rows of a table of a search: a list of (method, number, rate)."""
    with open(path, newline="") as file:
        return [(row["method"], int(row["number"]), float(row["rate"])) for row in csv.DictReader(file)]


def append(path, method, number, rate):
    """Append a row to a table of a search, which is created if it does not exist."""
    new = not Path(path).exists()
    with open(path, "a", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([*([FIELDS] if new else ()), (method, number, f"{rate:.4f}")])


def main(path):
    """Try all settings of tabular learners and PD, and append their rewards to the table at `path`."""
    for method in RANGES:
        for number in range(SETTINGS):
            append(path, method, number, evaluate(method, number))


if __name__ == "__main__":
    main(*sys.argv[1:])
