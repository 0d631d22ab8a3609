"""Verdicts: a claim of the thesis, our number for it, and the outcome of the claim's rule.

1. A verdict is *reproduced*, *partly* or *not reproduced*, by a rule in the code, the same for every reading of the
   thesis. The page of claims names the commit that fixed it and, with reasons, those that changed it.
2. *Reproduced* and *partly* need evidence: 95 % intervals that exclude the contrary, of the whole claim or of a part of
   it that the rule names. An interval that merely leaves room for a claim proves nothing.
3. An agent has *learned* if it finally earns more than Brownian motion on the same board. A claim that presupposes
   learning is *not testable* where agents have learned nothing; a claim that agents improve fails there.
4. With fewer than 10 runs per condition, or shorter ones than the claim's, there is *no verdict*.

Rewards are per simulated second and means over runs; early is the first tenth of a run, final the last fifth.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from neorl.evidence.statements import STATEMENTS, Bounds
from neorl.evidence.statistics import Estimate, difference, estimate

RUNS_FOR_A_VERDICT = 10
EARLY, MIDDLE, FINAL = (0.0, 0.1), (0.4, 0.6), (0.8, 1.0)
BEFORE_TURN, AFTER_TURN = (0.475, 0.5), (0.5, 0.525)  # of runs that change at half-time
VERDICTS = ("reproduced", "partly", "not reproduced", "not testable", "no verdict")


@dataclass(frozen=True)
class Claim:
    """The finding on one claim of `STATEMENTS`: our number with its interval, and the outcome of the rule."""

    name: str
    here: Estimate
    numbers: Mapping[str, tuple[Estimate, Bounds | None]]  # all that the rule reads, with the bounds it asks for
    runs: int
    outcome: str  # one of VERDICTS but the last, whatever the number of runs
    undecided: bool  # not reproduced, but the intervals leave room for it, so that more runs might show it
    full_length: bool = True  # whether the runs are as long as the claim's own

    @property
    def verdict(self):
        """The outcome, if runs are many and long enough for a verdict."""
        return self.outcome if self.full_length and self.runs >= RUNS_FOR_A_VERDICT else "no verdict"


def judged(name, here, runs, asked=None, shown=None, *, reproduced=None, partly=None, possible=None, testable=True):
    """The `Claim` of that name.

    here: our number, an `Estimate`. asked: {what: an `Estimate`, or {of what: `Estimate`}}, the other numbers that a
    reproduction asks for, with the bounds of `Statement.also` or those of our number. shown: numbers that are only
    reported. reproduced, partly, possible: by default whether all bounds are held, any are, and all leave room.
    """
    statement = STATEMENTS[name]
    asked, shown = ({f"{what}, {of}" if of else what: (found, statement.also.get(what, default))
                     for what, each in given.items()
                     for of, found in (each if isinstance(each, dict) else {"": each}).items()}
                    for given, default in ((asked or {}, statement.bounds), (shown or {}, None)))
    parts = [(here, statement.bounds), *asked.values()]
    held = [bounds.hold(found) for found, bounds in parts]
    reproduced, partly = all(held) if reproduced is None else reproduced, any(held) if partly is None else partly
    possible = all(bounds.allow(found) for found, bounds in parts) if possible is None else possible
    outcome = "not testable" if not testable else VERDICTS[0 if reproduced else 1 if partly else 2]
    numbers = asked | shown
    if here not in [found for found, _ in numbers.values()]:
        numbers = {statement.statistic: parts[0]} | numbers
    return Claim(name, here, numbers, runs, outcome, bool(testable and possible and not reproduced))


def lead_over_brownian(result, brownian):
    """The final lead of agents over Brownian motion on the same board, in reward per second, as an `Estimate`."""
    return estimate(difference, result.rate(*FINAL), brownian.rate())


def learned(result, brownian):
    """Whether agents finally earn more than Brownian motion on the same board."""
    return lead_over_brownian(result, brownian).low > 0


def share_of_run(minutes, result):
    """An `Estimate` in minutes, as a share of the runs of a result."""
    return Estimate(*(60 * each / result.seconds for each in minutes))


def fewest_runs(*results):
    """The smallest number of runs among results."""
    return min(result.runs for result in results)
