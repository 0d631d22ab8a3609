"""What the page on paper C needs beside its experiment: drawings, where desires land, and runs that stand still.

Results are {name: `Result`}, of networks "A" to "D", of the agents `NODES` that pass no desires, and of "Brownian"
motion, all on one board.
"""

import numpy as np
from matplotlib import pyplot as plt

from companion.page.wording import number, table
from companion.page.behind import add_recorded_levels, add_recorded_rates
from companion.page.thesis_figures import mark_levels
from neorl.drawing.boards import MARGIN, desire_colour
from neorl.drawing.curves import draw_sums
from neorl.drawing.network_figures import HEAD, LARGEST, draw_into, laid_out, write
from neorl.drawing.style import CURVES, INK, axes_or_new, looks, width_of_figures
from companion.thesis.reading import A_LITTLE, LENGTHS, NODES, READINGS, conditions
from companion.thesis.statements import STATEMENTS
from companion.thesis.verdict import FINAL
from neorl.experiments.run import Run
from neorl.statistics import estimate, ratio

STYLES = looks(4) + [(colour, "--") for colour in CURVES[4:]] + [(INK, ":")]  # networks, `NODES`, Brownian motion
DRASTIC = STATEMENTS["C4"].bounds.low  # times as much as C
LOOKS = 500  # samples of each run, in its second half
WELL_INSIDE = 0.2  # board widths from the middle
FAR = 0.1  # board widths from the agent
TRIED, PATIENCE, EVERY = 10, 5_000, 10  # runs, the steps of each, and the steps from look to look
TOUCHED = 0.05  # creeps per second: fewer are touched only where the agent stands and they come to it
ROW, SPREAD = 0.36, 0.6  # inches from agent to agent, and the share of them over which runs are spread
WATCHED = 5  # minutes of a run that stands still


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
    """Draw reward per second, and for the paper's own networks what D has to exceed."""
    axes = draw_sums([(name, [result]) for name, result in results.items()], STYLES, points=25)
    add_recorded_rates(axes, results, STYLES)
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


def still(result):
    """Which runs stand still at the end, so that they hardly touch a creep in their last fifth: bool (runs,)."""
    return result.hit_rate(*FINAL).sum(axis=1) < TOUCHED


def draw_runs(results):
    """Draw what each run finally earns, a row for each agent; a run that stands still is a ring."""
    axes = axes_or_new(None, figsize=(width_of_figures(), 1 + ROW * len(results)))
    for row, (result, (colour, _)) in enumerate(zip(results.values(), STYLES)):
        height = row + SPREAD * (0.5 - (0.5 + 0.618 * np.arange(result.runs)) % 1)  # neighbours lie apart
        axes.scatter(result.rate(*FINAL), height, s=24, edgecolors=colour,
                     facecolors=[("none" if stands else colour) for stands in still(result)])
    axes.axvline(0, color=INK, linewidth=0.7, zorder=1)
    axes.set(yticks=range(len(results)), yticklabels=results, xlabel="reward per second in the last fifth of a run")
    axes.invert_yaxis()
    add_recorded_levels(axes, range(len(results)), results)


def standing(results):
    """How many runs of each agent stand still at the end, and how many minutes pass without a touch, in Markdown."""
    rows = [[name, _of_runs(result), number(100 * np.mean(_touches_by_minute(result) == 0), 0)]
            for name, result in results.items()]
    return table(["Agent", f"Stand still: finally fewer than {TOUCHED} touches a second",
                  "Minutes without a touch, % of all"], rows)


def _of_runs(result):
    return f"{still(result).sum()} of {result.runs}"


def _touches_by_minute(result):
    edges = np.searchsorted(result.time, 60 * np.arange(max(1, int(result.time[-1] / 60))))
    return np.add.reduceat(result.hits.sum(axis=2, dtype=int), edges, axis=1)


def stillest(result):
    """The run that touches the fewest creeps in its last fifth, a `Run` at its end, and its number."""
    k = int(result.hit_rate(*FINAL).sum(axis=1).argmin())
    run = Run(result.agent, result.world, result.seed, k)
    run.advance(result.steps)
    return run, k


def path_as(run, agent):
    """The `Trajectory` of a copy of a run that goes on as another agent for some minutes."""
    run = run.copy()
    run.change(agent)
    return run.record(WATCHED * 60 * run.world.fps)


def paths(run, recorded):
    """What a run does in the `Trajectory` of each change to its agent, as a Markdown table."""
    rows = []
    for change, path in recorded.items():
        away = np.abs(path.positions - path.positions[0]).max(axis=1) / run.world.size
        rests = (np.diff(path.positions, axis=0) == 0).all(axis=1).mean()
        most = np.bincount(path.actions, minlength=len(run.world.actions.names))
        rows.append([change, f"{run.world.actions.names[most.argmax()]}, {number(100 * most.max() / most.sum(), 0)}",
                     number(100 * rests, 0), number(away.max()), path.hits.sum()])
    return table(["Change", "Commonest action, % of the time", "At rest, % of the time",
                  "Farthest from its place, in board widths", "Creeps touched"], rows)


def says(run):
    """What each node of a run says of the actions, and for how many goals its maps hold the same action best."""
    rows = []
    for node in run.agent.nodes:
        known = [run.q(m) for m, nres in enumerate(run.agent.maps) if nres.modality == node.modality]
        best = np.concatenate([q.argmax(axis=1)[np.ptp(q, axis=1) > 0] for q in known])
        counts = np.bincount(best, minlength=len(run.world.actions.names))
        same = f"{run.world.actions.names[counts.argmax()]}, {number(100 * counts.max() / max(1, counts.sum()), 0)}"
        rows.append([node.name, *(number(node.gain * value, 4) for value in run.output(node.name).q), same])
    return table(["Node", *run.world.actions.names, "The action that is best most often, % of all goals"], rows)


def explored(greedy, exploring):
    """What networks C, D and the agents without desires earn, greedy and exploring, as two Markdown tables."""
    sides = greedy, exploring
    rows = [[name, *(cell for side in sides for cell in (estimate(np.mean, side[name].rate(*FINAL)),
                                                         _of_runs(side[name])))] for name in exploring]
    every = [{name: side[name].rate(*FINAL) for name in exploring} for side in sides]
    moving = [{name: final[name][~still(side[name])] for name in "CD"} for final, side in zip(every, sides)]
    best = [max(NODES.values(), key=lambda name, final=final: final[name].mean()) for final in every]
    ratios = [["D / best without desires", *(f"{_over(final['D'], final[name])} ({name})"
                                             for final, name in zip(every, best))],
              ["D / C", *(_over(final["D"], final["C"]) for final in every)],
              ["D / C, of runs that do not stand still", *(_over(final["D"], final["C"]) for final in moving)]]
    return "\n\n".join([
        table(["Agent", "Reward per second, greedy", "Stand still", f"With ε {A_LITTLE}", "Stand still"], rows),
        table(["Final rewards", "Greedy", f"With ε {A_LITTLE}"], ratios)])


def _over(rewards, others):
    return estimate(ratio, rewards, others) if len(rewards) and len(others) else "no runs"


def explorer_conditions(results, of_paper):
    """The conditions that the page's Explorer offers: {name: `Condition` or `Result`}, as they were given."""
    paper = "Paper C" if of_paper else "After paper C"
    return {f"{paper}, {name if name in NODES.values() else f'figure 4e: network {name}'}": result
            for name, result in results.items()}


def of_paper():
    """The paper's own conditions, calibrated, as the page's Explorer offers them before the page has run any."""
    made = conditions(READINGS["calibrated"], LENGTHS["C"], 1, groups=["networks"])
    made |= {("network", alone): made["node", name] for name, alone in NODES.items()}
    return explorer_conditions({name: made["network", name] for name in (*"ABCD", *NODES.values())}, True)
