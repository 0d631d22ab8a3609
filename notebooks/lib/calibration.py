"""The page on calibration: the best reading rerun, and conclusions from the table of readings.

1. The best reading of the table is rerun with new seeds, beside the reading to the letter and the nearest other
   readings.
2. Single maps, the last group of conditions, are expensive: they have fewer runs, and the nearest readings omit them.
3. Tables and sentences are Markdown. `lib.study.calibration_results` draws the conclusions.
"""

from dataclasses import replace

from lib.shared.wording import table
from lib.study.calibration_results import giving
from lib.study.calibration_table import Row, lives, measured, nearest
from lib.study.calibration_targets import GROUPS, TARGETS
from neorl.evidence.priors import TO_THE_LETTER, WITHIN

*CHEAP, SINGLE_MAPS = GROUPS
IN_FULL = 100  # with as many runs or more, single maps have all of them
SETS, PAIRS = 8, 6  # the most that are listed: sets of claims that hold together, and pairs that never do


def few(runs):
    """Number of runs of the reading to the letter, if the best one has `runs`."""
    return max(2, runs // 5)


def runs_of_single_maps(runs):
    """Number of runs of the best reading's single maps, if its other conditions have `runs`."""
    return runs if runs >= IN_FULL else few(runs)


def confirm(best, steps, runs, seed):
    """Rerun the best row: (`Row` with the new statistics, {key of the condition: `Result`}).

    best: a `Row`. steps: of a run, at most. runs: of each condition, at least two; single maps have
    `runs_of_single_maps`.
    """
    row = replace(best, seed=seed, steps=steps, runs=max(2, runs))
    life = lives(row, CHEAP) | lives(replace(row, runs=runs_of_single_maps(runs)), [SINGLE_MAPS])
    return measured(row, life), life


def to_the_letter(steps, runs, seed):
    """Run the reading to the letter, with `few` of the runs: a `Row` with its statistics."""
    row = Row(0, seed, few(runs), steps, TO_THE_LETTER)
    return measured(row, lives(row))


def lives_of_others(rows, best, steps, seed):
    """Two runs of each row whose reading is not the best row's: [{key of the condition: `Result`}, …].

    The row at place i has the seed `seed` + i.
    """
    return [lives(replace(row, seed=seed + place, steps=steps, runs=2), CHEAP)
            for place, row in enumerate(rows) if row.reading != best.reading]


def in_short(complete, letter, confirmed, together):
    """The page's results in a few sentences.

    complete: rows that were run in every group. letter, confirmed: a `Row` each. together: a `Together`.
    """
    (most, _), claims = together.sets[0], len(together.claims)
    return (f"Of {len(complete):,} readings within the text that were run in every condition, "
            f"{agreeing(complete).lower()} agree with all {len(TARGETS)} targets (numbers of the thesis) at once. To "
            f"the letter, {len(letter.held)} of {claims} claims hold; under the best reading, in {confirmed.runs} "
            f"runs with fresh seeds, {len(confirmed.held)} do. The most that hold together in any one reading are "
            f"{len(most)}. Here a claim holds if its means agree with the thesis's numbers; the papers' pages judge "
            "by stricter rules.")


def agreeing(rows):
    """How many rows agree with all targets, as text. rows: of `Row`."""
    return str(sum(row.distance == 0 for row in rows) or "None")


def never_together(together):
    """Pairs of claims that never hold together, though by chance alone they would. together: a `Together`."""
    return "; ".join(f"{a} and {b}" for a, b in together.never) or "none"


def numbers(letter, best, confirmed):
    """The statistics of three rows beside the targets, as a table, each marked by whether it agrees with the thesis.

    letter, best, confirmed: a `Row` each, complete.
    """
    rows = []
    for name, target in _by_claim():
        interval = f"{target.low:.3g}\u00a0… {target.high:.3g}".replace("-", "−").replace("inf", "∞")
        measures = (_marked(target, *row.statistics[name]) for row in (letter, best, confirmed))
        rows.append([target.claim, target.label, target.thesis, interval, *measures])
    return table(["Claim", "Statistic", "Thesis", "Agrees", "To the letter", "Best, in the table", "Best, new seeds"],
                 rows)


def choices(readings):
    """The readings' values of each choice that the text leaves open, as a table. readings: {name: `Reading`}."""
    rows = [[choice.label, *(choice.words(getattr(reading, field)) for reading in readings.values())]
            for field, choice in WITHIN.items()]
    return table(["Choice", *readings], rows)


def idle_discount(best):
    """A sentence saying that γ has no effect under the best `Reading`, if so; else ""."""
    if best.learning.bootstrap or best.learning.memory > 0:
        return ""
    return "Without bootstrapping and memory nothing is discounted, so γ has no effect under the best reading."


def largest_sets(together):
    """The largest sets of claims that hold together, and the claims they lack, as a table. together: a `Together`."""
    rows = [[", ".join(names), str(count), ", ".join(name for name in together.claims if name not in names)]
            for names, count in together.sets[:SETS]]
    return table(["Claims that hold together", "Readings", "Missing"], rows)


def unseen_pairs(together):
    """Pairs of claims that hold together in no row, with the rows expected by chance. together: a `Together`."""
    pairs = together.unseen[:PAIRS]
    return "; ".join(f"{a} with {b} ({expected:.1f})" for a, b, expected in pairs) or "none"


def without_a_claim(rows):
    """The least distance to the targets without one claim, in ascending order, as a table. rows: of `Row`."""
    first, *_ = nearest(rows)
    found = {"nothing": (first.distance, first)}
    found |= sorted(giving(rows).items(), key=lambda given_up: given_up[1][0])
    return table(["Without", "Nearest distance to the others", "Held by that reading"],
                 [[claim, f"{distance:.2f}", ", ".join(sorted(row.held))] for claim, (distance, row) in found.items()])


def rows_by_group(rows):
    """How many rows ran in each group of conditions, and in how many waves. rows: of `Row`."""
    counts = ", ".join(f"{sum(group in row.groups for row in rows):,} {group}" for group in GROUPS)
    return f"{counts}; in {1 + max(row.wave for row in rows)} waves"


def targets():
    """The targets with the reasons for their intervals, as a table."""
    return table(["Claim", "Statistic", "Scale", "Why the interval is as wide as it is"],
                 [[each.claim, each.label, f"{each.scale:.3g}", each.reason] for _, each in _by_claim()])


def _by_claim():
    """The targets in the order of their claims, [(name, `Target`), …]."""
    return sorted(TARGETS.items(), key=lambda item: item[1].claim)


def equal(pairs):
    """How many rows equal those in the table when rerun. pairs: from `lib.study.calibration_table.rerun`."""
    return sum(old == new for old, new in pairs)


def _marked(target, value, error):
    return f"{'●' if target.holds(value) else '○'}\u00a0{value:z.2f} ±\u00a0{error:.2f}".replace("-", "−")
