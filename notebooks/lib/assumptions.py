"""The page on assumptions: claims under readings within the text, and beyond it.

1. Agents run in the groups of conditions `CHEAP` under every reading, and in `EXPENSIVE` under the first ones only.
2. The importance of choices for a claim is estimated from `ENOUGH` readings or more.
3. Shares are of readings in short runs, beside those of the readings of the calibration's design, in runs of the
   papers' own lengths.
4. Tables and sentences are Markdown.
"""

import numpy as np

from lib.shared.wording import listed, table
from lib.study import calibration_results, multiverse
from neorl.evidence import pins
from neorl.evidence.priors import BEYOND, TO_THE_LETTER, WITHIN
from neorl.evidence.reading import PAPER_FPS, conditions, judge
from neorl.evidence.statements import STATEMENTS
from neorl.evidence.statistics import difference, estimate
from neorl.experiments.sweeping import sweep

CHEAP = ("layers", "modal", "networks", "revaluing", "resolutions")  # of `neorl.evidence.reading.GROUPS`
EXPENSIVE = ("single", "pace")
ENOUGH = 32  # readings
PREDICTED = 0.1  # the least R² at which choices count as predicting the number of a claim
NAMED, MATTERS = 3, 0.05  # choices listed for a claim: the most of them, and the least importance
FULL_SIZE = 128  # readings


def judge_readings(readings, groups, steps, runs, seed=0):
    """Judge the claims for which some groups of conditions suffice, under each reading: [{name: `Claim`}, …].

    readings: of `Reading`. groups, steps, runs, seed: as `neorl.evidence.reading.conditions` takes them.
    """
    wanted = [conditions(reading, steps, runs, seed, groups) for reading in readings]
    results = sweep([each for of_reading in wanted for each in of_reading.values()])
    return [judge({key: next(results) for key in of_reading}) for of_reading in wanted]


def by_claim(judged, judged_part):
    """Claims by name, each under all its readings: {name: [`Claim`, …]}, in the order of the claims.

    judged, judged_part: the claims under all readings and under the first ones, as `judge_readings` returns them.
    """
    return _in_order({name: [claims[name] for claims in each] for each in (judged, judged_part) for name in each[0]})


def shares(judged, judged_part, rows):
    """How often each claim holds in short runs and agrees at the papers' lengths, as `report.save` takes it.

    judged, judged_part: the claims under all readings and under the first ones, as `judge_readings` returns them.
    rows: of the table of the calibration.
    """
    found, at_length = multiverse.shares(judged) | multiverse.shares(judged_part), calibration_results.evenly(rows)
    return {name: counts | at_length.get(name, {}) for name, counts in _in_order(found).items()}


def importances(*multiverses):
    """Importance of each choice for each claim: ({claim: {choice: importance}}, {claim: R²}).

    multiverses: pairs of readings and the claims under them, as `judge_readings` returns them. A claim that was judged
    under fewer than `ENOUGH` readings has no importances and no R².
    """
    importance, explained = {}, {}
    for readings, judged in multiverses:
        for name in judged[0]:
            importance[name] = {}
            if len(readings) >= ENOUGH:
                importance[name], explained[name] = multiverse.importance(readings, judged, name)
    return _in_order(importance), _in_order(explained)


def of_predicted(importance, names):
    """The importances for the named claims, and none for the others: {claim: {choice: importance}}."""
    return {name: found if name in names else {} for name, found in importance.items()}


def predicted(explained):
    """The claims whose number the choices predict, a list of names. explained: {claim: R²}."""
    return [name for name, share in explained.items() if share >= PREDICTED]


def in_short(shares, judged, foremost):
    """The page's results in a few sentences. foremost: as `foremost_choices` returns it."""
    agreeing = [found["agrees"] / found["measured"] for found in shares.values() if found.get("measured")]
    holding = [_share(found, "holds") for found in shares.values()]
    return (f"At the papers' own lengths, a claim's numbers agree with the thesis in {_percent(np.mean(agreeing))} "
            f"of the readings that the text allows, on average over {len(agreeing)} claims. In short runs of "
            f"{len(judged)} readings, with an interval required, a claim holds in {_percent(np.mean(holding))} of "
            f"them. {foremost}")


def agreement_at_length(shares):
    """How often claims' numbers agree with the thesis at the papers' lengths. shares: as `shares` returns them."""
    agreeing = {name: found["agrees"] / found["measured"] for name, found in shares.items() if found.get("measured")}
    text = ", ".join(f"**{name}**\u00a0{_percent(share)}" for name, share in agreeing.items())
    return ("At the papers' own lengths, under readings drawn evenly within the text, the numbers agree with the "
            f"thesis in: {text}. The average "
            f"is {_percent(np.mean([*agreeing.values()]))}.")


def holding_in_short_runs(shares, judged, judged_part, steps, runs):
    """Which claims hold under more than half of the readings, which under none, and how many on average.

    shares: as `shares` returns them. judged, judged_part: as it takes them. steps, runs: of each condition.
    """
    holding = {name: _share(found, "holds") for name, found in shares.items()}
    counts = _held(judged)
    return (f"The rules require more: an interval, which takes more runs than so many readings can have. In short "
            f"runs, which show early behaviour ({steps / 60 / PAPER_FPS:.3g} minutes of simulated time at {PAPER_FPS} "
            f"steps per second, {runs} runs per condition), {len(shares)} claims were judged under "
            f"{len(judged)} readings within the text, the expensive ones ({', '.join(judged_part[0])}) under "
            f"{len(judged_part)} of these. On average a claim holds in "
            f"**{_percent(np.mean([*holding.values()]))}** of the readings. In more than half of "
            f"them: {listed(name for name, share in holding.items() if share > 0.5)}; in none of them: "
            f"{listed(name for name, share in holding.items() if share == 0)}. Of the {len(judged[0])} claims that "
            f"were judged under every reading, {max(counts)} hold under the best reading, and {np.mean(counts):.1f} on "
            f"average.")


def foremost_choices(importance, predicted, points):
    """The choice that matters most for each claim that the choices predict.

    importance: as `importances` returns it. predicted: names of claims. points: how many readings there are.
    """
    if not predicted:
        return f"With {points} readings, no choice predicts the number of any claim."
    claims = {}
    for name in predicted:
        foremost = max(importance[name], key=importance[name].get)
        claims.setdefault(WITHIN[foremost].label, []).append(name)
    words = "; ".join(f"*{label}* ({', '.join(names)})" for label, names in claims.items())
    few = [name for name, found in importance.items() if not found]
    unknown = f" There are too few readings for {listed(few)}." if few else ""
    return (f"The choice that matters most for each claim: {words}.{unknown} For the others no choice predicts the "
            "number.")


def verdicts(shares):
    """The share of readings with each verdict, and of those that agree at the papers' lengths, as a table.

    shares: as `shares` returns them.
    """
    rows = []
    for name, found in shares.items():
        holds, undecided, untestable = (_share(found, kind) for kind in ("holds", "undecided", "untestable"))
        at_length = (f"{_percent(found['agrees'] / found['measured'])} of {found['measured']}"
                     if found.get("measured") else "")
        rows.append([_stated(name), _percent(holds), _percent(undecided), _percent(1 - holds - undecided),
                     _percent(untestable), str(found["readings"]), at_length])
    return table(["Claim", "Holds", "Undecided", "Fails", "Untestable", "Readings", "Agrees at the papers' lengths"],
                 rows)


def undecided(shares, runs):
    """How many verdicts are undecided. shares: as `shares` returns them. runs: of each condition."""
    unsettled, total = (sum(found[kind] for found in shares.values()) for kind in ("undecided", "readings"))
    return (f"Of {total:,} verdicts in all, {unsettled:,} ({_percent(unsettled / total)}) are undecided. An interval "
            f"from {runs} runs is rough; shares over many readings are less so.")


def fixed_by_the_text():
    """What the text fixes and what it leaves open, as two tables, with the names of choices in the others."""
    return pins.tables({field: choice.label for field, choice in BEYOND.items()})


def choices(readings):
    """Every choice with its prior within the text and the readings' values, as a table. readings: {name: `Reading`}."""
    rows = []
    for field, choice in BEYOND.items():
        prior = WITHIN[field].stated if field in WITHIN else "pinned"
        taken = (choice.words(getattr(reading, field)) for reading in readings.values())
        rows.append([choice.label, prior, *taken, ", ".join(choice.papers.replace("T", ""))])
    return table(["Choice", "Prior", *(name.capitalize() for name in readings), "Papers"], rows)


def agreements(readings):
    """Whether readings are within the text, as a list. readings: {name: `Reading`}."""
    found = {name: reading.within_the_text for name, reading in readings.items()}
    return "\n".join(f"- The reading *{name}* is {'' if agreement else 'not within the text: '}{agreement}."
                     for name, agreement in found.items())


def dependence(importance, explained, shares):
    """The choices that each claim depends on most, as a table.

    importance, explained: as `importances` returns them. shares: as `shares` returns them.
    """
    known, rows = predicted(explained), []
    for name, found in importance.items():
        if name not in explained:
            rows.append([name, "", f"{shares[name]['readings']} readings are too few"])
            continue
        best = sorted(found, key=found.get, reverse=True)[:NAMED]
        words = ", ".join(f"{WITHIN[key].label} ({found[key]:.2f})" for key in best if found[key] >= MATTERS)
        rows.append([name, f"{max(0, explained[name]):.2f}", words if name in known else "no choice predicts it"])
    if not explained:
        return "The page has too few readings of each claim for a table of what it depends on."
    return table(["Claim", "R²", "What it depends on most"], rows)


def whether_enough(points):
    """Whether a number of readings is enough to show what claims depend on."""
    return f"{points} readings are " + ("enough to show the large effects." if points >= FULL_SIZE
                                        else "too few to show much.")


def clear_leads(supports):
    """Levels at which clearly more or fewer claims hold than at the letter's, and the number expected by chance.

    supports: of `lib.study.multiverse.Support`, for every level.
    """
    clear = [each for each in supports if each.lead.low > 0 or each.lead.high < 0]
    compared = sum(not each.is_to_the_letter for each in supports)
    text = (f"Of {compared} levels, {len(clear)} {'is' if len(clear) == 1 else 'are'} listed; chance alone would list "
            f"about {0.05 * compared:.0f}.")
    if not clear:
        return text
    rows = [[WITHIN[each.choice].label, each.level, f"{each.held:.2f}", str(each.lead)] for each in clear]
    return f"{table(['Choice', 'Level', 'Claims that hold', 'Lead over the letter'], rows)}\n\n{text}"


def priors_beyond():
    """Choices whose prior beyond the text differs from that within it, with both priors, as a table."""
    rows = []
    for field, choice in BEYOND.items():
        if choice != WITHIN.get(field):
            within = WITHIN[field].stated if field in WITHIN else choice.words(getattr(TO_THE_LETTER, field))
            rows.append([choice.label, choice.stated, within])
    return table(["Choice", "Prior beyond the text", "Within"], rows)


def verdicts_beyond(shares, judged_outside):
    """The shares of readings beyond the text under which claims hold, beside those within it, as a table.

    shares: within the text, as `shares` returns them. judged_outside: beyond it, as `judge_readings` returns it.
    """
    outside = multiverse.shares(judged_outside)
    rows = [[_stated(name), _percent(_share(outside[name], "holds")), _percent(_share(outside[name], "undecided")),
             _percent(_share(found, "holds"))] for name, found in shares.items() if name in outside]
    return table(["Claim", "Holds beyond the text", "Undecided", "Within"], rows)


def counts_beyond(outside, judged_outside, judged):
    """How many claims hold under readings beyond the text and within it, and how many choices break the text.

    outside: readings beyond the text. judged_outside, judged: the claims under them and within the text, as
    `judge_readings` returns them.
    """
    broken = [len(reading.within_the_text.broken) for reading in outside]
    beyond, within = np.array(_held(judged_outside)), np.array(_held(judged))
    which = "all of which" if all(broken) else f"of which {np.count_nonzero(broken)}"
    return (f"{len(outside)} readings, {which} break the text, in {np.mean(broken):.1f} choices on average. Beyond the "
            f"text {beyond.mean():.1f} of {len(judged[0])} claims hold on average; within it, {within.mean():.1f}; the "
            f"difference is {estimate(difference, beyond, within)}.")


def _in_order(found):
    """{name of a claim: anything} in the order of the claims."""
    return {name: found[name] for name in STATEMENTS if name in found}


def _held(judged):
    """How many claims hold under each reading."""
    return [len(multiverse.held(claims)) for claims in judged]


def _share(found, kind):
    return found[kind] / found["readings"]


def _stated(name):
    return f"**{name}** {STATEMENTS[name].text}"


def _percent(share):
    return f"{share:.0%}".replace("%", "\u00a0%")
