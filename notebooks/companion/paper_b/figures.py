"""The figures and tables of the page on paper B, and the conditions that its Explorer offers.

1. Agents of figure 5 are "PC", "OVC" and "PC + OVC", with all maps; those of figure 4, with one map each, are named by
   its resolution, "N7". Results are {name: `Result`}.
2. The thesis's numbers, and the names of its figures, go only with what the paper ran.
"""

from dataclasses import replace

from matplotlib.patches import Circle

from companion.paper_b.receptive_fields import draw_receptive_fields
from companion.paper_b.trials import values_for_objects
from companion.page.panels import FILL, add_arrow, mark
from companion.page.thesis_figures import draw_against_thesis
from companion.page.wording import in_words, table
from neorl.core.maps import NresMap
from neorl.core.modality import CARTESIAN_OBJECT_VECTOR_CELL, MODALITIES
from neorl.drawing.boards import as_board, draw_tank, new_boards
from neorl.drawing.style import AGENT, GREEN, INK
from neorl.drawing.value_maps import draw_cells, draw_values
from companion.thesis.measures import minutes_to_own_level
from companion.thesis.reading import LENGTHS, PRIMES, READINGS, conditions
from companion.thesis.statements import STATEMENTS

OBJECT = (0.8, -0.4)  # where the object is as seen from the self, in board widths
DISC = 0.09  # radius of either, larger than in the tank
CELLS = {"PC": "place", "OVC": "object-vector", "PC + OVC": "place + object-vector"}  # of the agents, in words
LABELS = {"PC": "place cells", "OVC": "object-vector\ncells", "PC + OVC": "both"}
B3, B4 = STATEMENTS["B3"], STATEMENTS["B4"]
PC = B3.also["place cells"].number  # per second, and of object-vector cells too: "no loss", section 3.1
THESIS_LEVELS = {"PC": PC, "OVC": PC, "PC + OVC": B3.bounds.number}
THESIS_MINUTES = {"PC + OVC": f"{B4.bounds.number:g}", "PC": f"> {B4.also['place cells'].number:g}"}
TUNINGS = {("component", "component"): "cartesian", ("margin", "margin"): "proximal",
           ("length", "direction"): "polar", ("direction",): "angle", ("length",): "length"}
FRAMES = {"position": "allocentric", "velocity": "allocentric direction"}


def draw_final_levels(levels, of_paper):
    """Draw final rewards per second, {agent: `Estimate`}, and the thesis's own beside those of the paper's agents."""
    return draw_against_thesis({LABELS[agent]: THESIS_LEVELS[agent] if of_paper else None for agent in levels},
                               {LABELS[agent]: level for agent, level in levels.items()}, "final reward per second")


def paces(paced, of_paper):
    """The minutes to the final level as a Markdown table. paced: {agent: `Result`} of long runs."""
    return table(["Agents", "Thesis", "Here"], [
        [CELLS[agent], THESIS_MINUTES[agent] if of_paper else "–",
         in_words(minutes_to_own_level(paced[agent]))] for agent in THESIS_MINUTES])


def modalities():
    """The modalities that the thesis names, as a Markdown table."""
    def row(modality):
        features = tuple(axis.feature for axis in modality.axes)
        frame = FRAMES.get(modality.follows, "centred on the agent, allocentric direction")
        return [modality.name, "–" if features == ("length",) else frame,
                f"{' × '.join(modality.names)} ({TUNINGS[features]})", f"{len(modality.axes)}-D"]

    return table(["Cell", "Reference frame", "Tuned to", "Map"], map(row, MODALITIES))


def draw_states():
    """Draw the state and the goal of an N5 of object vectors, with an example of a transition."""
    n5, (x, y) = NresMap(5, CARTESIAN_OBJECT_VECTOR_CELL), OBJECT
    centre, of_object = (int(cell) for cell in n5.encode([(0, 0), OBJECT]))
    side = 2 / n5.resolution
    readings = {"the self, also per object": ("state", "goal", (0, 0), (side / 2, 0)),
                "the object's cell": ("goal", "state", OBJECT, (x - side, y))}
    for axes, (title, (of_centre, of_cell, start, end)) in zip(new_boards(2, 1), readings.items()):
        draw_cells(n5, fills={centre: (AGENT, FILL), of_object: (GREEN, FILL)}, ax=as_board(axes, -1))
        for place, colour, name in (((0, 0), AGENT, of_centre), (OBJECT, GREEN, of_cell)):
            axes.add_patch(Circle(place, DISC, facecolor=colour, edgecolor="none"))
            mark(axes, (place[0], place[1] + 0.31), name, ha="center", va="center")
        add_arrow(axes, start, end, INK, 1.8)
        axes.set_title(title)


def draw_object_values(learned):
    """Draw where values for an object would take agents: {name: [`Run`, …]}."""
    maps = [each.resolution for each in next(iter(learned.values()))[0].agent.maps]
    drawn = dict.fromkeys((maps[len(maps) // 2], maps[-1]))
    boards = iter(new_boards(len(learned), len(drawn)))
    for n in drawn:
        for name, (run, *_) in learned.items():
            axes, m = as_board(next(boards), -1), maps.index(n)
            nres_map = NresMap(n, CARTESIAN_OBJECT_VECTOR_CELL)  # drawn as wide as the board, whatever its range
            draw_cells(nres_map, fills={int(nres_map.encode([0, 0])): (GREEN, FILL)}, width=0.6, ax=axes)
            draw_values(nres_map, values_for_objects(run, m), ax=axes)
            axes.set_title(f"{name}, N{n}")


def draw_modalities(world, state):
    """Draw the receptive fields of a map of each modality over a tank, those of its active cells filled."""
    for axes, modality in zip(new_boards(2, 4), MODALITIES):
        draw_receptive_fields(NresMap(7, modality), world, state, axes)
        draw_tank(world, state, axes)
        axes.set_title(modality.name)


def draw_points(per_reset, expected, of_paper):
    """Draw points per reset, {agent: `Estimate`}, with lines at the thesis's number and at what the rules imply."""
    lines = {f"by proof {expected:.3g}": expected}
    if of_paper:
        lines[f"thesis {STATEMENTS['B5'].bounds.number:g}"] = STATEMENTS["B5"].bounds.number
    draw_against_thesis(dict.fromkeys(per_reset), per_reset, "green creeps minus red ones, per reset", lines)


def explorer_conditions(results, place, objects, joined, of_paper):
    """The conditions that the page's Explorer offers: {name: `Condition` or `Result`}, as they were given."""
    paper = "Paper B" if of_paper else "After paper B"
    together = results["PC + OVC"]
    offered = {f"{paper}, figure 5: {CELLS['PC + OVC']} cells": together}
    for figure, agent, alone in (("4A", "PC", place), ("4B", "OVC", objects)):
        offered |= {f"{paper}, figure {figure}: {CELLS[agent]} cells, {n}": result
                    for n, result in ({"all": results[agent]} | alone).items()}
    return offered | {f"{paper}: object-vector cells join": joined}


def of_paper():
    """The paper's own conditions, calibrated, as the page's Explorer offers them before the page has run any."""
    made = conditions(READINGS["calibrated"], LENGTHS["B"], 1, groups=["modal", "resolutions"])
    agents = {"PC": made["place", "all"], "OVC": made["objects", "all"], "PC + OVC": made["both"]}
    place, objects = ({f"N{n}": made[kind, n] for n in PRIMES} for kind in ("place", "objects"))
    joined = replace(agents["PC"], changes=((agents["PC"].steps // 2, agents["PC + OVC"].agent),))
    return explorer_conditions(agents, place, objects, joined, True)
