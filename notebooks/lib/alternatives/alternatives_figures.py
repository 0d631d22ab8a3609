"""The figure of the page on alternatives."""

from matplotlib import pyplot as plt

from lib.alternatives.contestants import BEYOND, CHANCE, DEEP, PHYSICS, TABLES, THESIS
from lib.alternatives.report import shown
from neorl.drawing.style import AGENT, CURVES, GREEN, INK, RED, TEXT, name_ends
from neorl.evidence.statistics import mean_band

DASHED = {TABLES: "-", DEEP: "--", THESIS: ":", BEYOND: "-", CHANCE: ":", PHYSICS: "-."}
COLOURS = {TABLES: CURVES[:4], DEEP: CURVES[4:], THESIS: CURVES[:2], BEYOND: (AGENT, GREEN, RED), CHANCE: (INK,),
           PHYSICS: (INK,) * 3}


def draw_learning(boards):
    """Draw the learning curves of the contestants, a panel for each board.

    boards: {creeps: {name: `Earned`}}. Curves are means over runs with their 95 % intervals. Contestants that are given
    the physics are level lines.
    """
    _, panels = plt.subplots(len(boards), 1, figsize=(5.6, 4.4 * len(boards)), sharex=True)
    for axes, (creeps, earned) in zip(panels, boards.items()):
        ends, colours = [], {kind: iter(of_kind) for kind, of_kind in COLOURS.items()}
        for name, each in shown(earned).items():
            colour = next(colours[each.kind])
            if each.kind == PHYSICS:
                level = each.rate(0, each.steps).mean()
                axes.axhline(level, color=colour, linestyle=DASHED[PHYSICS], linewidth=1)
                ends.append((level, name, colour))
                continue
            rates, at = each.rates, (each.edges[1:] + each.edges[:-1]) / 2_000
            axes.plot(at, rates.mean(axis=0), color=colour, linestyle=DASHED[each.kind],
                      linewidth=2.4 if each.kind == BEYOND else 1.5)
            if each.runs > 1:
                axes.fill_between(at, *mean_band(rates), color=colour, alpha=0.2, linewidth=0)
            ends.append((rates[:, -max(1, rates.shape[1] // 10):].mean(), name, colour))
        axes.set(ylabel="reward per second", xlim=(0, earned["Brownian motion"].steps / 1_000))
        axes.set_title(f"{creeps} creeps", color=TEXT, fontsize=11)
        name_ends(axes, ends, line=0.042, leaders=True)
    axes.set_xlabel("steps, in thousands")
