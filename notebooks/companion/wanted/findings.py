"""What the recorded lessons show: the predictions that were written before, and the sentences and tables of the page.

A prediction compares partners that have had a lesson from a stream with agents that have had one from random motion,
see `predictions.toml`. Its number is what they catch above untrained agents, as a share; a whole interval at or below
`LITTLE` shows one thing, one at or above `MUCH` another.
"""

import tomllib
from functools import cache
from importlib import resources
from typing import NamedTuple

import numpy as np

from companion.page import answers, recorded
from companion.page.wording import enumerated, in_words, table
from companion.thesis.measures import share_of_lead
from companion.thesis.reading import NAMES
from companion.wanted import ten_hours
from companion.wanted.lessons import LESSONS, SHIPPED, UNTRAINED, WANTED, read
from companion.wanted.measures import Knowledge, Stream
from neorl.statistics import Estimate, estimate

LITTLE, MUCH = 0.5, 0.8
PREDICTIONS = tomllib.loads((resources.files(__package__) / "predictions.toml").read_text("utf-8"))
NARROW = ("green", "both", "a place")  # what was desired without fear
OPEN = "open"
TASKS = {"kept": "wanting green and fearing red all along", "turned": "wanting red, too, after 100 minutes"}
KEPT = 170  # discs a minute that an agent is to know throughout
WAS = {"nothing": "nothing", "green, fearing red": "green discs, and no red ones", "green": "green discs",
       "both": "discs of both colours", "a place": "to be at a place"}
UNITS = {"caught": "Caught a minute, both wanted", "earned": "Points a second, as in the papers",
         "seconds": "Seconds to a lone place", "places": "Places: pushes that lead to the goal",
         "vectors": "Vectors: pushes that lead to the goal"}


class Shown(NamedTuple):
    """What a prediction compared, as a share, and what that shows: "stream", "overwriting" or `OPEN`."""

    share: Estimate
    shows: str


@cache
def lessons(path=SHIPPED):
    """The recorded numbers: {(reading, wanted, lesson): {name in `Knowledge`: (runs,)}}."""
    rows = {}
    for row in sorted(read(path), key=lambda row: row.run):
        rows.setdefault((row.reading, row.wanted, row.lesson), []).append(row.knowledge)
    return {key: dict(zip(Knowledge._fields, np.array(runs).T)) for key, runs in rows.items()}


@cache
def streams(path=SHIPPED):
    """How much streams covered: {(reading, wanted): {"whole" or "end": {name in `Stream`: (runs,)}}}."""
    rows = {}
    for row in sorted(read(path), key=lambda row: row.run):
        if row.stream:
            rows.setdefault((row.reading, row.wanted), []).append((row.stream, row.end))
    return {key: {part: dict(zip(Stream._fields, np.array(runs)[:, at].T)) for at, part in enumerate(("whole", "end"))}
            for key, runs in rows.items()}


def runs(path=SHIPPED):
    """The fewest recorded runs of a lesson."""
    return min(len(each["caught"]) for each in lessons(path).values())


def level(reading, wanted, lesson="own", what="caught", path=SHIPPED):
    """A mean of `Knowledge` over the recorded runs of a lesson: `Estimate`."""
    return estimate(np.mean, lessons(path)[reading, wanted, lesson][what])


def shown(reading, wanted, lesson, path=SHIPPED):
    """What a prediction comes to for one stream under a reading: `Shown`."""
    known, words = lessons(path), PREDICTIONS[lesson]
    chance = known[reading, UNTRAINED, "own"]["caught"]
    reached = known[reading, wanted, lesson]["caught"]
    beside = known[reading, "nothing", words["beside"]]["caught"]
    share = estimate(share_of_lead, reached, chance, beside)
    return Shown(share, words["low"] if share.high <= LITTLE else words["high"] if share.low >= MUCH else OPEN)


def conclusion(reading, path=SHIPPED):
    """What all predictions on streams without fear show together: those that teach too little, those that overwrite.

    A stream teaches too little if no rule learns from it, whole or in part; it overwrites if partners lose in it what
    they had known before.
    """
    too_little = [wanted for wanted in NARROW if all(shown(reading, wanted, lesson, path).shows == "stream"
                                                     for lesson in PREDICTIONS if lesson not in ("wide", "mended"))]
    overwritten = [wanted for wanted in NARROW if shown(reading, wanted, "wide", path).shows == "overwriting"]
    return too_little, overwritten


def answer():
    """The recorded answer of the page, as HTML: what agents know, and why."""
    return recorded.shown(f"{answers.answer('wanted')} Yoked partners tell why: {why()}. {turned('calibrated')}",
                          {"": recorded.SHOWN["wanted"]})


def why(reading="calibrated", path=SHIPPED):
    """Stream or overwriting, in a sentence."""
    narrow, lost = map(len, conclusion(reading, path))
    return (f"of {len(NARROW)} streams without fear, {narrow} teach too little by any rule tried, and {lost} overwrite "
            "most of what was known")


def predictions(reading, path=SHIPPED):
    """Every prediction as it was written, and what it came to, as a Markdown table."""
    rows = []
    for lesson, words in PREDICTIONS.items():
        found = [shown(reading, wanted, lesson, path) for wanted in NARROW]
        rows.append([words["lesson"].capitalize(), *(f"{in_words(each.share)}: {each.shows}" for each in found),
                     words["expected"]])
    return table(["What was learned from", *(WAS[wanted] for wanted in NARROW), "Expected"], rows)


def reasons():
    """Why each lesson tells stream from overwriting, as it was written before: a Markdown list."""
    return "\n".join(
        f"- **{words['lesson'].capitalize()}.** {words['why']} Little shows {words['low']}, much {words['high']}."
        for words in PREDICTIONS.values())


def knowledge(reading, lesson="own", path=SHIPPED):
    """What agents know that have had a lesson, by what was wanted meanwhile, as a Markdown table."""
    rows = [[WAS[wanted].capitalize(), *(in_words(level(reading, wanted, lesson, what, path))
                                         for what in Knowledge._fields)] for wanted in WANTED]
    if lesson == "own":
        rows.append(["Untrained", *(in_words(level(reading, UNTRAINED, "own", what, path))
                                    for what in Knowledge._fields)])
    return table(["Wanted while learning", *UNITS.values()], rows)


def every_lesson(reading, what="caught", path=SHIPPED):
    """One number of `Knowledge` for each lesson of each stream, as a Markdown table."""
    names = {"own": "All of it, by the agent itself", **{lesson: words["lesson"].capitalize()
                                                         for lesson, words in PREDICTIONS.items()}}
    return table([UNITS[what], *(WAS[wanted] for wanted in WANTED)], [
        [names[lesson], *(in_words(level(reading, wanted, lesson, what, path)) for wanted in WANTED)]
        for lesson in LESSONS])


def where(reading, path=SHIPPED):
    """Where ten minutes of random motion are overwritten, in a sentence: the shares of right values then and later."""
    parts = []
    for modality in ("places", "vectors"):
        before = level(reading, "nothing", "first", modality, path).value
        after = level(reading, "green", "wide", modality, path).value
        parts.append(f"{modality}, {before:.2f} before and {after:.2f} after")
    return ("Shares of right values before and after ninety minutes of the stream of an agent that wants green discs "
            f"alone, by partners that had first moved at random for ten: {'; '.join(parts)}.")


def by_desire(reading, path=SHIPPED):
    """What streams teach for the desire of the papers, in a sentence."""
    named = [(WAS[wanted], level(reading, wanted, "own", "earned", path).value) for wanted in WANTED]
    best = max(named, key=lambda pair: pair[1])
    rest = enumerated(f"{words} {earned:.2f}" for words, earned in named if words != best[0])
    return (f"Told to want what the papers' agents do, those earn most, {best[1]:.2f} points a second, that had wanted "
            f"{best[0]}. By other desires: {rest}.")


def coverage(reading, path=SHIPPED):
    """How much of the board streams cover, as a Markdown table."""
    found = streams(path)
    rows = []
    for wanted in WANTED:
        whole, end = (found[reading, wanted][part] for part in ("whole", "end"))
        rows.append([WAS[wanted].capitalize(), *(in_words(estimate(np.mean, each)) for each in (
            whole["covered"], whole["entropy"], whole["pairs"], end["covered"], end["entropy"], whole["paid"]))])
    return table(["Wanted", "Cells entered", "Evenness of the time in them", "Pairs of a cell and a push",
                  "Cells, last ten minutes", "Evenness, last ten minutes", "Points a second"], rows)


class Kept(NamedTuple):
    """Ten hours in one way."""

    paid: Estimate  # while learning, after a turn: points a second, or discs a minute where both are wanted
    known: Estimate  # in the last piece
    lowest: float  # of the means of pieces, after the turn
    is_kept: bool  # whether this is `KEPT` or more, and pays at least today's


def hours_of(reading, task, path=ten_hours.SHIPPED):
    """What each way of ten hours comes to in a task: {way: `Kept`}."""
    after = slice(ten_hours.TURN if task == "turned" else 0, None)
    found, today = {}, None
    for (of, which, way), (green, red, known) in ((key, each.swapaxes(0, 1))
                                                  for key, each in ten_hours.recorded(path).items()):
        if (of, which) == (reading, task):
            paid = (green + red if task == "turned" else (green - red) / 60)[:, after].mean(axis=1)
            today = paid.mean() if way == "today" else today
            lowest = float(known[:, after].mean(axis=0).min())
            found[way] = Kept(estimate(np.mean, paid), estimate(np.mean, known[:, -1]), lowest,
                              lowest >= KEPT and paid.mean() >= today)
    return found


def hours(reading, path=ten_hours.SHIPPED):
    """Ten hours in the recorded ways, as a Markdown table for each task."""
    return "\n\n".join(table(
        [f"{TASKS[task].capitalize()}", "Discs a minute, learning" if task == "turned" else "Points a second, learning",
         "Known after ten hours", "Lowest mean of all pieces", f"Keeps {KEPT}, and earns no less than today"],
        [[way, in_words(each.paid), in_words(each.known), f"{each.lowest:.0f}", "yes" if each.is_kept else "no"]
         for way, each in hours_of(reading, task, path).items()]) for task in TASKS)


def mended(reading):
    """Which ways keep what is known, in a sentence."""
    parts = []
    for task, words in TASKS.items():
        ways = [f"{_named(way)} ({each.lowest:.0f} or more)" for way, each in hours_of(reading, task).items()
                if each.is_kept]
        parts.append(f"{words}, {KEPT} discs a minute are kept, at rewards no lower than today's, by "
                     f"{enumerated(ways) or 'none of the recorded ways'}")
    return f"{NAMES[reading].capitalize()}, in the mean over runs: {'; '.join(parts)}."


def turned(reading):
    """What agents know that learn on after their desire has turned, with and without a trail, in a sentence."""
    ways = hours_of(reading, "turned")
    best = max((each for way, each in ways.items() if "trail" in way), key=lambda each: each.lowest)
    today, mended = (each.known.value for each in (ways["today"], best))
    return (f"Agents that come to want both, and learn on for ten hours, can then catch {today:.0f} discs a minute; "
            f"those that also fear where they have just been, {mended:.0f}.")


def _named(way):
    return "today's agent" if way == "today" else f"“{way}”"


def in_chapter_5(reading, path=SHIPPED):
    """The answer of the page in a sentence, for the chapter that raises the question."""
    own, wide, first, chance = (level(reading, *key, path=path).value for key in (
        ("green", "own"), ("green", "wide"), ("nothing", "first"), (UNTRAINED, "own")))
    return (f"In yoked runs, agents that learned while they wanted green discs alone catch {own:.0f} of both colours a "
            f"minute, and untrained ones {chance:.0f}. Partners that had moved at random for ten minutes, after which "
            f"they would have caught {first:.0f}, and then learned from the same stream, catch {wide:.0f}.")
