"""Readings of the thesis side by side, as the pages of the papers have them: their runs, verdicts and choices.

Readings are {name: `Reading`}, and their results {name: {key: `Result`}}, with the keys of
`neorl.evidence.reading.conditions`.
"""

from dataclasses import replace

from neorl.chapters.shared.wording import table
from neorl.evidence.priors import BEYOND, WITHIN
from neorl.evidence.reading import judge
from neorl.evidence.verdict import RUNS_FOR_A_VERDICT
from neorl.experiments.sweeping import sweep


def few(runs):
    """How many runs the secondary conditions have where the main ones have `runs`: 10 at most."""
    return min(runs, RUNS_FOR_A_VERDICT)


def live(made):
    """Compute conditions of several readings, those that they share once: {name: {key: `Condition`}} to `Result`s."""
    different = list(dict.fromkeys(each for of_reading in made.values() for each in of_reading.values()))
    results = dict(zip(different, sweep(different)))
    return {name: {key: results[each] for key, each in of_reading.items()} for name, of_reading in made.items()}


def judge_each(lived):
    """The claims that each reading's results suffice for: {name: [`Claim`, …]}."""
    return {name: [*judge(results).values()] for name, results in lived.items()}


def changed(reading, changes):
    """The readings that changes make of a reading, but for those that leave it as it is: {name: `Reading`}.

    changes: {name: {field of `Reading`: value}}.
    """
    made = {name: replace(reading, **change) for name, change in changes.items()}
    return {name: each for name, each in made.items() if each != reading}


def by_resolution(results, group, resolutions):
    """The results of one reading with the keys (group, N), by name: {"N3": `Result`, …}; "all" keeps its name."""
    return {n if n == "all" else f"N{n}": results[group, n] for n in resolutions}


def each_in_words(words):
    """What is said of each reading, as a Markdown list: {name: text}."""
    return "\n".join(f"- **{name.capitalize()}.** {text}" for name, text in words.items())


def choices(readings, fields):
    """What readings choose, as a Markdown table, and whether the text pins each choice or leaves it open.

    fields: the names of fields of `Reading`.
    """
    return table(["Choice", "The text", *readings], [
        [BEYOND[field].label, "open" if field in WITHIN else "pinned",
         *(BEYOND[field].words(getattr(reading, field)) for reading in readings.values())] for field in fields])
