"""What the page on paper A needs beside its experiment: squares of the board, tables and figures.

1. Results of the first experiment are `single`, {name: `Result`}, of agents with one map and of "Brownian motion";
   those of the second are `several`, of agents with each layer and, last, of the agent with "all maps".
2. The layers are those of the paper's second experiment unless the page has been given others. The thesis's numbers,
   and the names of its figures, go only with its own maps and 8 creeps.
"""

import numpy as np

from companion.page.parameters import FINEST
from companion.page.panels import FILL, mark
from companion.page.wording import table
from companion.page.thesis_figures import mark_levels
from neorl.core.horde import as_vectors, superpose
from neorl import CARDINAL, NresMap, Run
from neorl.statistics import estimate
from neorl.drawing.curves import draw_sums
from neorl.drawing.style import GREEN, INK, RED, looks
from neorl.drawing.value_maps import draw_cells, draw_values
from companion.thesis.reading import LAYERS, LENGTHS, READINGS, SINGLE, conditions
from companion.thesis.statements import STATEMENTS
from companion.thesis.verdict import FINAL

N_CREEPS = 8  # of the paper


def superposed_field(q, goals, valences):
    """The superposed value of each action in every cell of a map (eq. 4.3 and 4.4): float64 (cells, 4)."""
    return np.array([superpose(q, cell, goals, valences) for cell in range(len(q))])


def all_of(layers):
    """The agent with all layers, by name: "all three" for three."""
    return {2: "both", 3: "all three"}.get(len(layers), "all")


def squares_entered(agent, world, steps, runs, seed=0):
    """The squares of the board in which runs of an agent have been so far, every 0.1 s: (runs, moments).

    The squares are the cells of N90, which divides the board at least as finely as any map of the agents.
    """
    squares, found, interval = NresMap(FINEST), [], max(1, round(world.fps / 10))
    for k in range(runs):
        recorded = Run(agent, world, seed, k).record(max(interval, steps // interval * interval), every=interval)
        path = recorded.positions[1:] / world.size
        new = np.zeros(len(path), int)
        new[np.unique(squares.encode(path), return_index=True)[1]] = 1
        found.append(new.cumsum())
    return np.array(found)


def rates(results, share):
    """Mean reward per second of the second experiment's agents in a share of the run, as a Markdown table.

    results: {reading: several}.
    """
    names = next(iter(results.values()))
    return table(["Reading", *names], [
        [reading, *(estimate(np.mean, result.rate(*share)) for result in several.values())]
        for reading, several in results.items()])


def explorer_conditions(single, several):
    """The conditions that the page's Explorer offers: {name: `Condition` or `Result`}, as they were given."""
    *alone, together = several.items()
    seven = _as_in(7, together[1], _layers(several) == LAYERS)
    offered = {f"{seven}: {all_of(alone)} maps": together[1]}
    offered |= {f"{seven}: {name} alone": result for name, result in alone}
    of_paper = {*(f"N{n}" for n in SINGLE), "Brownian motion"}
    return offered | {f"{_as_in(6, result, name in of_paper)}: {name}": result for name, result in single.items()}


def of_paper():
    """The paper's own conditions, calibrated, as the page's Explorer offers them before the page has run any."""
    made = conditions(READINGS["calibrated"], LENGTHS["A"], 1, groups=["single", "layers"])
    single = {**{f"N{n}": made["single", n] for n in SINGLE}, "Brownian motion": made["brownian", 8]}
    return explorer_conditions(single, {**{f"N{n}": made["layer", n] for n in LAYERS}, "all maps": made["layers"]})


def _layers(several):
    return several["all maps"].agent.nodes[0].resolutions


def _as_in(figure, result, of_paper=True):
    """The figure of the paper that has a condition, or that it is modelled on."""
    paper = "Paper A" if of_paper and result.world.n_creeps == N_CREEPS else "After paper A"
    return f"{paper}, figure {figure}"


def levels(several):
    """The thesis's level by what N7 finally earns: {name: level}, empty but for the paper's maps and creeps."""
    if _layers(several) != LAYERS or several["N7"].world.n_creeps != N_CREEPS:
        return {}
    factor = STATEMENTS["A7"].bounds.number
    return {f"thesis: {factor} × N7": factor * several["N7"].rate(*FINAL).mean()}


def about_levels(several):
    """What a page says of the level that `draw_together` marks, if it does, in Markdown."""
    return ("\n\nThe thesis reports a ratio to N7 and no level: the dashed line of the figure at the top is where all "
            "maps would end at that multiple of what N7 finally earns here, and is low where N7 earns little."
            ) * bool(levels(several))


def draw_together(several):
    """Draw reward per second of each layer alone, of all together, and summed, with dashed lines at the `levels`."""
    *alone, (_, together) = several.items()
    total = {2: "sum of both", 3: "sum of the three"}.get(len(alone), "sum of all")
    sums = [*((name, [result]) for name, result in alone), (all_of(alone), [together]),
            (total, [result for _, result in alone])]
    axes = draw_sums(sums, [*looks(len(alone) + 1), (INK, "-")])
    if levels(several):
        mark_levels(axes, levels(several))
    return axes


def draw_elements(axes, nres_map, places, valences, values):
    """Draw elements of interest, with valences in free corners, and the action values."""
    fills = {goal: (GREEN if valence > 0 else RED, FILL * abs(valence))
             for goal, valence in zip(nres_map.encode(places), valences)}
    draw_cells(nres_map, fills=fills, ax=axes)
    draw_values(nres_map, values, ax=axes)
    cells, side = nres_map.encode(places), 1 / nres_map.resolution
    for cell, (east, south), valence in zip(cells, as_vectors(np.asarray(values), CARDINAL)[cells], valences):
        left, top = side * (cell % nres_map.resolution), side * (cell // nres_map.resolution)
        falling = east * south > 0  # an arrow that leaves the upper right corner free
        mark(axes, (left + side * (0.9 if falling else 0.1), top + 0.1 * side), f"{valence:+g}".replace("-", "−"),
             ha="center", va="center")
