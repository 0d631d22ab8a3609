"""Readings of the thesis side by side, on the pages of the papers: their runs, verdicts and choices.

Readings are {name: `Reading`}, and their results {name: {key: `Result`}}, with the keys of
`neorl.evidence.reading.conditions`.
"""

from dataclasses import replace

from lib.shared.wording import table
from neorl.evidence.priors import BEYOND, WITHIN
from neorl.evidence.reading import judge
from neorl.evidence.verdict import RUNS_FOR_A_VERDICT
from neorl.experiments.sweeping import sweep


def few(runs):
    """The number of runs of secondary conditions if the main ones have `runs`: at most 10."""
    return min(runs, RUNS_FOR_A_VERDICT)


def live(made):
    """Compute the conditions of several readings, shared ones only once: {name: {key: `Condition`}} to `Result`s."""
    different = list(dict.fromkeys(each for of_reading in made.values() for each in of_reading.values()))
    results = dict(zip(different, sweep(different)))
    return {name: {key: results[each] for key, each in of_reading.items()} for name, of_reading in made.items()}


def judge_each(lived):
    """The claims that each reading's results suffice to judge: {name: [`Claim`, …]}."""
    return {name: [*judge(results).values()] for name, results in lived.items()}


def changed(reading, changes):
    """Variants of a reading, except those equal to it: {name: `Reading`}.

    changes: {name: {field of `Reading`: value}}.
    """
    made = {name: replace(reading, **change) for name, change in changes.items()}
    return {name: each for name, each in made.items() if each != reading}


def by_resolution(results, group, resolutions):
    """The results of one reading with the keys (group, N), by name: {"N3": `Result`, …}; "all" keeps its name."""
    return {n if n == "all" else f"N{n}": results[group, n] for n in resolutions}


def each_in_words(words):
    """A Markdown list with a text on each reading: {name: text}."""
    return "\n".join(f"- **{name.capitalize()}.** {text}" for name, text in words.items())


def choices(readings, fields):
    """A Markdown table of the choices of readings, and whether the text pins each choice or leaves it open.

    fields: the names of fields of `Reading`.
    """
    return table(["Choice", "The text", *readings], [
        [BEYOND[field].label, "open" if field in WITHIN else "pinned",
         *(BEYOND[field].words(getattr(reading, field)) for reading in readings.values())] for field in fields])
