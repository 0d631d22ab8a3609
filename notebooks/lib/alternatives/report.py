"""Sentences and tables of the page on alternatives, in Markdown, and the verdict on claim C5.

`earned` is {name: `Earned`} of one board, as `lib.alternatives.contestants.compete` returns it, and `boards`
is {creeps: earned}.
"""

import numpy as np

from lib.alternatives import deep_settings, search
from lib.alternatives.contestants import (BEYOND, CHANCE, DEEP, PHYSICS, READINGS, TABLES, THESIS,
                                                     after_long)
from lib.alternatives.living import BOARDS
from lib.alternatives.stored import FOLDER, chosen, read_search
from lib.shared.wording import listed, number, table
from neorl.evidence.claims import RUNS_FOR_A_VERDICT, judge_alternatives
from neorl.evidence.statistics import difference, estimate

LEVELS = (0.5, 1, 2, 3)  # reward per second
FINAL = 0.8  # share of a run after which its reward is final
WINDOW = 0.1  # share of a run over which its mean reward has to reach a level
LATE = 50_000  # steps before each of three moments of a long run


def final(each):
    """Final reward per second of an `Earned`: float64 (runs,)."""
    return each.rate(FINAL * each.steps, each.steps)


def best_of(earned, *kinds):
    """Name of the contestant of these kinds with the highest final reward, or None if there is none."""
    names = [name for name, each in earned.items() if each.kind in kinds]
    return max(names, key=lambda name: final(earned[name]).mean(), default=None)


def shown(earned):
    """The contestants in the figure: all, but only the best of the thesis's agents under each reading."""
    best = {best_of(_under(earned, reading), THESIS) for reading in READINGS}
    return {name: each for name, each in earned.items() if each.kind != THESIS or name in best}


def judge(earned, steps):
    """Judge claim C5 under each reading: {reading: `Claim`}.

    Only learners with runs of `steps` steps count, and with enough runs for a verdict or as many as Brownian motion.
    """
    enough = min(earned["Brownian motion"].runs, RUNS_FOR_A_VERDICT)
    alternatives = {name: (final(each), each.seconds) for name, each in earned.items()
                    if each.kind in (TABLES, DEEP) and each.steps == steps and each.runs >= enough}
    return {reading: judge_alternatives(alternatives,
                                        {name: final(each) for name, each in _under(earned, reading).items()},
                                        final(earned["Brownian motion"]), 1 / BOARDS[3].fps) for reading in READINGS}


def _under(earned, reading):
    return {name: each for name, each in earned.items() if each.kind == THESIS and name.endswith(reading)}


def summary(boards):
    """The page's result in a paragraph."""
    parts = []
    for creeps, earned in boards.items():
        tabular, deep, thesis = (best_of(earned, kind) for kind in (TABLES, DEEP, THESIS))
        ours = best_of(earned, BEYOND)
        best = [f"the best {kind} learner ({name}) {_rate(earned, name)}"
                for kind, name in (("tabular", tabular), ("deep", deep)) if name]
        best += [f"the agent of this part of the book ({ours}) {_rate(earned, ours)}"] if ours else []
        listing = ", ".join(best[:-1]), *best[-1:]
        parts.append(f"With {creeps} creeps, the thesis's best agent ({thesis}) earns {_rate(earned, thesis)} reward "
                     f"per second over the last fifth of the run; {' and '.join(filter(None, listing))}. Controllers "
                     f"that know the physics earn {_rate(earned, 'nearest green')} and {_rate(earned, 'PD')}, and a "
                     f"planner {_rate(earned, 'planner')}.")
    return "\n\n".join([_more(boards[3]), *parts])


def _rate(earned, name):
    return number(final(earned[name]).mean())


def results_table(earned):
    """Reward in thirds, steps to levels, time and memory of each contestant."""
    rows = [[name, each.runs, *(number(part.mean()) for part in thirds(each)[:2]), _level(each),
             *(_steps_to(each, level) for level in LEVELS), _microseconds(each), f"{each.kilobytes:,.3g}"
             if each.kilobytes < 1_000 else f"{each.kilobytes:,.0f}"] for name, each in earned.items()]
    return table(["", "runs", "first third", "second", "last", *(f"to {level:g}" for level in LEVELS), "µs per step",
                  "kB"], rows)


def thirds(each):
    """Reward per second in each third of the runs of an `Earned`: a list of three float64 (runs,)."""
    return [each.rate(part * each.steps / 3, (part + 1) * each.steps / 3) for part in range(3)]


def _level(each):
    return estimate(np.mean, thirds(each)[2])


def _steps_to(each, level):
    if each.kind == PHYSICS:
        return "at once" if each.rate(0, each.steps).mean() >= level else "–"
    steps = np.median(each.steps_to(level, WINDOW * each.steps))
    return f"{steps / 1_000:,.0f}" if np.isfinite(steps) else "–"


def _microseconds(each):
    return f"{each.seconds * 1e6:.2g}" if each.seconds < 1e-4 else f"{each.seconds * 1e6:,.0f}"


def long_runs(boards):
    """The stored long runs of all contestants that learn: {creeps: {name: `Earned`}}."""
    return {creeps: after_long(creeps, {name: each.kind for name, each in earned.items() if each.kind != PHYSICS})
            for creeps, earned in boards.items()}


def long_in_words(boards):
    """What the best contestant of each kind earns at the end of the long runs. boards: from `long_runs`."""
    parts = []
    for creeps, earned in boards.items():
        late = {name: each.rate(each.steps - LATE, each.steps).mean() for name, each in earned.items()}
        best = {max((name for name in late if earned[name].kind == kind), key=late.get)
                for kind in {each.kind for each in earned.values()} - {CHANCE}}
        names = sorted(best, key=late.get, reverse=True)
        parts.append(f"With {creeps} creeps: {listed([f'{name} ({number(late[name])})' for name in names])}.")
    steps = max(each.steps for earned in boards.values() for each in earned.values())
    return (f"The best contestant of each kind, with its reward per second over the last {LATE:,} of {steps:,} steps. "
            f"{' '.join(parts)}")


def long_table(boards):
    """Reward per second over the `LATE` steps before three moments of the long runs. boards: from `long_runs`."""
    rows = [[creeps, name, each.runs, *(estimate(np.mean, each.rate(end - LATE, end))
                                        for end in (150_000, each.steps // 2, each.steps))]
            for creeps, earned in boards.items() for name, each in earned.items()]
    return table(["creeps", "", "runs", "before step 150,000", "300,000", "600,000"], rows)


def search_table():
    """How many settings were tried for each method, what they earned, and below the table which one is used."""
    rows, used = [], []
    for file, setting in (("search.csv", lambda *at: search.setting_of(*at)._asdict()),
                          ("deep_search.csv", deep_settings.settings_of)):
        tried = read_search(FOLDER / file)
        for method, best in chosen(tried).items():
            rates = [row["rate"] for row in tried if row["method"] == method]
            rows.append([method, len(rates), number(np.median(rates)), number(max(rates))])
            used.append(f"- *{method}*: " + ", ".join(f"{name.replace('_', ' ')} {_short(value)}"
                                                      for name, value in setting(method, best).items()))
    return "\n".join([table(["", "settings tried", "median", "best, which is used"], rows), "",
                      "The settings used:", "", *used])


def search_in_words(earned):
    """The size of the search for settings, in runs, and in processor time at each learner's time per step."""
    tabular, deep = (steps * np.median([each.seconds for each in earned.values() if each.kind == kind])
                     for kind, steps in ((TABLES, search.SETTINGS * search.RUNS * search.STEPS),
                                         (DEEP, deep_settings.SETTINGS * deep_settings.SEARCH_STEPS)))
    return (f"For each tabular learner and for PD, {search.SETTINGS} settings were drawn and tried in {search.RUNS} "
            f"runs of {search.STEPS:,} steps each. Deep learners take thousands of times as long, so for each of them "
            f"{deep_settings.SETTINGS} settings were drawn and tried in one run of {deep_settings.SEARCH_STEPS:,} "
            f"steps each. At their times per step above, the search took about {tabular:.0f} seconds of processor time "
            f"for each tabular learner and {deep:.0f} for each deep one.")


def _short(value):
    return ("no", "yes")[value] if isinstance(value, bool) else f"{value:.3g}" if isinstance(value, float) else value


def meaning(boards):
    """Conclusions of the comparison, as a list: the claim, states, sample efficiency and the room for improvement."""
    lines = [_over_the_thesis(boards[3]), _heads(boards), _pace(boards[3]), _distance(boards)]
    return "\n".join(f"- {line}" for line in lines)


def _over_the_thesis(earned):
    return f"**Can others do this?** {_more(earned)}"


def _more(earned):
    others = {name: final(each) for name, each in earned.items() if each.kind in (TABLES, DEEP)}
    best = final(earned[best_of(earned, THESIS)])
    more = [name for name, rates in others.items() if rates.mean() > best.mean()]
    unclear = [name for name in more if estimate(difference, others[name], best).low <= 0]
    return (f"With three creeps, {len(more)} of the {len(others)} tabular and deep learners earn more over the last "
            f"fifth of the run than the thesis's best agent: {listed(more)}."
            + (f" For {listed(unclear)} the 95 % interval of the difference includes zero." if unclear else ""))


def _heads(boards):
    lines = []
    for creeps, earned in boards.items():
        heads, joint, whole = (number(final(earned[name]).mean()) for name in ("hybrid reward", "joint cells",
                                                                              "monolithic"))
        lines.append(f"with {creeps} creeps they earn {heads} per second with a head for each creep, {joint} with "
                     f"joint cells and {whole} with the whole scene as one state")
    return (f"**What counts is the state.** All tabular learners learn by the same rule. Over the last fifth of the "
            f"run, {'; '.join(lines)}.")


def _pace(earned):
    level = LEVELS[0]
    taken = {name: np.median(each.steps_to(level, WINDOW * each.steps)) for name, each in earned.items()
             if each.kind in (TABLES, DEEP, THESIS, BEYOND)}
    order = sorted((name for name in taken if np.isfinite(taken[name])), key=taken.get)
    text = listed([f"{name} {taken[name] / 1_000:,.0f}" for name in order])
    least = min(each.steps for each in earned.values() if each.kind in (TABLES, DEEP, THESIS, BEYOND)) * WINDOW
    return (f"**Sample efficiency.** Thousands of steps until half of the runs have reached {level} per second with "
            f"three creeps, in the mean over {least / 1_000:,.3g} thousand steps, so that none is lower: {text}. The "
            "others do not reach it.")


def _distance(boards):
    lines = []
    for creeps, earned in boards.items():
        best = best_of(earned, TABLES, DEEP, BEYOND)
        share = {name: 100 * final(earned[best]).mean() / final(earned[name]).mean() for name in ("PD", "planner")}
        lines.append(f"with {creeps} creeps the best learner ({best}) earns {share['PD']:.0f} % of PD's "
                     f"reward and {share['planner']:.0f} % of the planner's")
    return f"**There is room for improvement.** Over the last fifth of the run, {'; '.join(lines)}."
