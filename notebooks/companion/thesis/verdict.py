"""Verdicts: a claim of the thesis, our number for it, and the outcome of the claim's rule.

1. A verdict follows from 95 % intervals, by a rule in the code, the same for every reading of the thesis. The page of
   claims names the commit that fixed it and, with reasons, those that changed it.
2. Each number that a rule asks for lies within its bounds (true), outside them (false) or across one of them (open).
   A claim is *reproduced* if all are true. If one is false, so is the claim as a whole: it is then *partly* true if a
   part that the rule names is, and *contradicted* if no part is. Otherwise it is *undecided*: more runs would tell.
3. An agent has *learned* if it finally earns more than Brownian motion on the same board. A claim that presupposes
   learning is *not testable* where intervals show that agents have not learned; a claim that agents improve is false
   there.
4. A claim that is contradicted by a proof, or by one example, says so in place of "contradicted".
5. With fewer than 10 runs per condition, or shorter ones than the claim's, there is *no verdict*.

Rewards are per simulated second and means over runs; early is the first tenth of a run, final the last fifth.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from companion.thesis.statements import STATEMENTS, Bounds
from neorl.statistics import Estimate, difference, estimate

RUNS_FOR_A_VERDICT = 10
EARLY, MIDDLE, FINAL = (0.0, 0.1), (0.4, 0.6), (0.8, 1.0)
BEFORE_TURN, AFTER_TURN = (0.475, 0.5), (0.5, 0.525)  # of runs that change at half-time
VISIBLE = 0.01  # reward per second: the smallest lead that a figure shows
VERDICTS = ("reproduced", "partly", "contradicted", "undecided", "not testable", "refuted by proof",
            "counter-example found", "no verdict")
CONTRADICTED = {"proof": "refuted by proof", "report": "counter-example found"}  # of a kind of statement
FAILED = ("contradicted", *CONTRADICTED.values())


@dataclass(frozen=True)
class Claim:
    """The finding on one claim of `STATEMENTS`: our number with its interval, and the outcome of the rule.

    numbers: {what: (`Estimate`, `Bounds` or None, role)}, all that the rule reads. The role is "asked", of a number
    that the claim as a whole asks for; "part", of one that makes it partly true; "both"; or "shown", of one without
    bounds. Without "part" and "both", each number that is asked for makes it partly true.
    """

    name: str
    here: Estimate
    numbers: Mapping[str, tuple[Estimate, Bounds | None, str]]
    runs: int
    outcome: str  # one of VERDICTS but the last, whatever the number of runs
    full_length: bool = True  # whether the runs are as long as the claim's own

    @property
    def verdict(self):
        """The outcome, if runs are many and long enough for a verdict."""
        return self.outcome if self.full_length and self.runs >= RUNS_FOR_A_VERDICT else "no verdict"


def judged(name, here, runs, asked=None, shown=None, part=None, testable=True):
    """The `Claim` of that name.

    here: our number, an `Estimate`, which a reproduction asks for. asked, part, shown: {what: an `Estimate`, or {of
    what: `Estimate`}}. asked: the other numbers that a reproduction asks for. part: those of which any makes the claim
    partly true; by default all that are asked for. shown: numbers that are only reported. Bounds are those of
    `Statement.also`, or else of our number. testable: True, False or None, see `learned`.
    """
    statement = STATEMENTS[name]
    numbers = {}
    for role, some in (("asked", asked), ("part", part), ("shown", shown)):
        for what, named in (some or {}).items():
            for of, found in (named if isinstance(named, dict) else {"": named}).items():
                bounds = None if role == "shown" else statement.also.get(what, statement.bounds)
                label = f"{what}, {of}" if of else what
                numbers[label] = found, bounds, "both" if role == "part" and label in numbers else role
    if (here, statement.bounds) not in [each[:2] for each in numbers.values() if each[2] in ("asked", "both")]:
        numbers = {statement.statistic: (here, statement.bounds, "asked")} | numbers
    found = outcome({what: (bounds.decide(each) if bounds else None, role)
                     for what, (each, bounds, role) in numbers.items()}, testable)
    return Claim(name, here, numbers, runs,
                 CONTRADICTED.get(statement.kind, found) if found == "contradicted" else found)


def outcome(decided, testable=True):
    """What the numbers of a rule decide: {what: (True, False or None, role)}, see `Claim`."""
    if testable is False:
        return "not testable"
    asked, part = ([true for true, role in decided.values() if role in (kind, "both")] for kind in ("asked", "part"))
    whole, some = all_of(asked), any_of(part or asked)
    if testable and whole:
        return "reproduced"
    if testable and whole is False and some is not None:
        return "partly" if some else "contradicted"
    return "undecided"


def all_of(truths):
    """Whether all are true: False if one is false, else None if one is open (Kleene's logic)."""
    truths = [*truths]
    return False if False in truths else None if None in truths else True


def any_of(truths):
    """Whether any is true: True if one is, else None if one is open."""
    truths = [*truths]
    return True if True in truths else None if None in truths else False


def lead_over_brownian(result, brownian):
    """The final lead of agents over Brownian motion on the same board, in reward per second, as an `Estimate`."""
    return estimate(difference, result.rate(*FINAL), brownian.rate())


def learned(result, brownian):
    """Whether agents finally earn more than Brownian motion on the same board.

    See `leads`.
    """
    return leads(lead_over_brownian(result, brownian))


def leads(lead):
    """Whether a lead in reward per second, an `Estimate`, is above 0: False if it is shown to be below `VISIBLE`."""
    return True if lead.low > 0 else False if lead.high < VISIBLE else None


def share_of_run(minutes, result):
    """An `Estimate` in minutes, as a share of the runs of a result."""
    return Estimate(*(60 * each / result.seconds for each in minutes))


def fewest_runs(*results):
    """The smallest number of runs among results."""
    return min(result.runs for result in results)
