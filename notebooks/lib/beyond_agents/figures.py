"""Figures of the page on the forager. A sample of rates is float64 (runs,)."""

import numpy as np

from neorl.drawing.curves import draw_curves
from neorl.drawing.style import CURVES, GREEN, INK, RED, SMALL, axes_or_new, name_ends
from neorl.evidence.statistics import estimate, mean_band


def draw_parts(way, without, ax=None):
    """Draw reward per second as parts are added in turn, and of the whole without each part: a row per part.

    way: {agent: rates}, from the bare agent to the whole. without: {part: rates}, in the order of the rows.
    """
    axes = axes_or_new(ax, figsize=(4.9, 4.2))
    added, left = ([estimate(np.mean, each) for each in rates.values()] for rates in (way, without))
    axes.errorbar([each.value for each in added], range(len(way)), xerr=_bars(added), fmt="o", color=CURVES[0],
                  label="parts added in turn")
    axes.errorbar([each.value for each in left], range(1, len(way)), xerr=_bars(left), fmt="D", color=CURVES[5],
                  label="the whole without it")
    axes.axvline(added[-1].value, color=INK, linewidth=0.7)
    axes.set_xlabel("reward per second, last third")
    return _rows(axes, way)


def draw_oracles(boards, ax=None):
    """Draw reward per second of foragers and planners: a row for each, a colour per board.

    boards: {creeps: {name: rates}}.
    """
    axes = axes_or_new(ax, figsize=(4.9, 3.6))
    for (colour, shape), (creeps, rates) in zip(((CURVES[0], "o"), (CURVES[5], "D")), boards.items()):
        found = [estimate(np.mean, each) for each in rates.values()]
        axes.errorbar([each.value for each in found], range(len(found)), xerr=_bars(found), fmt=shape, color=colour,
                      label=f"{creeps} creeps")
    axes.set_xlabel("reward per second")
    return _rows(axes, rates)


def _bars(estimates):
    """Lengths of the error bars of estimates: (2, rows)."""
    return np.array([[each.value - each.low, each.high - each.value] for each in estimates]).T


def _rows(axes, names):
    axes.set_yticks(range(len(names)), list(names))
    axes.invert_yaxis()
    axes.legend(frameon=False, fontsize=9, loc="lower left")
    return axes


def draw_fear(middles, fears):
    """Draw fear, (runs, bins), as a function of approach, with the line on which they are equal."""
    known = np.isfinite(fears).all(axis=0)
    axes = draw_curves(middles[known], {"fear by avoidance": fears[:, known]}, "approach", "fear")
    axes.plot([0, 1], [0, 1], color=INK, linewidth=0.7)
    axes.annotate("fear = approach", (0.3, 0.33), ha="center", va="bottom", rotation=45, rotation_mode="anchor",
                  transform_rotates_text=True, fontsize=SMALL)
    axes.set_xlim(0, 1)
    return axes


def draw_revalued(result):
    """Draw creeps met per second, by kind, with a line where red becomes worth as much as green."""
    minutes, rates = hits_per_second(result)
    axes, ends = axes_or_new(None), []
    for (kind, of_kind), colour in zip(rates.items(), (GREEN, RED)):
        axes.plot(minutes, of_kind.mean(axis=0), color=colour)
        axes.fill_between(minutes, *mean_band(of_kind), color=colour, alpha=0.2, linewidth=0)
        ends.append((of_kind[:, -1].mean(), kind, colour))
    axes.set(xlabel="simulated minutes", ylabel="creeps per second", xlim=(0, minutes[-1]), ylim=(0, None))
    name_ends(axes, ends)
    axes.axvline(result.seconds / 120, color=INK, linewidth=0.7)
    return axes


def hits_per_second(result, stretches=30):
    """Minutes, and the creeps of each kind met per second over the run: {"green": (runs, stretches), "red": …}."""
    bins = np.array_split(np.arange(result.hits.shape[1]), min(stretches, result.hits.shape[1]))
    seconds = np.array([result.edges[each[-1] + 1] - result.edges[each[0]] for each in bins])
    middles = np.array([(result.edges[each[-1] + 1] + result.edges[each[0]]) / 120 for each in bins])
    counts = np.array([result.hits[:, each].sum(axis=1) for each in bins])  # (stretches, runs, kinds)
    rates = counts / seconds[:, None, None]
    return middles, {kind: rates[:, :, number].T for number, kind in enumerate(result.world.kinds)}


def draw_adapting(rewards, seconds, parts=10):
    """Draw reward per second by simulated minutes, averaged over at most `parts` groups of segments.

    rewards: {way: float64 (runs, segments)}, per second. seconds: of a segment.
    """
    segments = next(iter(rewards.values())).shape[1]
    groups = np.array_split(np.arange(segments), min(parts, segments))
    minutes = [seconds * (group.mean() + 0.5) / 60 for group in groups]
    curves = {way: np.array([each[:, group].mean(axis=1) for group in groups]).T for way, each in rewards.items()}
    return draw_curves(minutes, curves, "simulated minutes", "reward per second")
