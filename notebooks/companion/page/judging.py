"""Which claims a page judges: those about what it has run, and no others.

1. A claim is judged only if the agents and worlds that were run are those that it is about. Numbers of runs and seeds
   may differ: how many runs a verdict needs is a rule of verdicts.
2. Shorter runs are judged, but give no verdict.
"""

from collections.abc import Mapping
from dataclasses import replace

from companion.thesis import reading as readings
from neorl import Condition, Result

PAPERS = {"layers": "A", "single": "A", "networks": "C"}  # whose conditions are in a group; else paper B's


def judge(rules, ran, wanted):
    """The claims that rules() judges, a list: none unless what a page ran is what they are about.

    rules: a function without arguments that returns a sequence of `Claim`s. ran, wanted: see `same`.
    """
    if not same(ran, wanted):
        return []
    as_long = all(result.steps >= condition.steps for result, condition in _pairs(ran, wanted))
    return [replace(claim, full_length=as_long and claim.full_length) for claim in rules()]


def judge_papers(results, reading, *groups):
    """The claims of the papers that a reading judges by results of groups of its conditions: a list, see `judge`.

    results: of all that was run, which its agents and worlds tell apart, a list.
    """
    wanted = papers_conditions(reading, *groups)
    ran = by_condition(results, wanted)
    return judge(lambda: readings.judge(ran).values(), ran, wanted)


def by_condition(results, wanted):
    """The results of the conditions that are wanted, the longest of each and of these the one with most runs.

    results: a list. wanted: {key: `Condition`}. Returns {key: `Result`}, without keys that none has.
    """
    of_key = {key: [result for result in results if same(result, condition)]
              for key, condition in wanted.items()}
    return {key: max(some, key=lambda result: (result.steps, result.runs)) for key, some in of_key.items() if some}


def papers_conditions(reading, *groups):
    """The papers' own conditions of some groups under a reading, {key: `Condition`}."""
    steps = max(readings.LENGTHS[PAPERS.get(group, "B")] for group in groups)
    return readings.conditions(reading, steps, 1, groups=groups)


def same(ran, wanted):
    """Whether what was run is of the same agents, worlds and changes as what is wanted.

    ran, wanted: each a `Condition` or `Result`, a sequence of these, a mapping, or any other value, which must be
    equal. Mappings may have more keys than are wanted.
    """
    if isinstance(wanted, Condition | Result):
        return (ran.agent, ran.world, _changes(ran)) == (wanted.agent, wanted.world, _changes(wanted))
    if isinstance(wanted, Mapping):
        return ran.keys() >= wanted.keys() and all(same(ran[key], wanted[key]) for key in wanted)
    if isinstance(wanted, list | tuple):
        return len(ran) == len(wanted) and all(map(same, ran, wanted))
    return ran == wanted


def _changes(ran):
    """When agents change, as shares of the run, and into which."""
    return [(round(step / ran.steps, 2), agent) for step, agent in ran.changes]


def _pairs(ran, wanted):
    """The results among what was run, each with the condition that is wanted: [(result, condition), ...]."""
    if isinstance(wanted, Condition | Result):
        return [(ran, wanted)]
    if isinstance(wanted, Mapping):
        return [pair for key in wanted for pair in _pairs(ran[key], wanted[key])]
    if isinstance(wanted, list | tuple):
        return [pair for one, other in zip(ran, wanted) for pair in _pairs(one, other)]
    return []
