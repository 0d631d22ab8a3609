"""Calibration: which values of the choices that the thesis leaves open reproduce all of its printed numbers at once?

The method is history matching (Craig et al. 1997; Vernon et al. 2010), a search that rules out implausible readings
rather than one that climbs to the best fit. The page on the search explains it. Its steps:

1. `calibrate` runs a *design*, readings spread evenly through the priors within the text. All are run in the two cheap
   groups of conditions, and the first 48 in every group, so that the others are not run for favourites alone.
2. Then it runs *waves* of `candidates`: readings that are promising, or not implausible, by an `Emulator` of all
   results so far. A wave runs its candidates in both cheap groups. Object vectors and both modalities are run for the
   readings that are most promising for paper B, networks and single maps for those most promising for all papers.
3. `refine` searches near the leading readings of more runs, with more runs each. A round runs children in one group
   after the other, and after each only those go on for which most claims hold, the nearest first. Between two memories,
   half of the children have each of the states of object vectors in `FAMILIES`. `attempt` runs readings that trials
   elsewhere point at, so that a search can begin from them.
4. `screen` runs readings again that agree with most targets in few runs, wherever in the priors they lie.
5. `rescale` runs the leading one in paper C with other units of a desire vector, which concern no other paper.
6. `confirm` runs the leading readings again with fresh seeds, since a search over noisy numbers finds lucky ones.
7. `set_back` runs the book's reading with one choice at a time set back to the letter.

Every row has its own seed, so that no tank's luck is shared by all; only rows that vary one reading share theirs.
"""

import time
from dataclasses import replace

import numpy as np
import scipy

from companion.thesis.priors import WITHIN
from companion.study import calibration_table
from companion.study.calibration_table import Row
from companion.study.calibration_targets import GROUPS, TARGETS
from neorl.agents.papers import LAYERS
from companion.thesis.reading import TO_THE_LETTER, Reading
from neorl.common.extras import require

RUNS, STEPS = 2, 600_000  # of a reading: the papers' own lengths
DESIGN, IN_FULL = 512, 48  # readings in wave 0, a power of two, and how many of them are run in every group
CHUNK = 32  # readings run between two checks of the clock
CHEAP = ("places", "layers")
WAVE = {"places": 112, "layers": 112, "objects": 256, "both": 256, "networks": 32, "single": 32}  # readings per wave
POOL = 4_000  # candidates per wave
PARENTS, RENEWED, MOVED = 30, 0.1, 0.05  # of children: best rows, share of choices redrawn, spread of moved numbers
ROUND = {"both": 24, "objects": 14, "places": 14, "layers": 14, "single": 8, "networks": 8}  # readings per round
WITHIN_MEMORIES = {"layers": 24, "places": 24, "both": 12, "single": 8, "objects": 6, "networks": 5}  # cheap ones first
FAMILIES = ("self", "per object")  # states of object vectors between two memories
SCREENED = {"layers": 100, "places": 40, "objects": 40, "both": 40, "single": 8, "networks": 8}  # of readings screened
SCREENED_RUNS = 16  # a reading that was run as often or less is screened
KEPT = 12  # leading readings whose children a round of `refine` runs
IMPLAUSIBLE = 3.0
TREES, LEAF, FEWEST = 100, 3, 24  # of a forest: trees, fewest rows in a leaf, fewest rows to fit
FAR = 8.0  # scales: the emulator clips values that lie farther than this outside an interval
DIGITS = 4  # significant digits of a chosen number


def calibrate(minutes, table=(), seed=0, runs=RUNS, steps=STEPS, keep=None):
    """Run readings for a number of minutes, and return the table that includes them: a list of `Row`.

    table: rows to continue from. seed: of the design and of the candidates; row i is run with the seed
    1000 · seed + i. keep: called with the table whenever it has grown. The clock is checked between chunks.
    """
    end = time.monotonic() + 60 * minutes
    table = list(table)
    work = _work(table, seed, runs, steps)
    while time.monotonic() < end:
        group, chosen = next(work)
        for place, row in zip(chosen, calibration_table.run([table[i] for i in chosen], group)):
            table[place] = row
        if keep:
            keep([row for row in table if row.statistics])
    return [row for row in table if row.statistics]


def refine(minutes, table, runs, seed, keep, memories=None):
    """Search near the 12 leading readings of more than 2 runs for a number of minutes, and return the longer table.

    memories: the least and the greatest, > 0, of all children: those of leading readings between them in the same
        family, or of all leading readings if there are fewer than two.
    """
    end = time.monotonic() + 60 * minutes
    table, numbers = list(table), WITHIN_MEMORIES if memories else ROUND
    while time.monotonic() < end:
        rng = np.random.default_rng([seed, _next_wave(table)])
        best = [row.reading for row in calibration_table.leading([row for row in table if row.runs > RUNS])]
        n = max(numbers.values())
        drawn = (_children(best, n, rng) if memories is None else
                 [child for state in FAMILIES for child in _family(best, state, memories, n // len(FAMILIES), rng)])
        table += _sieved(_new_rows(table, drawn, runs, seed), numbers)
        keep(table)
    return table


def _children(readings, n, rng):
    """n children of the first of some readings."""
    best = readings[:KEPT]
    return [_child(*(best[i] for i in rng.integers(len(best), size=2)), rng) for _ in range(n)]


def _family(readings, state, memories, n, rng):
    """n children with a state of object vectors, and a memory between two, which is redrawn if it is not."""
    near = [reading for reading in _between(readings, memories) if reading.object_state == state]
    low, high = memories
    return [child.varied(object_state=state, memory=child.learning.memory if _between([child], memories) else
                         _short(low * (high / low) ** rng.random()))
            for child in _children(near if len(near) > 1 else readings, n, rng)]


def _between(readings, memories):
    return [reading for reading in readings if memories[0] <= reading.learning.memory <= memories[1]]


def attempt(table, readings, runs, seed):
    """Run readings in every group, and return the table that includes their rows."""
    return [*table, *_complete(_new_rows(table, readings, runs, seed))]


def _complete(rows):
    for group in GROUPS:
        rows = calibration_table.run(rows, group)
    return rows


def _sieved(rows, numbers):
    """Rows that were run in one group after the other, in each as many of those that remain as {group: number} says.

    Those go on for which most claims hold, the nearest first.
    """
    done = []
    for group, n in numbers.items():
        rows = sorted(rows, key=lambda row: (-len(row.agreeing), row.distance))
        done += rows[n:]
        rows = calibration_table.run(rows[:n], group)
    return sorted([*rows, *done], key=lambda row: row.seed)


def screen(table, runs, seed):
    """Run promising readings again with fresh seeds, and return the table that includes their rows.

    Those of few runs under which A6 and A7 hold come first, then those nearest to the numbers of these and of paper B.
    """
    names = [name for group in ("layers", "places", "objects", "both") for name in GROUPS[group].targets]
    measured = sorted((row for row in table if all(name in row.statistics for name in names)), key=lambda row: row.runs)
    most = {row.reading: replace(row, statistics={name: row.statistics[name] for name in names}) for row in measured}
    found = sorted((row for row in most.values() if row.runs <= SCREENED_RUNS),
                   key=lambda row: (not {"A6", "A7"} <= row.agreeing, row.distance))
    rows = _new_rows(table, [row.reading for row in found[: max(SCREENED.values())]], runs, seed)
    return [*table, *_sieved(rows, SCREENED)]


def rescale(table, scales, runs):
    """Run the leading of the complete rows of some runs again in paper C, with other scales of desires.

    Vectors are by size, and maps are those of paper A. No other number depends on these, so the rows are complete.
    """
    first = next(row for row in calibration_table.leading(table) if row.runs == runs)
    rows = [replace(first, wave=_next_wave(table), reading=replace(first.reading, vectors="by size", scale=float(scale),
                                                                   network_resolutions=LAYERS)) for scale in scales]
    return [*table, *calibration_table.run(rows, "networks")]


def confirm(table, n, runs, seed=0, memories=None):
    """Run the n leading readings of a table again, with fresh seeds, and return the table that includes the new rows.

    Readings that have been run only twice come last, and those that have been confirmed twice with as many runs are
    left out, as are memories that are not between two. If the last wave of the table is such a confirmation, its
    readings are confirmed once more. Raises ValueError if no row is complete.
    """
    first = [row for row in calibration_table.leading(table) if row.runs < 2 * runs]
    first = sorted(first, key=lambda row: row.runs <= RUNS)
    last = [row for row in table if row.wave == _next_wave(table) - 1]
    if len(last) == n and {row.runs for row in last} == {runs}:
        first = last
    first = [row for row in first if memories is None or _between([row.reading], memories)][:n]
    again = _new_rows(table, [row.reading for row in first], runs, seed)
    return [*table, *_complete([replace(new, steps=row.steps) for new, row in zip(again, first)])]


def set_back(table, runs, seed):
    """Run the reading to the letter, and the default with each choice that departs from it set back, in every group.

    Those that a table has already are left out.
    """
    here, letter = Reading(), TO_THE_LETTER.choices
    readings = [here.varied(**{name: letter[name]}) for name in WITHIN if here.choices[name] != letter[name]]
    known = {row.reading for row in table if row.complete}
    rows = _new_rows(table, [reading for reading in (TO_THE_LETTER, *readings) if reading not in known], runs, seed)
    return [*table, *_complete([replace(row, seed=rows[0].seed) for row in rows])]


def _next_wave(table):
    return 1 + max((row.wave for row in table), default=0)


def _new_rows(table, readings, runs, seed):
    """Rows of the next wave, which have not been run, with the seeds of the next places in the table."""
    begin = 1_000 * seed + len(table)
    return [Row(_next_wave(table), begin + i, runs, STEPS, reading) for i, reading in enumerate(readings)]


def _work(table, seed, runs, steps):
    """Yield without end what to run next: (group, places in the table). New rows join the table when drawn."""
    def add(wave, readings):
        begin = len(table)
        table.extend(Row(wave, 1_000 * seed + begin + i, runs, steps, reading) for i, reading in enumerate(readings))
        return range(begin, len(table))

    if len(table) < DESIGN:
        add(0, design(DESIGN, seed)[len(table):])
    for group in GROUPS:
        yield from _chunks(group, _lacking(table, group, range(DESIGN if group in CHEAP else IN_FULL)))
    while True:
        wave = 1 + max(row.wave for row in table)
        rng = np.random.default_rng([seed, wave])
        emulator = Emulator(table, seed=wave)
        new = add(wave, candidates(table, emulator, WAVE[CHEAP[0]], rng))
        for group, members in GROUPS.items():
            if group in CHEAP:
                yield from _chunks(group, new)
                continue
            emulator = Emulator(table, seed=wave)
            ready = _lacking(table, group, range(len(table)))
            ready = ready if group == "objects" else [i for i in ready if "objects" in table[i].groups]
            papers = "B" if members.paper == "B" else "ABC"
            order = np.argsort(prospects([table[i] for i in ready], emulator, papers), kind="stable")
            yield from _chunks(group, [ready[i] for i in order[: WAVE[group]]])


def _lacking(table, group, places):
    return [i for i in places if group not in table[i].groups]


def _chunks(group, places):
    for begin in range(0, len(places), CHUNK):
        yield group, list(places[begin : begin + CHUNK])


def design(points, seed=0):
    """Readings spread evenly through the priors within the text, a list of `Reading`: see `reading_at`."""
    sequence = scipy.stats.qmc.Sobol(len(WITHIN), rng=np.random.default_rng(seed))
    return [reading_at(row) for row in sequence.random(points)]


def reading_at(shares):
    """The reading with each choice in `WITHIN` at a quantile of its prior, rounded; others are to the letter."""
    chosen = {name: _short(choice.at(share)) for (name, choice), share in zip(WITHIN.items(), shares)}
    return TO_THE_LETTER.varied(**chosen)


def _short(value):
    return float(f"{value:.{DIGITS}g}") if isinstance(value, float) else value


class Emulator:
    """Random forests that predict the statistics of a reading from its choices, one for each group with enough rows.

    A prediction's uncertainty combines the disagreement of the trees and the noise of a few runs. `explained` has the
    R² of each target in the rows of the design, each predicted by the trees that were grown without it.
    """

    def __init__(self, table, seed=0):
        self.forests, self.noise, self.explained = {}, {}, {}
        for group, members in GROUPS.items():
            rows = [row for row in table if group in row.groups]
            if len(rows) >= FEWEST:
                found = np.array([[row.statistics[name] for name in members.targets] for row in rows])
                scaled = [_clipped(TARGETS[name], found[:, i, 0]) / TARGETS[name].scale
                          for i, name in enumerate(members.targets)]
                forest = require("sklearn.ensemble", extra="book").RandomForestRegressor(
                    TREES, min_samples_leaf=LEAF, max_features=0.5, random_state=seed, oob_score=True)
                self.forests[group] = forest.fit(features([row.reading for row in rows]),
                                                 np.squeeze(np.transpose(scaled)))
                self.noise[group] = np.median(found[:, :, 1], axis=0)
                even = [i for i, row in enumerate(rows) if row.wave == 0]
                known, unseen = np.transpose(scaled)[even], forest.oob_prediction_.reshape(len(rows), -1)[even]
                residue = np.mean((known - unseen) ** 2, axis=0) / known.var(axis=0)
                self.explained |= dict(zip(members.targets, 1 - residue))

    def predict(self, readings):
        """The mean and the standard deviation of each predicted target: {name: (mean, deviation)}, (readings,) each."""
        at = features(readings)
        found = {}
        for group, forest in self.forests.items():
            trees = np.stack([tree.predict(at).reshape(len(at), -1) for tree in forest.estimators_])
            for i, name in enumerate(GROUPS[group].targets):
                scale = TARGETS[name].scale
                spread = np.hypot(scale * trees[..., i].std(axis=0), self.noise[group][i])
                found[name] = scale * trees[..., i].mean(axis=0), spread
        return found

    def implausibility(self, readings):
        """The distances of the predictions from each predicted target: {name: (readings,)}."""
        return {name: TARGETS[name].distance(*found) for name, found in self.predict(readings).items()}


def _clipped(target, values):
    ends = [end for end in (target.low, target.high) if np.isfinite(end)]
    return np.clip(values, min(ends) - FAR * target.scale, max(ends) + FAR * target.scale)


def features(readings):
    """Readings as the emulator sees them: float64 (readings, features).

    A number becomes its place in its prior, from 0 to 1; each level of a choice in words becomes a feature, 0 or 1.
    """
    chosen, columns = [reading.choices for reading in readings], []
    for name, choice in WITHIN.items():
        values = [each[name] for each in chosen]
        if isinstance(values[0], str):
            columns += [[value == level for value in values] for level in dict.fromkeys(choice.prior)]
        else:
            columns.append([choice.place(value) for value in values])
    return np.array(columns, float).T


def prospects(rows, emulator, papers="ABC"):
    """How far rows are from the targets of papers, as measured or predicted."""
    if not rows:
        return np.zeros(0)
    each = emulator.implausibility([row.reading for row in rows])
    each = {name: distances for name, distances in each.items() if name[0] in papers}
    for name, target in TARGETS.items():
        if name[0] not in papers:
            continue
        each.setdefault(name, np.zeros(len(rows)))
        for i, row in enumerate(rows):
            if name in row.statistics:
                each[name][i] = target.distance(*row.statistics[name])
    return np.sqrt(np.mean(np.minimum(list(each.values()), 4.0) ** 2, axis=0))


def candidates(table, emulator, n, rng):
    """Readings to run next, a list of n `Reading`.

    Half are drawn from the priors; half are children of the readings nearest to the targets. A third of the n are the
    most promising for paper B, a third for all papers, and the others are drawn at random from those whose
    *implausibility*, the largest distance of a prediction from its target, is below 3.
    """
    drawn = [reading_at(shares) for shares in rng.random((POOL // 2, len(WITHIN)))]
    for papers in ("B", "ABC"):
        best = [table[i].reading for i in np.argsort(prospects(table, emulator, papers), kind="stable")[:PARENTS]]
        drawn += [_child(*(best[i] for i in rng.integers(len(best), size=2)), rng) for _ in range(POOL // 4)]
    far, rows = emulator.implausibility(drawn), [Row(0, 0, 0, 0, reading) for reading in drawn]
    chosen = []
    for papers in ("B", "ABC"):
        worst = np.max([each for name, each in far.items() if name[0] in papers], axis=0)
        order = np.lexsort([prospects(rows, emulator, papers), worst >= IMPLAUSIBLE])
        chosen += [i for i in order if i not in chosen][: n // 3]
    rest = [i for i in order if i not in chosen]  # now by all papers
    plausible = [i for i in rest if worst[i] < IMPLAUSIBLE]
    others = [*rng.permutation(plausible), *(i for i in rest if worst[i] >= IMPLAUSIBLE)]
    return [drawn[i] for i in (*chosen, *others[: n - len(chosen)])]


def _child(mother, father, rng):
    """A reading that takes each choice from one of two parents or redraws it; inherited numbers move a little."""
    chosen = {}
    for name, choice in WITHIN.items():
        value = (mother if rng.random() < 0.5 else father).choices[name]
        if rng.random() < RENEWED:
            value = choice.at(rng.random())
        elif not isinstance(choice.prior, tuple):
            value = choice.at(np.clip(choice.place(value) + MOVED * rng.standard_normal(), 0.0, 1.0 - 1e-9))
        chosen[name] = _short(value)
    return TO_THE_LETTER.varied(**chosen)
