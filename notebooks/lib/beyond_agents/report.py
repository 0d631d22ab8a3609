"""Sentences and tables of the page on the forager, in Markdown."""

import numpy as np

from lib.beyond_agents import oracles
from lib.beyond_agents.adapting import ADAPTABLE, ADAPTED, FIXED, SHAKEN
from lib.beyond_agents.adapting import last_third as late_reward
from lib.beyond_agents.control import ALONE, FORAGER, NETWORKS, SETTINGS
from lib.beyond_agents.experiments import BARE, PARTS, TARGETS, THESIS, last_third, reached
from lib.beyond_agents.search import RANGES, read_record, score_of
from lib.shared.wording import listed, number, table
from neorl.evidence.statistics import difference, estimate

UNITS = {"horizon": " s", "familiarity": " visits"}  # of the numbers that were searched


def interval(each):
    """An `Estimate` as text."""
    return f"{number(each.value)} ({number(each.low)} to {number(each.high)})"


def mean_of(rates):
    """The `Estimate` of a mean over runs."""
    return estimate(np.mean, rates)


def summary(lived):
    """The page's result in a paragraph."""
    found = {name: mean_of(rates) for name, rates in reached(lived).items()}
    met = [name for name, each in found.items() if each.value >= TARGETS[name][3]]
    missed = [f"“{name}” ({number(found[name].value)} of {TARGETS[name][3]})" for name in TARGETS if name not in met]
    thesis, ours = (mean_of(last_third(each)) for each in (lived.thesis[THESIS], lived.way[f"+ {PARTS[-1]}"]))
    parts = {part: mean_of(last_third(result)).value for part, result in lived.without.items()}
    most = sorted(parts, key=parts.get)[:3]
    return (f"With three creeps, the agent of this page, the *forager*, earns {interval(ours)} reward per second over "
            f"the last third of the runs, while it learns; the thesis's agent of place and object-vector cells earns "
            f"{interval(thesis)} in the calibrated reading. The forager meets {len(met)} of the {len(TARGETS)} targets"
            + (f" and misses {listed(missed)}" if missed else "") + ". Its reward falls most without "
            f"{listed(f'“{part}” (to {number(parts[part])})' for part in most)}. It has no neural network, no replay "
            "and no model, and learns in a single pass through its experience; revalued elements need no retraining.")


def target_table(lived):
    """The targets, and the rewards reached on runs that took no part in the search."""
    return table(["target, reward per second while learning", "at least", "reached (95 % interval)", "met"],
                 [[name, TARGETS[name][3], interval(each), "●" if each.low >= TARGETS[name][3] else
                   "◐" if each.value >= TARGETS[name][3] else "○"]
                  for name, each in ((name, mean_of(rates)) for name, rates in reached(lived).items())])


def part_table(lived):
    """The gain from each part as it is added, and the change of the whole without it."""
    rows, before = [], lived.way[BARE]
    whole = lived.way[f"+ {PARTS[-1]}"]
    for part in PARTS:
        after = lived.way[f"+ {part}"]
        gained = estimate(difference, last_third(after), last_third(before))
        lost = estimate(difference, last_third(lived.without[part]), last_third(whole))
        rows.append([part, interval(gained), interval(lost)])
        before = after
    return table(["part", "gain in reward per second when added in turn", "change of the whole without it"], rows)


def search_in_words():
    """The size of the search, and its outcome."""
    tried = read_record()
    best = tried[0]
    spread = [score_of(row) for row in tried]
    low, half, high = (number(float(each)) for each in np.quantile(spread, [0, 0.5, 1]))
    earned = [number(best[name]) for name in ("with_3", "with_8", "late")]
    return (f"{len(tried)} settings of {len(RANGES)} numbers and the resolutions were tried by differential "
            "evolution. A setting's score is the sum of three rewards per second: with 3 creeps, half of that with 8, "
            f"and with 3 around step 600,000. The scores lie between {low} and {high}, half of them above {half}. The "
            f"best has the resolutions {listed(map(str, best['resolutions']))} and, in the terms of "
            f"`neorl.Contacts`, {_named(best)}. It earned "
            f"{earned[0]} per second with 3 creeps, {earned[1]} with 8 and {earned[2]} around step 600,000, on the "
            "runs by which it was chosen.")


def _named(setting):
    return ", ".join(f"{name.replace('_', ' ')} {setting[name]:g}{UNITS.get(name, '')}" for name in RANGES)


def revalued_in_words(lived):
    """The creeps met before and after red becomes worth as much as green."""
    bins = lived.revalued.hits.shape[1]
    seconds = lived.revalued.seconds / 2
    before, after = (lived.revalued.hits[:, part].sum(axis=1) / seconds
                     for part in (slice(0, bins // 2), slice(bins // 2, bins)))
    return (f"Before half-time the agents meet {number(before[:, 0].mean())} green and "
            f"{number(before[:, 1].mean())} red creeps per second; from then on, with no value relearned, "
            f"{number(after[:, 0].mean())} green and {number(after[:, 1].mean())} red ones.")


def mean_fear(fears):
    """The mean of fears (runs, bins) over runs: (bins,), NaN where no run has a value."""
    known = np.isfinite(fears)
    total = np.where(known, fears, 0.0).sum(axis=0)
    return np.where(known.any(axis=0), total / np.maximum(known.sum(axis=0), 1), np.nan)


def fear_in_words(middles, fears):
    """Fear as a function of approach."""
    mean = mean_fear(fears)
    half, high = mean[np.abs(middles - 0.5).argmin()], np.nanmax(mean)
    linear = high * 0.5 / middles[np.nanargmax(mean)]
    return (f"Where approach is worth half a contact, fear is {number(float(half))}. A fear that grew in proportion to "
            f"approach, up to the same maximum of {number(float(high))}, would be {number(float(linear))} there.")


def cost_in_words(cost):
    """The cost of the forager in time and memory."""
    return (f"A step of world and agent takes {number(cost.microseconds, 1)} µs on one core of this machine. The agent "
            f"holds {cost.held:,.0f} KiB of values, of which it has used {cost.used:,.0f} KiB.")


def gaps_in_words(boards):
    """The gap between forager and planner, and its parts. boards: as `figures.draw_oracles` takes it."""
    parts = []
    for creeps, rates in boards.items():
        of_forager, of_planner = (mean_of(rates[name]) for name in (oracles.FORAGER, oracles.ALL))
        gaps = sorted(oracles.shares(rates).items(), key=lambda item: -item[1])
        (first, most), *others = ((name, f"{number(100 * share, 0)}\u00a0%") for name, share in gaps)
        parts.append(f"With {creeps} creeps the forager earns {interval(of_forager)} per second and the planner "
                     f"{interval(of_planner)}. Perfect {first} would close {most} of the gap between them, "
                     + listed([f"{name} {share}" for name, share in others]) + ".")
    return " ".join(parts)


def gap_table(boards):
    """Gain from each kind of perfect knowledge, in reward per second: a row for each, a column per board."""
    gaps = {creeps: oracles.gaps(rates) for creeps, rates in boards.items()}
    return table(["gain in reward per second from perfect", *(f"{creeps} creeps (95 % interval)" for creeps in boards)],
                 [[name, *(interval(mean_of(each[name])) for each in gaps.values())]
                  for name in next(iter(gaps.values()))])


def networks_in_words(results):
    """Rewards of the networks down to control, of the object vectors alone and of the forager."""
    earned = {name: mean_of(last_third(result)) for name, result in results.items()}
    return ("Reward per second over the last third: "
            + listed([f"{name} {interval(earned[name])}" for name in (*NETWORKS, ALONE, FORAGER)])
            + f". {SETTINGS} settings were tried for each network.")


def adapting_in_words(lives):
    """The gain from adapting. lives: as `lib.beyond_agents.adapting.lives` returns them."""
    parts = []
    for name, of_ways in lives.items():
        rates = {way: late_reward(rewards) for way, (_, rewards) in of_ways.items()}
        brought = estimate(difference, rates[ADAPTED], rates[SHAKEN])
        doubt = ", which may be zero" if brought.low <= 0 <= brought.high else ""
        ends = zip(ADAPTABLE[name].names, ADAPTABLE[name].start, of_ways[ADAPTED][0][:, -1].mean(axis=0))
        last = listed([f"{each} goes from {number(first)} to {number(float(end))}" for each, first, end in ends])
        fixed, shaken, adapted = (number(float(rates[way].mean())) for way in (FIXED, SHAKEN, ADAPTED))
        parts.append(f"**{name[0].upper()}{name[1:]}**: {fixed} reward per second over the last third with fixed "
                     f"parameters, {shaken} when they are merely shaken, {adapted} when they adapt. Beyond shaking, "
                     "adapting adds "
                     f"{interval(brought)}{doubt}. On average, {last}.")
    return "\n\n".join(parts)
