"""The rules by which the numbers here decide the claims of the thesis, written down before the numbers.

A verdict is *reproduced*, *partly* or *not reproduced*, by a rule that stands in the code below and is the same for
every reading of the thesis. A claim that compares agents is *not testable* where they have learned nothing to compare,
and with fewer than 10 runs a condition a page gives no verdict at all. A claim that is not reproduced is *open* while
its intervals leave room for it, so that more runs might. Rewards are per simulated second and means over runs; early
is the first tenth of a run, final the last fifth. `neorl.statements` holds what is claimed.
"""

from dataclasses import dataclass

import numpy as np
from scipy import stats

from neorl.statements import STATEMENTS
from neorl.statistics import Estimate, difference, estimate, probability_of_improvement, time_to_final_level

RUNS_FOR_A_VERDICT = 10
EARLY, FINAL = (0.0, 0.1), (0.8, 1.0)
VERDICTS = ("reproduced", "partly", "not reproduced", "not testable", "no verdict")


@dataclass(frozen=True)
class Claim:
    """What was found about one claim of `STATEMENTS`: our number with its interval, and what the rule makes of it."""

    name: str
    here: Estimate
    detail: str
    runs: int
    outcome: str  # one of VERDICTS but the last, whatever the number of runs
    open: bool

    @property
    def statement(self):
        """What is claimed, a `Statement`."""
        return STATEMENTS[self.name]

    @property
    def verdict(self):
        """The outcome, if there are runs enough for a verdict."""
        return self.outcome if self.runs >= RUNS_FOR_A_VERDICT else "no verdict"


def judge_single_layer(by_resolution, brownian):
    """Claims A1–A5 of paper A, from its figure 6.

    by_resolution: {N: `Result`} for N 10, 30, 50, 70, 90. brownian: the `Result` of the control.
    """
    runs = min(result.runs for result in [*by_resolution.values(), brownian])
    rate = {n: result.rate() for n, result in by_resolution.items()}
    mean = {n: values.mean() for n, values in rate.items()}
    best = max(mean, key=mean.get)

    control = estimate(np.mean, brownian.rate())
    a1 = _judged("A1", control, f"The best agent, N{best}, makes {mean[best]:.2f}.", runs,
                 reproduced=control.low <= 0 <= control.high,
                 partly=max(-control.low, control.high) < 0.1 * mean[best], possible=False)

    lead = {n: estimate(difference, values, brownian.rate()) for n, values in rate.items()}
    learned = any(each.low > 0 for each in lead.values())
    least = min(lead, key=lambda n: lead[n].low)
    chance = probability_of_improvement(rate[least], brownian.rate())
    a2 = _judged("A2", lead[least], f"It is that of N{least}, whose runs beat one of the control with probability "
                 f"{chance}.", runs, reproduced=lead[least].low > 0, partly=learned,
                 possible=all(each.high > 0 for each in lead.values()))

    early = estimate(_rank_correlation, *(by_resolution[n].rate(*EARLY) for n in sorted(by_resolution)))
    final = estimate(_rank_correlation, *(by_resolution[n].rate(*FINAL) for n in sorted(by_resolution)))
    a3 = _judged("A3", final, f"Early it is {early}.", runs, reproduced=early.high < 0 < final.low,
                 partly=early.high < 0 or final.low > 0, possible=early.low < 0 < final.high, testable=learned)

    others = [values for n, values in rate.items() if n != 50]
    ahead = estimate(_lead_over_best, rate[50], *others)
    a4 = _judged("A4", ahead, f"N{best} accumulates most.", runs, reproduced=ahead.low > 0, partly=ahead.high > 0,
                 possible=ahead.high > 0, testable=learned)

    ratio = estimate(_ratio, rate[70], rate[10])
    overlapping = ratio.high >= 0.5 and ratio.low <= 2
    a5 = _judged("A5", ratio, "Comparable is read as between a half and two.", runs,
                 reproduced=0.5 <= ratio.low and ratio.high <= 2, partly=overlapping, possible=overlapping,
                 testable=learned)
    return [a1, a2, a3, a4, a5]


def judge_multiple_layers(by_resolution, together):
    """Claims A6 and A7 of paper A, from its figure 7.

    by_resolution: {N: `Result`} for N 3, 7, 23. together: the `Result` of the agent with all three maps.
    """
    runs = min(result.runs for result in [*by_resolution.values(), together])
    final = {n: result.rate(*FINAL) for n, result in by_resolution.items()}
    best = max(final, key=lambda n: final[n].mean())
    learned = {n: estimate(np.mean, values).low > 0 for n, values in final.items()}

    surplus = estimate(_lead_over_sum, together.rate(*FINAL), *final.values())
    lead = estimate(difference, together.rate(*FINAL), final[best])
    chance = probability_of_improvement(together.rate(*FINAL), final[best])
    a6 = _judged("A6", surplus, f"Over the best alone, N{best}, the lead is {lead}; the probability of improvement "
                 f"{chance}.", runs, reproduced=surplus.low > 0, partly=lead.low > 0, possible=surplus.high > 0,
                 testable=learned[best])

    ratio = estimate(_ratio, together.rate(*FINAL), final[7])
    early = estimate(difference, together.rate(*EARLY), by_resolution[7].rate(*EARLY))
    as_said = ratio.high >= 3.5 and early.high >= 0
    a7 = _judged("A7", ratio, f"Early the lead over N7 is {early}.", runs, reproduced=1 < ratio.low and as_said,
                 partly=ratio.low > 1, possible=as_said, testable=learned[7])
    return [a6, a7]


def judge_modalities(place, objects, both):
    """Claims B1–B3 of paper B, from its figures 4 and 5.

    place, objects: {N: `Result`} for single resolutions, and {"all": `Result`} for all of them together, of agents of
    place cells and of object-vector cells. both: the `Result` of the agent with all maps of both.
    """
    runs = min(result.runs for result in [*place.values(), *objects.values(), both])
    pc, ovc, joint = (result.rate(*FINAL) for result in (place["all"], objects["all"], both))
    learned = _all_learned(pc, ovc, joint)

    ratio = estimate(_ratio, ovc, pc)
    early = estimate(difference, objects["all"].rate(*EARLY), place["all"].rate(*EARLY))
    overlapping = ratio.high >= 0.5 and ratio.low <= 2
    b1 = _judged("B1", ratio, "Comparable is read as between a half and two, with no loss early, where the lead is "
                 f"{early}.", runs, reproduced=0.5 <= ratio.low and ratio.high <= 2 and early.high >= 0,
                 partly=overlapping, possible=overlapping and early.high >= 0, testable=learned)

    leads, best = {}, {}
    for name, results in (("place cells", place), ("object-vector cells", objects)):
        final = {n: result.rate(*FINAL) for n, result in results.items() if n != "all"}
        best[name] = max(final, key=lambda n: final[n].mean())
        leads[name] = estimate(_lead_over_best, results["all"].rate(*FINAL), *final.values())
    least = min(leads, key=lambda name: leads[name].value)
    b2 = _judged("B2", leads[least], "It is " + "; ".join(f"{lead} with {name}, over N{best[name]}"
                                                          for name, lead in leads.items()) + ".", runs,
                 reproduced=all(lead.low > 0 for lead in leads.values()),
                 partly=any(lead.low > 0 for lead in leads.values()),
                 possible=all(lead.high > 0 for lead in leads.values()), testable=learned)

    gain = estimate(_ratio, joint, pc)
    lead = estimate(_lead_over_best, joint, pc, ovc)
    b3 = _judged("B3", gain, f"Both make {joint.mean():.2f}, place cells {pc.mean():.2f}, object-vector cells "
                 f"{ovc.mean():.2f}. The lead over the better one is {lead}; a run of both beats one of place cells "
                 f"with probability {probability_of_improvement(joint, pc)}.", runs,
                 reproduced=gain.high >= 0.55 / 0.29 and lead.low > 0, partly=gain.low > 1,
                 possible=gain.high >= 0.55 / 0.29 and lead.high > 0, testable=learned)
    return [b1, b2, b3]


def judge_pace(place, both):
    """Claim B4 of paper B, from `Result`s of agents with all maps of place cells, and with all of both modalities."""
    runs = min(place.runs, both.runs)
    learned = _all_learned(place.rate(*FINAL), both.rate(*FINAL))
    quick, slow = (time_to_final_level(result) / 60 for result in (both, place))
    ahead = estimate(difference, quick, slow)
    quick, slow = (estimate(np.mean, minutes) for minutes in (quick, slow))
    return _judged("B4", quick, f"Place cells take {slow}; the difference is {ahead}. The rule allows twice the "
                   "thesis's time for both, and half of it for place cells.", runs,
                   reproduced=quick.high <= 30 and slow.low >= 80, partly=ahead.high < 0,
                   possible=quick.low <= 30 and slow.high >= 80, testable=learned and both.seconds >= 60 * 160)


def judge_networks(a, b, c, d):
    """Claims C1–C4 of paper C, from its figure 4e and the `Result`s of its four agents."""
    runs = min(result.runs for result in (a, b, c, d))
    final = {name: result.rate(*FINAL) for name, result in zip("ABCD", (a, b, c, d))}
    learned = {name: estimate(np.mean, values).low > 0 for name, values in final.items()}

    rise = estimate(np.mean, final["A"] - a.rate(*EARLY))
    level = estimate(np.mean, final["A"])
    weak = 0.5 * final["C"].mean()
    c1 = _judged("C1", rise, f"Finally it makes {level}. Weak is read as less than half of what network C makes, "
                 f"{final['C'].mean():.2f}.", runs, reproduced=rise.low > 0 and level.high < weak,
                 partly=rise.low > 0 or level.high < weak, possible=rise.high > 0 and level.low < weak,
                 testable=learned["C"])
    leads = []
    for name, better, worse in (("C2", "B", "A"), ("C3", "C", "B")):
        lead = estimate(difference, final[better], final[worse])
        chance = probability_of_improvement(final[better], final[worse])
        leads.append(_judged(name, lead, f"A run of {better} beats one of {worse} with probability {chance}.", runs,
                             reproduced=lead.low > 0, partly=lead.high > 0, possible=lead.high > 0,
                             testable=learned[better]))
    gain = estimate(_ratio, final["D"], final["C"])
    c4 = _judged("C4", gain, "Drastically is read as by half or more. A run of D beats one of C with probability "
                 f"{probability_of_improvement(final['D'], final['C'])}.", runs, reproduced=gain.low >= 1.5,
                 partly=gain.low > 1, possible=gain.high >= 1.5, testable=learned["C"])
    return [c1, *leads, c4]


def judge_revaluing(revalued, throughout):
    """Claim T1, from `Result`s of agents that want red creeps too, from half-time on and from the start."""
    runs = min(revalued.runs, throughout.runs)
    turned, always = (_red_a_minute(result, 0.5, 0.525) for result in (revalued, throughout))
    before, after = (estimate(np.mean, _red_a_minute(revalued, *share)) for share in ((0.475, 0.5), (0.5, 0.525)))
    lead = estimate(difference, turned, always)
    return _judged("T1", lead, f"Before the turn it is {before}, after it {after}.", runs,
                   reproduced=lead.low >= 0 and after.low > before.high, partly=after.low > before.high,
                   possible=lead.high >= 0 and after.high > before.low)


def judge_cost(together, alone, none):
    """Claim T2: what an agent's maps cost together and each alone; each (repetitions,), in the same unit a step.

    together: with all maps. alone: a sequence, with each map alone. none: without any.
    """
    ratio = estimate(_cost_ratio, together, none, *alone)
    return _judged("T2", ratio, "The rule allows a tenth more.", len(together), reproduced=ratio.high <= 1.1,
                   partly=ratio.low <= 1.1, possible=ratio.low <= 1.1)


def judge_real_time(load, delay):
    """Claim T5: the load of each window of a run in real time, in cores, and when each step was done.

    load: (windows,). delay: (windows, steps), the time from when a step was due until it was done, in steps.
    """
    share, latest = estimate(np.mean, load), delay.max()
    return _judged("T5", share, f"Of {delay.size} steps, {(delay > 1).sum()} were not done when the next one was due; "
                   f"the latest was done {latest:.2f} steps after it was due. The rule allows 2.", len(load),
                   reproduced=share.high < 1 and latest <= 2, partly=share.high < 1, possible=share.low < 1)


def judge_latent_learning(agent, rivals, first_reward=11):
    """Claim H1, from what {group: record} of animals did, each record with ``errors`` (animals, days).

    agent: of neoRL, for the groups "throughout", "never" and "delayed", which is rewarded from day ``first_reward`` on.
    rivals: {name: the same} of others, which are told of and not judged.
    """
    runs = min(len(record.errors) for record in agent.values())
    after, next_day = slice(first_reward, None), slice(first_reward, first_reward + 1)
    lead = _more_errors(agent, "delayed", "throughout", after)
    at_once = _more_errors(agent, "delayed", "throughout", next_day)
    worth = _more_errors(agent, "never", "throughout", after)
    others = "; ".join(f"{name} {_more_errors(groups, 'delayed', 'throughout', after)}"
                       for name, groups in rivals.items())
    return _judged("H1", lead, f"On the day after the first reward it is {at_once}. Level is read as within a tenth of "
                   f"what reward makes of a difference, {worth.value:.2f}. With other learners it is: {others}.", runs,
                   reproduced=lead.high < 0, partly=max(lead.high, at_once.high) <= 0.1 * worth.value,
                   possible=lead.low < 0, testable=worth.low > 0)


def judge_temporality(met, whole, short):
    """Claim T3, from what learners have met and made in processes that remember (`neorl.classics.temporality`).

    met: {Ψ: (memories, states)}, how many states each run has met with each memory L, (runs, memories). whole, short:
    what agents that remember all L steps make above chance, and agents that remember one step less; each (runs,).
    """
    growth = {size: estimate(np.mean, _powers(memories, np.log(states) / np.log(size)))
              for size, (memories, states) in met.items()}
    furthest = max(growth, key=lambda size: abs(growth[size].value - 1))
    fits = [0.9 <= power.low and power.high <= 1.1 for power in growth.values()]
    overlapping = all(power.low <= 1.1 and 0.9 <= power.high for power in growth.values())
    gain, rest = estimate(np.mean, whole), estimate(np.mean, short)
    powers = "; ".join(f"{power} with Ψ = {size}" for size, power in growth.items())
    return _judged("T3", growth[furthest], f"It is {powers}. The states are needed if who remembers a step less makes "
                   f"less than half as much above chance: {rest}, where all steps make {gain}.",
                   min(len(whole), len(short)), reproduced=all(fits) and rest.high < 0.5 * gain.low, partly=any(fits),
                   possible=overlapping and rest.low < 0.5 * gain.high, testable=gain.low > 0)


def judge_tables(states, values, entries, filled):
    """Claim T4, from the tables of learners in processes of many sizes.

    states: S of each process, (sizes,). values, entries, filled: how many action values each learner has, how many
    entries its model of the transitions has, and how many of these are not 0; each (runs, sizes).
    """
    value, entry, full = (estimate(np.mean, _powers(np.log(states), np.log(table)))
                          for table in (values, entries, filled))
    fits = [abs(value.value - 1) <= 0.1, abs(entry.value - 2) <= 0.1]
    return _judged("T4", entry, f"The values of Q-learning grow by the power {value}, and the entries of the model "
                   f"that differ from 0 by {full}. The rule allows 0.1 more or less.", len(values),
                   reproduced=all(fits), partly=any(fits), possible=False)


def _judged(name, here, detail, runs, *, reproduced, partly, possible, testable=True):
    outcome = "not testable" if not testable else VERDICTS[0 if reproduced else 1 if partly else 2]
    return Claim(name, here, detail, runs, outcome, bool(testable and possible and not reproduced))


def _all_learned(*rates):
    return min(estimate(np.mean, rate).low for rate in rates) > 0


def _red_a_minute(result, begin, end):
    return 60 * result.hit_rate(begin, end)[:, 1]


def _powers(xs, ys):
    """The slope of each row of ys over xs."""
    return np.polyfit(xs, np.asarray(ys).T, 1)[0]


def _ratio(a, b, axis):
    """0 where b has earned nothing, since no claim of a ratio holds there."""
    above, below = np.asarray(a.mean(axis)), np.asarray(b.mean(axis))
    return np.divide(above, below, out=np.zeros(above.shape), where=below != 0)


def _more_errors(groups, more, less, days):
    return estimate(difference, *(groups[group].errors[:, days].mean(axis=1) for group in (more, less)))


def _cost_ratio(together, none, *alone, axis):
    base = np.median(none, axis)
    return (np.median(together, axis) - base) / sum(np.median(each, axis) - base for each in alone)


def _lead_over_best(a, *others, axis):
    return a.mean(axis) - np.max([other.mean(axis) for other in others], axis=0)


def _lead_over_sum(a, *others, axis):
    return a.mean(axis) - sum(other.mean(axis) for other in others)


def _rank_correlation(*samples, axis):
    """Spearman's, of the samples' places with their values; scipy's own takes one pair of samples at a time."""
    group = np.repeat(np.arange(len(samples)), [sample.shape[axis] for sample in samples])
    ranks = stats.rankdata(np.concatenate(samples, axis), axis=axis)
    place = stats.rankdata(group) - (len(group) + 1) / 2
    off = ranks - (len(group) + 1) / 2
    spread = np.asarray(np.sqrt((off**2).sum(axis) * (place**2).sum()))
    return np.divide((off * place).sum(axis), spread, out=np.zeros(spread.shape), where=spread > 0)
