"""Figures of the page on the forager."""

import numpy as np

from lib.beyond_agents.adapting import SEGMENT
from lib.beyond_agents.experiments import PARTS, THESIS, hits_per_second, last_third
from neorl.drawing.curves import draw_curves, draw_proficiency
from neorl.drawing.style import CURVES, GREEN, INK, RED, SMALL, axes_or_new, name_ends
from neorl.evidence.statistics import estimate, mean_band


def draw_learning(lived):
    """Reward per second while learning: the forager beside the thesis's agent and the bare one."""
    return draw_proficiency({"forager": lived.way[f"+ {PARTS[-1]}"], "contacts alone": next(iter(lived.way.values())),
                             THESIS: lived.thesis[THESIS]})


def draw_long(lived):
    """Reward per second of the forager over the long runs, by the number of creeps."""
    return draw_proficiency({f"{creeps} creeps": result for creeps, result in lived.long.items()})


def draw_parts(lived, ax=None):
    """Reward per second over the last third, as parts are added in turn and without each part: a row per part."""
    axes = axes_or_new(ax, figsize=(4.9, 4.2))
    rows = np.arange(len(lived.way))
    way = [estimate(np.mean, last_third(each)) for each in lived.way.values()]
    axes.errorbar([each.value for each in way], rows, xerr=_bars(way), fmt="o", color=CURVES[0],
                  label="parts added in turn")
    without = [estimate(np.mean, last_third(lived.without[part])) for part in PARTS]
    axes.errorbar([each.value for each in without], rows[1:], xerr=_bars(without), fmt="D", color=CURVES[5],
                  label="the whole without it")
    axes.axvline(way[-1].value, color=INK, linewidth=0.7)
    axes.set_yticks(rows, list(lived.way))
    axes.invert_yaxis()
    axes.set_xlabel("reward per second, last third")
    axes.legend(frameon=False, fontsize=9, loc="lower left")
    return axes


def _bars(estimates):
    """Lengths of the error bars of estimates: (2, rows)."""
    return np.array([[each.value - each.low, each.high - each.value] for each in estimates]).T


def draw_fear(middles, fears):
    """Fear as a function of approach, with the line on which they are equal."""
    known = np.isfinite(fears).all(axis=0)
    axes = draw_curves(middles[known], {"fear by avoidance": fears[:, known]}, "approach", "fear")
    axes.plot([0, 1], [0, 1], color=INK, linewidth=0.7)
    axes.annotate("fear = approach", (0.3, 0.33), ha="center", va="bottom", rotation=45, rotation_mode="anchor",
                  transform_rotates_text=True, fontsize=SMALL)
    axes.set_xlim(0, 1)
    return axes


def draw_revalued(lived):
    """Creeps met per second, by kind, with a line where red becomes worth as much as green."""
    minutes, rates = hits_per_second(lived.revalued)
    axes, ends = axes_or_new(None), []
    for (kind, of_kind), colour in zip(rates.items(), (GREEN, RED)):
        axes.plot(minutes, of_kind.mean(axis=0), color=colour)
        axes.fill_between(minutes, *mean_band(of_kind), color=colour, alpha=0.2, linewidth=0)
        ends.append((of_kind[:, -1].mean(), kind, colour))
    axes.set(xlabel="simulated minutes", ylabel="creeps per second", xlim=(0, minutes[-1]), ylim=(0, None))
    name_ends(axes, ends)
    axes.axvline(lived.revalued.seconds / 120, color=INK, linewidth=0.7)
    return axes


def draw_oracles(boards, ax=None):
    """Reward per second of foragers and planners, means and 95 % intervals: a row for each, a colour per board.

    boards: as `lib.beyond_agents.oracles.rates_by_creeps` returns them.
    """
    axes = axes_or_new(ax, figsize=(4.9, 3.6))
    for colour, (creeps, rates) in zip((CURVES[0], CURVES[5]), boards.items()):
        found = [estimate(np.mean, each) for each in rates.values()]
        axes.errorbar([each.value for each in found], range(len(found)), xerr=_bars(found), fmt="o" if creeps == 3 else
                      "D", color=colour, label=f"{creeps} creeps")
    axes.set_yticks(range(len(rates)), list(rates))
    axes.invert_yaxis()
    axes.set_xlabel("reward per second")
    axes.legend(frameon=False, fontsize=9, loc="lower left")
    return axes


def draw_adapting(of_ways, parts=10):
    """Reward per second by simulated minutes, with fixed, shaken and adapted parameters.

    of_ways: what `lib.beyond_agents.adapting.lives` returns for one agent, whose segments are averaged in
        at most `parts` groups.
    """
    segments = next(iter(of_ways.values()))[1].shape[1]
    groups = np.array_split(np.arange(segments), min(parts, segments))
    minutes = [SEGMENT * (group.mean() + 0.5) / 3_000 for group in groups]
    curves = {way: np.array([rewards[:, group].mean(axis=1) for group in groups]).T
              for way, (_, rewards) in of_ways.items()}
    return draw_curves(minutes, curves, "simulated minutes", "reward per second")
