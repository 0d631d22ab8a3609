"""What a reading would give, predicted from the readings of the table by random forests, so that it need not be run.

The search chose by it which readings to run; now it says which choices matter (`companion.study.sensitivity`).
"""

import numpy as np

from companion.study.calibration_targets import GROUPS, TARGETS
from companion.thesis.priors import WITHIN
from companion.thesis.reading import TO_THE_LETTER
from neorl.common.extras import require

TREES, LEAF, FEWEST = 100, 3, 24  # of a forest: trees, fewest rows in a leaf, fewest rows to fit
FAR = 8.0  # scales: the emulator clips values that lie farther than this outside an interval
DIGITS = 4  # significant digits of a chosen number


def reading_at(shares):
    """The reading with each choice in `WITHIN` at a quantile of its prior, rounded; others are to the letter."""
    chosen = {name: _short(choice.at(share)) for (name, choice), share in zip(WITHIN.items(), shares)}
    return TO_THE_LETTER.varied(**chosen)


def _short(value):
    return float(f"{value:.{DIGITS}g}") if isinstance(value, float) else value


class Emulator:
    """Random forests that predict the statistics of a reading from its choices, one for each group with enough rows.

    A prediction's uncertainty combines the disagreement of the trees and the noise of a few runs. `explained` has the
    R² of each target in the rows of the design, each predicted by the trees that were grown without it.
    """

    def __init__(self, table, seed=0):
        self.forests, self.noise, self.explained = {}, {}, {}
        for group, members in GROUPS.items():
            rows = [row for row in table if group in row.groups]
            if len(rows) >= FEWEST:
                found = np.array([[row.statistics[name] for name in members.targets] for row in rows])
                scaled = [_clipped(TARGETS[name], found[:, i, 0]) / TARGETS[name].scale
                          for i, name in enumerate(members.targets)]
                forest = require("sklearn.ensemble", extra="book").RandomForestRegressor(
                    TREES, min_samples_leaf=LEAF, max_features=0.5, random_state=seed, oob_score=True)
                self.forests[group] = forest.fit(features([row.reading for row in rows]),
                                                 np.squeeze(np.transpose(scaled)))
                self.noise[group] = np.median(found[:, :, 1], axis=0)
                even = [i for i, row in enumerate(rows) if row.wave == 0]
                known, unseen = np.transpose(scaled)[even], forest.oob_prediction_.reshape(len(rows), -1)[even]
                residue = np.mean((known - unseen) ** 2, axis=0) / known.var(axis=0)
                self.explained |= dict(zip(members.targets, 1 - residue))

    def predict(self, readings):
        """The mean and the standard deviation of each predicted target: {name: (mean, deviation)}, (readings,) each."""
        at = features(readings)
        found = {}
        for group, forest in self.forests.items():
            trees = np.stack([tree.predict(at).reshape(len(at), -1) for tree in forest.estimators_])
            for i, name in enumerate(GROUPS[group].targets):
                scale = TARGETS[name].scale
                spread = np.hypot(scale * trees[..., i].std(axis=0), self.noise[group][i])
                found[name] = scale * trees[..., i].mean(axis=0), spread
        return found


def _clipped(target, values):
    ends = [end for end in (target.low, target.high) if np.isfinite(end)]
    return np.clip(values, min(ends) - FAR * target.scale, max(ends) + FAR * target.scale)


def features(readings):
    """Readings as the emulator sees them: float64 (readings, features).

    A number becomes its place in its prior, from 0 to 1; each level of a choice in words becomes a feature, 0 or 1.
    """
    chosen, columns = [reading.choices for reading in readings], []
    for name, choice in WITHIN.items():
        values = [each[name] for each in chosen]
        if isinstance(values[0], str):
            columns += [[value == level for value in values] for level in dict.fromkeys(choice.prior)]
        else:
            columns.append([choice.place(value) for value in values])
    return np.array(columns, float).T
