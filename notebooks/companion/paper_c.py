"""What the page on paper C needs beside its experiment: drawings, and where desires land.

Results are {name: `Result`}, of networks "A" to "D" and of "Brownian" motion on the same board.
"""

import numpy as np
from matplotlib import pyplot as plt

from companion.page.wording import table
from companion.page.thesis_figures import mark_levels
from neorl.drawing.boards import MARGIN, desire_colour
from neorl.drawing.curves import draw_proficiency
from neorl.drawing.network_figures import HEAD, LARGEST, draw_into, laid_out, write
from neorl.drawing.style import width_of_figures
from companion.thesis.reading import LENGTHS, READINGS, conditions
from companion.thesis.statements import STATEMENTS
from companion.thesis.verdict import FINAL
from neorl.experiments.run import Run

DRASTIC = STATEMENTS["C4"].bounds.low  # times as much as C
LOOKS = 500  # samples of each run, in its second half
WELL_INSIDE = 0.2  # board widths from the middle
FAR = 0.1  # board widths from the agent
TRIED, PATIENCE, EVERY = 10, 5_000, 10  # runs, the steps of each, and the steps from look to look


def draw_networks(agents):
    """Draw networks one below the other in a new figure, all in letters of the same size. agents: {name: `Agent`}."""
    drawings, inches, head = [laid_out(agent) for agent in agents.values()], width_of_figures(), 2.0
    width = max(drawing.width for drawing in drawings)
    heights = [head + HEAD + drawing.height for drawing in drawings]
    em = min(LARGEST, 72 * inches / (width + 1))
    whole = plt.figure(figsize=(inches, em * sum(heights) / 72), layout="none")
    for i, (name, drawing) in enumerate(zip(agents, drawings)):
        axes = whole.add_axes((0, sum(heights[i + 1 :]) / sum(heights), 1, heights[i] / sum(heights)))
        write(axes, em, 0, -1.1, name, ha="left", weight="bold")
        draw_into(axes, em, drawing, 72 * inches / em, heights[i], head)


def draw_rates(results, of_paper):
    """Draw reward per second of networks, and for the paper's own what D has to exceed."""
    axes = draw_proficiency(results)
    if of_paper:
        level = max(0.0, DRASTIC * results["C"].rate(*FINAL).mean())
        mark_levels(axes, {f"C4: D beyond {DRASTIC} × C": level})


def draw_desires(run, axes):
    """Draw desires between nodes as arrows to the squares of their elements of interest."""
    start = run.world_state.scene.position / run.world.size
    for desire, landing in zip(run.agent.desires, run.state.desires.target_at):
        if run.agent.comes_from_node(desire):
            colour = desire_colour(desire)
            low, high = (np.array([[-MARGIN], [1 + MARGIN]]) - start)[:, landing != 0] / landing[landing != 0]
            shown = min(1.0, np.maximum(low, high).min(initial=1.0))
            axes.annotate("", start + shown * landing, start, annotation_clip=False, arrowprops={
                "arrowstyle": "->", "color": colour, "linestyle": "--", "linewidth": 1.6, "shrinkA": 8, "shrinkB": 3})
            if shown == 1:
                axes.plot(*(start + landing), marker="s", markersize=7, color=colour, clip_on=False)


def moment_of_desire(network, world, steps, seed=0):
    """A `Run` when the agent is well inside the board and a node's desire lands far from it, if such a moment comes."""
    for k in range(TRIED):
        run = Run(network, world, seed, k)
        run.advance(steps)
        while run.step < steps + PATIENCE:
            off_centre = np.abs(run.world_state.scene.position / world.size - 0.5).max()
            if off_centre < WELL_INSIDE and np.hypot(*_landed(run).T).max(initial=0.0) > FAR:
                return run
            run.advance(EVERY)
    return run


def _landed(run):
    """Where desires that one node has of another land, from the agent, in board widths: float64 (desires, 2)."""
    passed = [run.agent.comes_from_node(desire) and desire.source != desire.target for desire in run.agent.desires]
    return run.state.desires.target_at[passed]


def landings(run):
    """Where the desires between the nodes of a run's agent land, and their valences, as a Markdown table."""
    rows = [[f"{desire.source} to {desire.target}, {' and '.join(desire.of)} creeps",
             f"({east:z.3f}, {south:z.3f})".replace("-", "−"), f"{valence:+g}".replace("-", "−")]
            for desire, (east, south), valence in zip(run.agent.desires, run.state.desires.target_at,
                                                      run.state.desires.target_valence)
            if run.agent.comes_from_node(desire)]
    return table(["Desire", "Lands at, from the agent, in board widths", "Valence"], rows)


def distances(condition, runs):
    """How far from the agent desires between nodes land in the second half of runs, and how often within which range.

    Returns the median of the farthest desire, in board widths, and the shares of moments at which all are in the cell
    of distance 0 of the finest map, and at which all are beyond the range of the maps: float64 (3, runs).
    """
    return np.array([_distances(Run(condition.agent, condition.world, condition.seed, k), condition.steps)
                     for k in range(runs)]).T


def _distances(run, steps):
    finest, landed = run.agent.nodes[-1].maps[-1], []
    run.advance(steps // 2)
    for _ in range(LOOKS):
        run.advance(max(1, steps // 2 // LOOKS))
        landed.append(_landed(run))
    at_agent = finest.encode(landed) == finest.encode([0.0, 0.0])
    beyond = np.abs(landed).max(axis=-1) > finest.modality.axes[0].high
    return (np.median(np.hypot(*np.moveaxis(landed, -1, 0)).max(axis=1)), at_agent.all(axis=1).mean(),
            beyond.all(axis=1).mean())


def explorer_conditions(results, of_paper):
    """The conditions that the page's Explorer offers: {name: `Condition` or `Result`}, as they were given."""
    paper = "Paper C" if of_paper else "After paper C"
    return {f"{paper}, figure 4e: network {name}": result for name, result in results.items()}


def of_paper():
    """The paper's own conditions, calibrated, as the page's Explorer offers them before the page has run any."""
    made = conditions(READINGS["calibrated"], LENGTHS["C"], 1, groups=["networks"])
    return explorer_conditions({name: made["network", name] for name in "ABCD"}, True)
