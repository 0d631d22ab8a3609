"""Findings of the page on paper B: judged claims, numbers beside the thesis's, sentences.

`lived` is returned by `lib.paper_b.experiments.live`, {reading: {key: `Result`}}, and `watched` by
`lib.paper_b.trials.watch`, {reading: `Watched`}.
"""

import numpy as np

from lib.paper_b.experiments import of_figure_5
from lib.shared.wording import of_all
from neorl.core.modality import MODALITIES
from neorl.evidence import claims
from neorl.evidence.reading import PRIMES, additions, judge
from neorl.evidence.report import CALIBRATED, LETTER
from neorl.evidence.rules_chapters import sooner_with_more
from neorl.evidence.statements import STATEMENTS
from neorl.evidence.statistics import estimate, minutes_to_own_level, points, quotient, ratio, resets

B3, B4 = STATEMENTS["B3"], STATEMENTS["B4"]
PC = B3.also["place cells"].number  # per second, and of object-vector cells too: "no loss", section 3.1
THESIS_LEVELS = {"PC": PC, "OVC": PC, "PC + OVC": B3.bounds.number}
THESIS_MINUTES = {"PC": B4.also["place cells"].number, "PC + OVC": B4.bounds.number}
POINTS = STATEMENTS["B5"].bounds.number  # per reset
TUNINGS = {("component", "component"): "cartesian", ("margin", "margin"): "proximal", ("length", "direction"): "polar",
           ("direction",): "angle", ("length",): "length"}
STRETCHES = 100  # intervals of a run in which red creeps are counted


def judge_each(lived, watched):
    """Judge all claims of the page under each reading, in their order: {name: [`Claim`, …]}."""
    return {name: _judged(lived[name], each) for name, each in watched.items()}


def _judged(results, watched):
    found = {name: claim for name, claim in judge(results).items() if name[0] != "A"}
    near = {name: each.mean(axis=2) for name, each in watched.moved.items()}
    cost = watched.costs
    for claim in (claims.judge_points(results["points", "PC + OVC"]),
                  claims.judge_joining(results["joined"], results["place", "all"], results["brownian", 3]),
                  claims.judge_changes(results["revalued"], near),
                  claims.judge_cost(cost.first[-1], cost.alone, cost.none),
                  claims.judge_time_scale(PRIMES, watched.stays)):
        found[claim.name] = claim
    return [found[name] for name in STATEMENTS if name in found]


def in_short(lived):
    """The findings in a few sentences, beside the thesis's numbers."""
    level, minute = levels(lived), minutes(lived)
    by_letter = level[LETTER]
    return (f"In the calibrated reading, {_found(level[CALIBRATED], minute[CALIBRATED])} To the letter, place cells "
            f"earn {by_letter['PC']} per second, object-vector cells {by_letter['OVC']}, and both "
            f"{by_letter['PC + OVC']}. Brackets are 95 % intervals.")


def in_words(lived):
    """The findings under each reading, a paragraph of Markdown each: final levels, and the time to reach them."""
    level, minute = levels(lived), minutes(lived)
    return "\n\n".join(f"**{name.capitalize()}**, {_found(level[name], minute[name])}" for name in lived)


def _found(level, minute):
    taken = {name: f"{each.value:.0f}" for name, each in minute.items()}
    return (f"place cells finally earn {level['PC']} per second (thesis: {THESIS_LEVELS['PC']}), object-vector cells "
            f"{level['OVC']}, and both together {level['PC + OVC']} (thesis: {THESIS_LEVELS['PC + OVC']}). They reach "
            f"their final levels after {taken['PC']} minutes (thesis: more than {THESIS_MINUTES['PC']:g}), "
            f"{taken['OVC']}, and {taken['PC + OVC']} (thesis: {THESIS_MINUTES['PC + OVC']:g}).")


def levels(lived):
    """Final reward per second of figure 5's agents under each reading: {name: {agent: `Estimate`}}."""
    return {name: {agent: estimate(np.mean, result.rate(*claims.FINAL))
                   for agent, result in of_figure_5(results).items()} for name, results in lived.items()}


def minutes(lived):
    """Minutes until figure 5's agents reach their final level, as in `judge_pace`: {name: {agent: `Estimate`}}."""
    keys = {"PC": ("pace", "place"), "OVC": ("pace", "objects"), "PC + OVC": ("pace", "both")}
    return {name: {agent: minutes_to_own_level(results[key]) for agent, key in keys.items()}
            for name, results in lived.items()}


def modalities_table():
    """The modalities that the thesis names, as a Markdown table."""
    rows = ["| Cell | Reference frame | Tuned to | Map |", "|---|---|---|---|"]
    return "\n".join([*rows, *(f"| {each.name} | {each.frame} | {' × '.join(each.names)} "
                               f"({TUNINGS[tuple(axis.feature for axis in each.axes)]}) | {len(each.axes)}-D |"
                               for each in MODALITIES)])


def values_table(watched):
    """Mean values of either modality under each reading, and their ratio, as a Markdown table."""
    rows = ["| Reading | PC | OVC | OVC / PC (author's remark: 3) |", "|---|---|---|---|"]
    for name, each in watched.items():
        places, objects = each.values["PC"], each.values["OVC"]
        means = (estimate(np.mean, values) for values in (places, objects, quotient(objects, places)))
        rows.append(f"| {name} | {' | '.join(map(str, means))} |")
    return "\n".join(rows)


def sizes_table(sizes):
    """The number of values and the microseconds of a step of each kind of agent, as a Markdown table.

    sizes: of `trials.size_and_cost`.
    """
    rows = ["| State | Values | Time per step, µs |", "|---|---|---|"]
    return "\n".join([*rows, *(f"| {name} | {values:,} | {cost:.2f} |" for name, (values, cost) in sizes.items())])


def points_a_reset(lived):
    """Points per reset of figure 5's agents and of Brownian motion under each reading: {name: {agent: `Estimate`}}."""
    return {name: {key[1]: estimate(ratio, points(result), resets(result)) for key, result in results.items()
                   if key[0] == "points"} for name, results in lived.items()}


def expected_points(world):
    """Expected points per reset, independent of the agent: twice the initial number of green creeps.

    Each of a board's n creeps is green with a probability of one half, and at least one is: n / (1 − 2^−n).
    """
    return world.n_creeps / (1 - 0.5**world.n_creeps)


def points_in_words(found, expected):
    """How `expected_points` arise, and how many intervals of `points_a_reset` contain them, if there are any."""
    text = f"A new board has {expected / 2:.2f} green creeps on average, which gives {expected:.2f} points per reset."
    intervals = [each for of_agents in found.values() for each in of_agents.values() if not np.isnan(each.low)]
    if not intervals:
        return text
    within = sum(each.low <= expected <= each.high for each in intervals)
    return f"{text} That lies within {of_all(within, len(intervals))} intervals."


def revaluing(lived):
    """Results of agents that revalue red creeps under each reading, without and with exploration: {name: `Result`}."""
    return {f"{name}{suffix}": results[key] for name, results in lived.items()
            for suffix, key in (("", "revalued"), (", exploring", ("revalued", "exploring")))}


def red_a_minute(revalued):
    """Red creeps taken per minute in runs that revalue them: ({name: (runs, stretches)}, (stretches,)).

    revalued: what `revaluing` returns. The run is cut into equal stretches; the second array has their midpoints, in
    minutes of the first result.
    """
    edges = np.linspace(0, 1, STRETCHES + 1)
    curves = {name: np.stack([60 * result.hit_rate(*pair)[:, 1] for pair in zip(edges[:-1], edges[1:])], axis=1)
              for name, result in revalued.items()}
    return curves, (edges[:-1] + edges[1:]) / 2 * next(iter(revalued.values())).seconds / 60


def red_in_words(curves):
    """Red creeps taken before and after they are revalued, from the curves of `red_a_minute`."""
    lines = []
    for name, curve in curves.items():
        half, fifth = curve.shape[1] // 2, curve.shape[1] // 5
        before, after, later = curve[:, half - 1].mean(), curve[:, half].mean(), curve[:, -fifth:].mean()
        lines.append(f"- {name.capitalize()}: {before:.1f} red creeps per minute in the hundredth of the run before "
                     f"the change, {after:.1f} in the one after it, and {later:.1f} in the last fifth.")
    return "\n".join(lines)


def green_in_words(revalued):
    """Green creeps taken before red ones are revalued and long after, from the results of `revaluing`."""
    lines = []
    for name, result in revalued.items():
        before, later = (60 * result.hit_rate(*part)[:, 0].mean() for part in ((0.3, 0.5), (0.8, 1)))
        lines.append(f"- {name.capitalize()}: {before:.1f} green creeps per minute in the fifth of the run before the "
                     f"change, and {later:.1f} in the last fifth.")
    return "\n".join(lines)


def roaming_in_words(roamed):
    """How far agents roam before and after red creeps are revalued: {name: what `trials.roaming` returns}."""
    return " ".join(f"{name.capitalize()}, an agent's root mean square distance from its mean position is "
                    f"{before.mean():.2f} board widths before the change and {end.mean():.2f} at the end."
                    for name, (before, end) in roamed.items())


def distances_in_words(watched):
    """Distance of agents from a desired place after its first two moves, and after the later ones, by reading."""
    lines = []
    for name, each in watched.items():
        experienced, ignorant = (f"{moved[:, :2].mean():.2f} and {moved[:, 2:].mean():.2f}"
                                 for moved in (each.moved["experienced"], each.moved["ignorant"]))
        lines.append(f"{name.capitalize()}, it is {experienced} for experienced agents, {ignorant} for untrained ones.")
    return " ".join(lines)


def joining_in_words(lived):
    """Reward per second in the twentieth of the run before other cells join, and in the one after, by reading."""
    rates = {name: [results["joined"].rate(*part).mean() for part in ((0.45, 0.5), (0.5, 0.55))]
             for name, results in lived.items()}
    return " and ".join(f"{before:.2f} and {after:.2f} per second ({name})" for name, (before, after) in rates.items())


def minutes_with_more_maps(lived):
    """Lead of agents with more maps over those with fewer, in minutes: {name: {addition: `Estimate`}}."""
    return {name: {added: sooner_with_more(more, fewer) for added, (more, fewer, _) in additions(results).items()}
            for name, results in lived.items()}
