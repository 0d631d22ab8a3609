"""The figures of the search: which choices matter, which claims agree together, and how the search went on."""

import numpy as np

from companion.thesis.priors import WITHIN
from companion.study.calibration_table import progress
from neorl.drawing.style import AGENT, INK, RED, SMALL, TEXT, axes_or_new, name_ends, width_of_figures

ROW = 0.25  # inches, of a choice


def draw_effects(effects):
    """Which choices matter, as areas of discs: {claim: {choice: total effect}}, see `sensitivity.total_effects`."""
    axes = axes_or_new(None, figsize=(width_of_figures(), ROW * len(WITHIN) + 0.5))
    for column, of_claim in enumerate(effects.values()):
        for row, choice in enumerate(WITHIN):
            size = 13 * np.sqrt(np.clip(of_claim.get(choice, 0.0), 0, 1))
            axes.plot(column, row, marker="o", color=AGENT, markersize=size)
    axes.set_xticks(range(len(effects)), effects, fontsize=SMALL, rotation=90)  # horizontal labels would touch
    axes.set_yticks(range(len(WITHIN)), [choice.label for choice in WITHIN.values()], fontsize=SMALL)
    axes.set(xlim=(-0.6, len(effects) - 0.4), ylim=(len(WITHIN) - 0.4, -0.6))
    axes.xaxis.tick_top()
    axes.tick_params(length=0)
    axes.grid(color=INK, alpha=0.2, linewidth=0.5)
    axes.set_axisbelow(True)
    axes.spines[:].set_visible(False)


def draw_together(together):
    """Which claims hold together: % of the rows with both measured in which both hold, on the diagonal each alone.

    Pairs that pull apart, see `Together.apart`, are crossed.
    """
    axes = axes_or_new(None, figsize=(width_of_figures(), width_of_figures()))
    share = np.divide(together.both, together.rows, out=np.zeros(together.both.shape), where=together.rows > 0)
    apart = {pair[:2] for pair in together.apart}
    for i, below in enumerate(together.claims):
        for j, beside in enumerate(together.claims[: i + 1]):
            crossed = (beside, below) in apart
            axes.text(j, i, f"{100 * share[i, j]:.0f}" + " ×" * crossed, ha="center", va="center", fontsize=SMALL,
                      color=RED if crossed else TEXT, weight="bold" if crossed or i == j else "normal")
            axes.barh(i + 0.36, share[i, j] * 0.84, 0.14, left=j - 0.42, color=AGENT)
    axes.set_xticks(range(len(share)), together.claims, fontsize=SMALL)
    axes.set_yticks(range(len(share)), together.claims, fontsize=SMALL)
    axes.set(xlim=(-0.5, len(share) - 0.5), ylim=(len(share) - 0.4, -0.5))
    axes.tick_params(length=0)
    axes.spines[:].set_visible(False)


def draw_distances(table):
    """The distance of readings to all targets, wave by wave: those with all groups measured, and the nearest so far."""
    axes = axes_or_new(None)
    complete = [row for row in table if row.complete]
    shift = np.random.default_rng(0).uniform(-0.3, 0.3, len(complete))  # so that points do not overlap
    axes.plot([row.wave for row in complete] + shift, [row.distance for row in complete], linestyle="none", marker="o",
              markersize=3, alpha=0.5, color=AGENT)
    nearest = {wave: least for wave, least in progress(table).items() if np.isfinite(least)}
    axes.step(list(nearest), list(nearest.values()), where="mid", color=RED)
    axes.set(xlabel="wave", ylabel="distance to all targets", ylim=(0, None))
    axes.xaxis.get_major_locator().set_params(integer=True)
    name_ends(axes, [(list(nearest.values())[-1], "nearest", RED)])
