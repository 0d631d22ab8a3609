"""Verdicts: a claim of the thesis, our number for it, and the outcome of the claim's rule.

1. A verdict follows from 95 % intervals, by a rule in the code, the same for every reading of the thesis. The page of
   claims names the commit that fixed it and, with reasons, those that changed it.
2. Each number that a rule asks for lies within its bounds (true), outside them (false) or across one of them (open).
   A claim is *reproduced* if all are true. If one is false, so is the claim as a whole: it is then *partly* true if a
   part that the rule names is, *contradicted* if no part is, and *not as a whole* while parts are open. Otherwise it is
   *undecided*: more runs would tell. Where a verdict rests on several intervals, all hold together with 95 %
   (`companion.thesis.measures`).
3. An agent has *learned* if it finally earns visibly more than Brownian motion on the same board. A claim that compares
   agents is *not testable* where intervals show that none of these has learned, and one that measures by an agent's own
   level, as a ratio or a time does, where that agent has not. A claim that agents lead Brownian motion is false there.
4. A claim that is contradicted by a proof, or by one example, says so in place of "contradicted".
5. With fewer than 10 runs per condition, or shorter ones than the claim's, there is *no verdict*.

Rewards are per simulated second and means over runs; early is the first tenth of a run, final the last fifth.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from companion.thesis.measures import FINAL, widened
from companion.thesis.statements import STATEMENTS, VISIBLE, Bounds
from neorl.statistics import FEWEST_RUNS, Estimate, difference, estimate

RUNS_FOR_A_VERDICT = FEWEST_RUNS
AFTER_TURN = (0.5, 0.525)  # of runs that change at half-time
VERDICTS = ("reproduced", "partly", "contradicted", "not as a whole", "undecided", "not testable", "refuted by proof",
            "counter-example found", "no verdict")
CONTRADICTED = {"proof": "refuted by proof", "report": "counter-example found"}  # of a kind of statement
FAILED = ("contradicted", *CONTRADICTED.values())


@dataclass(frozen=True)
class Claim:
    """The finding on one claim of `STATEMENTS`: our number with its interval, and the outcome of the rule.

    numbers: {what: (`Estimate`, `Bounds` or None, role)}, all that the rule reads. The role is "asked", of a number
    that the claim as a whole asks for; "part", of one that can only make it partly true; or "shown", of one without
    bounds. parts: the names of numbers that together make it partly true. together: the number of intervals that the
    verdict rests on, each of which holds with 1 − 0.05 / together.
    """

    name: str
    here: Estimate
    numbers: Mapping[str, tuple[Estimate, Bounds | None, str]]
    runs: int
    outcome: str  # one of VERDICTS but the last, whatever the number of runs
    full_length: bool = True  # whether the runs are as long as the claim's own
    parts: tuple[tuple[str, ...], ...] = ()
    together: int = 1

    @property
    def verdict(self):
        """The outcome, if runs are many and long enough for a verdict."""
        return self.outcome if self.full_length and self.runs >= RUNS_FOR_A_VERDICT else "no verdict"


def judged(name, here, runs, asked=None, also=None, shown=None, parts=None, testable=True):
    """The `Claim` of that name, from 95 % intervals, which are widened for their number.

    asked, also, shown: {what: an `Estimate`, or {of what: `Estimate`}}. asked: the numbers that a reproduction asks
    for, besides our own. also: those that can only make it partly true. shown: numbers that are only reported. Bounds
    are those of `Statement.also`, or else of our number.
    here: our number, an `Estimate`; or (function, what), such as the `least` of all that is asked for under that name;
    or (function, {of what: `Estimate`}), such as the `most` of some that nothing else is asked of.
    parts: names of numbers, or of groups of them, a tuple for each part of the claim: it is partly true if all numbers
    of a part are. By default each number in `also` is a part, or else each that is asked for.
    testable: True, False or None, see `learned`.
    """
    statement = STATEMENTS[name]
    bounded = [(what, of, found, role) for role, some in (("asked", asked), ("part", also))
               for what, of, found in _each(some)]
    derived, among = here if not isinstance(here, Estimate) else (None, None)
    own = among if isinstance(among, dict) else {} if derived else {"": here}
    together = len(bounded) + len(own)
    numbers = {_label(what, of): (widened(found, together), statement.also.get(what, statement.bounds), role)
               for what, of, found, role in bounded}
    wide = {of: widened(found, together) for of, found in own.items()}
    if derived:
        here = derived([*wide.values()] or [found for what, (found, *_) in numbers.items() if belongs(what, among)])
        numbers |= {_label(statement.statistic, of): (found, None, "shown") for of, found in wide.items()}
    else:
        here = wide[""]
    if (here, statement.bounds, "asked") not in numbers.values():
        numbers = {statement.statistic: (here, statement.bounds, "asked")} | numbers
    numbers |= {_label(what, of): (found, None, "shown") for what, of, found in _each(shown)}
    decided = {what: bounds.decide(found) for what, (found, bounds, _) in numbers.items() if bounds}
    whole = [what for what in decided if numbers[what][2] == "asked"]
    if parts is None:
        parts = [(what,) for what in decided if what not in whole] or [(what,) for what in whole]
    parts = tuple(tuple(what for what in decided if any(belongs(what, part) for part in each)) for each in parts)
    found = outcome(decided, whole, parts, testable)
    if found == "contradicted":
        found = CONTRADICTED.get(statement.kind, found)
    return Claim(name, here, numbers, runs, found, parts=parts, together=together)


def _each(some):
    return [(what, of, found) for what, named in (some or {}).items()
            for of, found in (named if isinstance(named, dict) else {"": named}).items()]


def _label(what, of):
    return f"{what}, {of}" if of else what


def belongs(label, what):
    """Whether the name of a number is that of a group of numbers, or begins with it, as in "lead, N10" of "lead"."""
    return f"{label}, ".startswith(f"{what}, ")


def outcome(decided, whole, parts, testable=True):
    """What a rule decides.

    decided: {what: True, False or None}. whole: the names that the claim as a whole asks for. parts: those of each
    part.
    """
    whole = all_of(decided[what] for what in whole)
    part = any_of(all_of(decided[what] for what in each) for each in parts)
    if testable is False:
        return "not testable"
    if testable and whole:
        return "reproduced"
    if testable and whole is False:
        return "not as a whole" if part is None else "partly" if part else "contradicted"
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


def any_learned(results, brownian):
    """Whether any of some agents finally earns more than Brownian motion on the same board, see `leads`."""
    return any_of([learned(result, brownian) for result in results])


def leads(lead):
    """Whether a lead in reward per second, an `Estimate`, is one that a figure shows: True, False, or None if open."""
    return VISIBLE.decide(lead)


def fewest_runs(*results):
    """The smallest number of runs among results."""
    return min(result.runs for result in results)
