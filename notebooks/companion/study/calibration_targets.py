"""The targets of the calibration: the thesis's printed numbers with tolerances, stated before any calibration run.

1. A *target* is a statistic of one reading and the interval that agrees with the thesis; the page on the search says
   how wide intervals are, and why. Rewards are per simulated second, of the mean over runs, which is what the thesis
   plots.
2. An agent that earns no more than Brownian motion has learned nothing. So where a statistic divides by an agent's
   reward, the divisor is at least that of Brownian motion: a ratio of two failures is no success.
3. The *error* of a statistic is its standard error over runs, by the jackknife: each run in turn is left out of every
   condition. The *distance* to a target is how far the value lies outside its interval, in units that combine the
   target's scale and the error.
4. Targets belong to *groups* of conditions that are computed together.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from companion.page.marks import DECIDED
from companion.thesis.measures import EARLY, FINAL
from companion.thesis.statements import STATEMENTS, VISIBLE, Bounds
from neorl.common import checks
from neorl.statistics import Estimate

BROWNIAN_A, BROWNIAN_B = 0.03, 0.1  # what Brownian motion earns per second with 8 creeps and with 3
NOISE = 0.03  # reward per second: spread of the mean of a few runs, in trials before the targets were stated
LEAD = VISIBLE.low  # reward per second
WINDOW = 1 / 40  # of a run: over which the mean reward per second counts as reaching a level
HALF_A_WINDOW = 200 * WINDOW / 2  # minutes, of paper B's runs
DIGITS = 5  # significant digits of a stored statistic


class Measure(NamedTuple):
    """The value of a statistic over a few runs, and its standard error."""

    value: float
    error: float


@dataclass(frozen=True)
class Target:
    """A statistic, and the interval in which it agrees with the thesis."""

    claim: str  # a name of `companion.thesis.statements`
    label: str
    statistic: Callable  # of {key of the condition: `Result`}
    low: float  # or infinite, as high
    high: float
    scale: float  # how far outside counts as a distance of 1
    thesis: str  # what is printed
    reason: str  # why the interval is as wide as it is

    def holds(self, value):
        """Whether a value agrees with the thesis."""
        return self.low <= value <= self.high

    def mark(self, value, error):
        """How a value agrees, two errors on either side: ✓ inside, ✗ outside, or ? across an end."""
        found = Estimate(value, value - 2 * error, value + 2 * error)
        return DECIDED[Bounds(self.low, self.high).decide(found)]

    def distance(self, value, error=0.0):
        """How far a value lies outside the interval: ≥ 0, see point 3 of the module. Takes numbers and arrays."""
        outside = np.maximum(np.maximum(self.low - value, value - self.high), 0.0)
        return outside / np.hypot(self.scale, error)


def _final(result):
    return result.rate(*FINAL).mean()


def _early(result):
    return result.rate(*EARLY).mean()


def _whole(result):
    return result.rate().mean()


def _ratio(above, below, least):
    return above / max(below, least)


def _minutes(result, share=0.9):
    """Simulated minutes until the mean over runs reaches a share of its final level."""
    alone = replace(result.condition, runs=1)
    mean = replace(result, condition=alone, rewards=result.rewards.mean(axis=0, keepdims=True))
    return float(time_to_final_level(mean, share)[0]) / 60


def time_to_final_level(result, share=0.9):
    """When each run first reaches `share` of its final level: float64 (runs,), in simulated seconds.

    The final level is a run's own reward per second in its last fifth. A run reaches it when the mean over the
    preceding fortieth of the run does; where it is never reached, or not positive, the time is the whole run. So times
    are half a window later than those of the middle of the window, and bounds are as well. The rules have another
    measure since (`companion.thesis.measures`); the table is of this one.
    """
    final, edges = result.rate(*FINAL), result.edges
    width = max(1, round(WINDOW * result.rewards.shape[1]))
    sums = np.pad(result.rewards.cumsum(axis=1, dtype=float), ((0, 0), (1, 0)))
    rates = (sums[:, width:] - sums[:, :-width]) / (edges[width:] - edges[:-width])
    reached = rates >= np.where(final > 0, share * final, np.inf)[:, None]
    return np.where(reached.any(axis=1), edges[width:][reached.argmax(axis=1)], result.seconds)


def _surplus(results, rate):
    return rate(results["layers"]) - sum(rate(results["layer", n]) for n in (3, 7, 23))


def _evenness(results):
    """The shortest time to half of a single map's own final level, divided by the longest; 0 if one learns nothing."""
    each = [results["single", n] for n in (10, 30, 50)]
    minutes = [_minutes(result, 0.5) for result in each]
    return min(minutes) / max(minutes) if min(map(_final, each)) > BROWNIAN_A else 0.0


def _as_in_the_rule(claim, label, statistic, bounds: Bounds, scale, reason):
    """The target that a rule's bounds state, and the thesis's number if there is one."""
    return Target(claim, label, statistic, bounds.low, bounds.high, scale,
                  STATEMENTS[claim].thesis if bounds.number is None else f"{bounds.number:g}",
                  f"{bounds}, as in the rule{reason}")


def _minutes_of_place(results):
    """Minutes of place cells; 0 if they have not learned, since there is then no level that takes long to reach."""
    place = results["place", "all"]
    return _minutes(place) if _final(place) > BROWNIAN_B else 0.0


def _later(bounds):
    """Bounds of times in the middle of a window, as bounds of times at its end."""
    return replace(bounds, low=bounds.low + HALF_A_WINDOW, high=bounds.high + HALF_A_WINDOW)


HALF_LATER = ", half a window later"
OF_THE_SEARCH = " at the time of the search"
ORDER = "an ordering, without a number: any lead that is visible in a figure agrees"
TARGETS = {
    # paper A, figure 7: {3, 7, 23} and each alone
    "A7 ratio": _as_in_the_rule(
        "A7", "three maps / N7", lambda of: _ratio(_final(of["layers"]), _final(of["layer", 7]), BROWNIAN_A),
        STATEMENTS["A7"].bounds, 0.5, ": the thesis does not say of which part of the run"),
    "A7 pace": Target(
        "A7", "three maps − N7, early", lambda of: _early(of["layers"]) - _early(of["layer", 7]),
        0.0, math.inf, NOISE, "as fast or a little faster",
        "no loss, without a number"),
    "A6 surplus": Target(
        "A6", "three maps − sum, final", lambda of: _surplus(of, _final), LEAD, math.inf, NOISE, "higher than the sum",
        ORDER),
    "A6 pace": Target(
        "A6", "three maps − sum, whole run", lambda of: _surplus(of, _whole), LEAD, math.inf, NOISE,
        "quicker than the sum", ORDER),
    # paper B, figures 4 and 5
    "B3 place": _as_in_the_rule(
        "B3", "place cells, final", lambda of: _final(of["place", "all"]), STATEMENTS["B3"].also["place cells"], NOISE,
        ": read off a smoothed curve, with a filter that is not given"),
    "B3 both": _as_in_the_rule(
        "B3", "both, final", lambda of: _final(of["both"]), STATEMENTS["B3"].bounds, NOISE, ""),
    "B1 level": _as_in_the_rule(
        "B1", "object-vector / place", lambda of: _ratio(_final(of["objects", "all"]), _final(of["place", "all"]),
                                                         BROWNIAN_B), Bounds(0.8, 1.25), 0.1, OF_THE_SEARCH),
    "B4 both": _as_in_the_rule(
        "B4", "minutes of both", lambda of: _minutes(of["both"]), _later(STATEMENTS["B4"].bounds), 10.0, HALF_LATER),
    "B4 place": _as_in_the_rule(
        "B4", "minutes of place cells", _minutes_of_place, _later(STATEMENTS["B4"].also["place cells"]), 20.0,
        f"{HALF_LATER}; the level counts as reached at nine tenths"),
    # paper C, figure 4e
    "C1 rise": Target(
        "C1", "A, final − early or chance",
        lambda of: _final(of["network", "A"]) - max(_early(of["network", "A"]), BROWNIAN_B),
        LEAD, math.inf, NOISE, "improves over time", ORDER + "; without learning there is no improvement"),
    "C1 weak": replace(_as_in_the_rule(
        "C1", "A / C", lambda of: _ratio(_final(of["network", "A"]), _final(of["network", "C"]), BROWNIAN_B),
        Bounds(high=0.5), 0.1, OF_THE_SEARCH), thesis="too simple for proficient navigation"),
    "C2": Target(
        "C2", "B − A, final", lambda of: _final(of["network", "B"]) - _final(of["network", "A"]),
        LEAD, math.inf, NOISE, "increased performance", ORDER),
    "C3": Target(
        "C3", "C − better of A, B", lambda of: (_final(of["network", "C"])
                                               - max(_final(of["network", name]) for name in "AB")),
        LEAD, math.inf, NOISE, "better navigators", ORDER),
    "C4": _as_in_the_rule(
        "C4", "D / C", lambda of: _ratio(_final(of["network", "D"]), _final(of["network", "C"]), BROWNIAN_B),
        STATEMENTS["C4"].bounds, 0.2, ""),
    # paper A, figure 6
    "A2": Target(
        "A2", "worst of N10, N30, N50", lambda of: min(_whole(of["single", n]) for n in (10, 30, 50)),
        BROWNIAN_A, math.inf, NOISE, "better than control", "what Brownian motion earns"),
    "A3 early": Target(
        "A3", "N10 − N50, early", lambda of: _early(of["single", 10]) - _early(of["single", 50]),
        LEAD, math.inf, NOISE, "coarse maps learn quicker initially", ORDER),
    "A3 final": Target(
        "A3", "N50 − N10, final", lambda of: _final(of["single", 50]) - _final(of["single", 10]),
        LEAD, math.inf, NOISE, "coarse maps saturate lower", ORDER),
    "A4": Target(
        "A4", "N50 − best of N10, N30", lambda of: (_whole(of["single", 50])
                                                   - max(_whole(of["single", n]) for n in (10, 30))),
        LEAD, math.inf, NOISE, "N50 achieves the highest score", ORDER),
    "A5": _as_in_the_rule(
        "A5", "times to half level of N10, N30, N50, least / most", _evenness, STATEMENTS["A5"].bounds, 0.1, ""),
}


@dataclass(frozen=True)
class Group:
    """Conditions that are computed together, by keys of `reading.conditions`, and the targets they suffice for."""

    keys: tuple
    targets: tuple[str, ...]

    @property
    def paper(self):
        """The paper whose numbers its targets are: "A", "B" or "C"."""
        return self.targets[0][0]


def _group(keys, *claims):
    return Group(keys, tuple(name for name, target in TARGETS.items() if target.claim in claims))


GROUPS = {
    "places": Group((("place", "all"),), ("B3 place", "B4 place")),
    "layers": _group((("layer", 3), ("layer", 7), ("layer", 23), "layers"), "A6", "A7"),
    "objects": Group((("place", "all"), ("objects", "all")), ("B1 level",)),
    "both": Group(("both",), ("B3 both", "B4 both")),
    "networks": _group(tuple(("network", name) for name in "ABCD"), "C1", "C2", "C3", "C4"),
    "single": _group((("single", 10), ("single", 30), ("single", 50)), "A2", "A3", "A4", "A5"),
}
CLAIMS = tuple(sorted({target.claim for target in TARGETS.values()}))


def measure(group, results):
    """The statistics of one of `GROUPS`: {name of the target: `Measure`}, rounded to 5 significant digits.

    results: {key of the condition: `Result`}, of two runs or more, or ValueError is raised.
    """
    chosen = GROUPS[group]
    results = {key: results[key] for key in chosen.keys}
    runs = checks.integer("runs", min(result.runs for result in results.values()), at_least=2)
    without = [{key: _without(result, run) for key, result in results.items()} for run in range(runs)]
    found = {}
    for name in chosen.targets:
        statistic = TARGETS[name].statistic
        error = np.sqrt(runs - 1) * np.std([statistic(each) for each in without])
        found[name] = Measure(_rounded(statistic(results)), _rounded(error))
    return found


def _without(result, run):
    fewer = replace(result.condition, runs=result.runs - 1)
    return replace(result, condition=fewer, rewards=np.delete(result.rewards, run, axis=0))


def _rounded(value):
    return float(f"{value:.{DIGITS}g}")


def distance(statistics):
    """The root mean square distance of {name: `Measure`} from their targets, each 4 at most."""
    if not statistics:
        return math.inf
    each = [min(TARGETS[name].distance(*found), 4.0) for name, found in statistics.items()]
    return float(np.sqrt(np.mean(np.square(each))))
