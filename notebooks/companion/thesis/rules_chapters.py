"""The rules that judge the claims of the chapters, and the demonstrations beside them.

`companion.thesis.verdict` defines verdicts.
"""

import numpy as np

from companion.thesis.measures import FINAL, exact, least, minutes_sooner, most, rank_correlation, share_of_lead
from companion.thesis.statements import POSITIVE, STATEMENTS
from companion.thesis.verdict import AFTER_TURN, all_of, any_learned, any_of, fewest_runs, judged, learned
from neorl.statistics import difference, estimate, probability_of_improvement, quotient, ratio

MINUTES = {"5 minutes before": (0.475, 0.5), "first minute": (0.5, 0.505), "second minute": (0.505, 0.51),
           "minutes 2 to 5": (0.505, 0.525), "after half an hour": (0.65, 0.675),
           "after 60 to 100 minutes": (0.8, 1.0)}  # shares of 200 minutes
# What agents desired while they learned, what they desire then, and what measures how well they get it.
PAST = {"none": "nothing wanted before", "green": "green wanted before", "papers": "green wanted and red feared before"}
THEN = {"papers": "green wanted and red feared", "both": "both colours wanted"}
MEASURED = {"papers": "points a second", "both": "caught a minute"}
ABOVE_CHANCE, NEARER, NO_FARTHER = STATEMENTS["T1"].also


def judge_changes(turned, brownian, moved):
    """Claim T1, on revaluing elements and on moving them.

    turned: {"revalued": the `Result` of agents that desire red creeps too from half-time on, "frozen": that of the same
    agents, which learn no more from there, "wanting": that of agents that desired them from the start, of runs of one
    length, 200 minutes at best; and maybe "random": those that have desired nothing before, and learn no more}.
    brownian: Brownian motion on the same board.
    moved: mean distances, in board widths, to a desired place in the time after each of its moves between two points:
    {"both": {"experienced": (runs, moves), "ignorant": (runs, moves)}, "place cells": the same}, an even number of
    moves, 4 or more, of agents with and without experience among creeps. Agents with both modalities decide.
    Returns a `Claim`.
    """
    after, frozen = (caught_a_minute(turned[name], "first minute") for name in ("revalued", "frozen"))
    chance = 60 * brownian.hit_rate().sum(axis=1)
    first, later = _visits(moved["both"]["experienced"])
    ignorant, _ = _visits(moved["both"]["ignorant"])
    others = {f"in the {when}": ("revalued", "frozen", when) for when in ("second minute", "minutes 2 to 5")}
    if "random" in turned:
        others["in the first minute, of those that had moved at random"] = "revalued", "random", "first minute"
    shown = {f"share {what}": estimate(share_of_lead, caught_a_minute(turned[one], when), chance,
                                       caught_a_minute(turned[other], when))
             for what, (one, other, when) in others.items()}
    shown |= {f"caught a minute, {when}": estimate(np.mean, caught_a_minute(turned["revalued"], when))
             for when in MINUTES}
    shown |= {f"caught in the first minute, {who}": estimate(np.mean, each) for who, each in (
        ("learning off", frozen), ("wanted from the start", caught_a_minute(turned["wanting"], "first minute")),
        ("Brownian motion", chance))}
    shown |= {f"distance at {when} visits, {who} with {agents}": estimate(np.mean, each)
              for agents, distances in moved.items() for who, of_moves in distances.items()
              for when, each in zip(("the first two", "later"), _visits(of_moves))}
    return judged("T1", estimate(share_of_lead, after, chance, frozen), fewest_runs(*turned.values()),
                  {ABOVE_CHANCE: estimate(difference, after, chance), NEARER: estimate(difference, ignorant, first),
                   NO_FARTHER: estimate(ratio, first, later)}, shown=shown,
                  parts=[(STATEMENTS["T1"].statistic, ABOVE_CHANCE), (NEARER, NO_FARTHER)])


def caught_a_minute(result, when):
    """The creeps of either colour that each run catches a minute in one of `MINUTES`, (runs,)."""
    begin, end = MINUTES[when]
    return 60 * result.hit_rate(begin, max(end, begin + 1.01 / result.rewards.shape[1])).sum(axis=1)


def _visits(distances):
    """The mean distances at the first two visits and at later ones, (runs,) each."""
    return distances[:, :2].mean(axis=1), distances[:, 2:].mean(axis=1)


def judge_cost(together, alone, none):
    """Claim T2, from the cost of an agent's maps together and alone; each (repetitions,), in the same unit per step.

    together: with all maps. alone: a sequence, with each map alone. none: without any.
    Returns a `Claim`.
    """
    return judged("T2", estimate(_cost_ratio, together, none, *alone), len(together))


def judge_temporality(whole, short):
    """Claim T3, from the loss of agents that remember one step less than the process
    (`notebooks/companion/chapter_3/decision.py`).

    whole, short: {name of a process: reward above chance, (runs,)}, of agents that remember all L steps, and of agents
    that remember one step less.
    Returns a `Claim`.
    """
    loss = {name: estimate(_loss, whole[name], short[name]) for name in whole}
    return judged("T3", (least, "loss"), min(map(len, (*whole.values(), *short.values()))), {"loss": loss},
                  testable=all_of([POSITIVE.decide(estimate(np.mean, above)) for above in whole.values()]))


def judge_tables(states, values, entries, filled):
    """Claim T4, from the tables of learners in processes of many sizes.

    states: S of each process, (sizes,). values, entries, filled: the numbers of a learner's action values, of entries
    in its model of the transitions, and of those that are not 0; each (runs, sizes).
    Returns a `Claim`.
    """
    value, entry, full = (estimate(np.mean, _powers(np.log(states), np.log(table)))
                          for table in (values, entries, filled))
    return judged("T4", entry, len(values), {"values": value}, shown={"entries that differ from 0": full})


def judge_real_time(load, delay, beside=None):
    """Claim T5, from the load of each window of a run in real time, in cores, and the delay of each step.

    load: (windows,). delay: (windows, steps), the time from when a step was due until it was done, in steps.
    beside: processes that were ready to run on a core of the machine, on average over the minute before the run, or
        None if the machine does not count them.
    Returns a `Claim`.
    """
    busy = {} if beside is None else {"processes per core just before": exact(beside)}
    return judged("T5", estimate(np.mean, load), len(load), {"steps late": exact(delay.max())},
                  shown={"share of steps done late": estimate(np.mean, (delay > 1).mean(axis=1)), **busy})


def judge_more_maps(additions):
    """Claim T6, from agents with more maps, compared with each of the agents with some of these.

    additions: {what is added: (more, fewer, brownian)}. more: the `Result` of the agent with more maps. fewer: {which:
    those of the agents with fewer}, in runs of the same length. brownian: Brownian motion on the same board.
    Returns a `Claim`.
    """
    known = {name: any_of([learned(result, brownian) for result in fewer.values()])
             for name, (_, fewer, brownian) in additions.items()}
    counted = [name for name in additions if known[name] is not False] or list(additions)  # where some have learned
    sooner = {f"{name}, over {which}": minutes for name in counted
              for which, minutes in sooner_with_more(*additions[name][:2]).items()}
    lead = {f"{name}, over {which}": estimate(difference, additions[name][0].rate(*FINAL), result.rate(*FINAL))
            for name in counted for which, result in additions[name][1].items()}
    return judged("T6", (least, "minutes sooner"),
                  min(fewest_runs(more, *fewer.values()) for more, fewer, _ in additions.values()),
                  {"minutes sooner": sooner, "final lead": lead},
                  parts=[(f"minutes sooner, {name}", f"final lead, {name}") for name in counted],
                  testable=any_of(known.values()))


def sooner_with_more(more, fewer):
    """The leads in minutes of agents with more maps over each with fewer, at half the final level of the best of these.

    more: a `Result`. fewer: {which: `Result`}. Returns {which: `Estimate`}.
    """
    return {which: minutes_sooner(more, result, 0.5, *(each for each in fewer.values() if each is not result))
            for which, result in fewer.items()}


def judge_persistence(agents):
    """Claim T7, from agents that learn at changes of cell, and the same that learn at every step.

    agents: {which: (persistent, per_step, brownian)}. persistent: the `Result` of agents that learn at changes of cell.
    per_step: {discount: that of agents that learn at every step}, otherwise the same; the best one counts. brownian:
    Brownian motion on the same board.
    Returns a `Claim`.
    """
    share, lead = {}, {}
    for name, (persistent, per_step, brownian) in agents.items():
        step = max((each.rate(*FINAL) for each in per_step.values()), key=np.mean)
        share[name] = estimate(_share_of_gain, step, persistent.rate(*FINAL), brownian.rate())
        lead[name] = estimate(difference, persistent.rate(*FINAL), step)
    known = {name: learned(persistent, brownian) for name, (persistent, _, brownian) in agents.items()}
    counted = [name for name in agents if known[name] is not False] or list(agents)
    runs = min(fewest_runs(persistent, *per_step.values()) for persistent, per_step, _ in agents.values())
    return judged("T7", (most, "gain"), runs,
                  {"gain": {name: share[name] for name in counted}},
                  {"lead at changes of cell": {name: lead[name] for name in counted}}, testable=any_of(known.values()))


def judge_time_scale(resolutions, stays, without):
    """Claim T8, from how long agents stay in the cells of maps of several resolutions.

    resolutions: N of each map, (maps,). stays: the mean time from one change of cell to the next, (runs, maps), in
    any unit. without: {name: the same}, of motion without values, in the same maps, which is only shown.
    Returns a `Claim`.
    """
    order = np.argsort(resolutions)[::-1]
    width, time = -np.log(np.asarray(resolutions, float)[order]), np.log(stays)[:, order]
    powers = _powers(width, time)
    coarser = [f"N{resolutions[at]}" for at in order[1:]]
    longer = dict(zip(coarser, (estimate(np.mean, each) for each in np.diff(time, axis=1).T)))
    alone = {name: _powers(width, np.log(each)[:, order]) for name, each in without.items()}
    return judged("T8", estimate(np.mean, powers), len(stays), {"longer in the next coarser map": longer},
                  shown={"exponent": {name: estimate(np.mean, each) for name, each in alone.items()}}, parts=())


def judge_knowledge(turned, brownian):
    """Claim T10, from agents whose elements of interest change at half-time.

    turned: {"changed": (`Result` of agents that go on learning, that of the same that learn no more), "removed": the
    same}, of agents that fear red creeps before, and then desire them too, or have no desire for them. brownian:
    Brownian motion on the same board.
    What agents catch of what they desire says what they know; what those know that learn no more has not changed.
    Returns a `Claim`.
    """
    colours = {"changed": slice(None), "removed": slice(0, 1)}
    caught = {what: [60 * each.hit_rate(*FINAL)[:, colours[what]].sum(axis=1) for each in both]
              for what, both in turned.items()}
    chance = {what: 60 * brownian.hit_rate()[:, colours[what]].sum(axis=1) for what in turned}
    kept = {what: estimate(share_of_lead, learning, chance[what], frozen)
            for what, (learning, frozen) in caught.items()}
    return judged("T10", (least, "kept"), fewest_runs(*(each for both in turned.values() for each in both)),
                  {"kept": kept}, shown={f"caught a minute, {what}": dict(zip(
                      ("learning on", "learning off", "Brownian motion"),
                      (estimate(np.mean, each) for each in (*caught[what], chance[what])))) for what in turned},
                  testable=any_of([POSITIVE.decide(estimate(difference, caught[what][1], chance[what]))
                                   for what in turned]))


def judge_pasts(pasts, brownian):
    """Claim T11, from agents that have learned with other desires, then all desire the same and learn no more.

    pasts: {"papers" or "both", what they desire then: {what they desired while they learned: `Result`}}; "papers" is
    green creeps and no red ones, "both" is both colours. brownian: Brownian motion on the same board.
    They are compared, for each desire, with the past that serves it best: by points a second under that of the papers,
    and by the creeps of both colours that they catch a minute under the other.
    Returns a `Claim`.
    """
    def earned(then, result, when):
        return result.rate(*when) if then == "papers" else 60 * result.hit_rate(*when).sum(axis=1)

    share, level, best_leads = {}, {}, []
    for then, of_past in pasts.items():
        rates = {was: earned(then, each, FINAL) for was, each in of_past.items()}
        chance = earned(then, brownian, (0, 1))
        best = max(rates, key=lambda was: rates[was].mean())
        share[f"share, {THEN[then]}"] = {PAST[was]: estimate(share_of_lead, rates[was], chance, rates[best])
                                         for was in rates if was != best}
        level[f"{MEASURED[then]}, {THEN[then]}"] = {PAST[was]: estimate(np.mean, each) for was, each in rates.items()}
        best_leads.append(POSITIVE.decide(estimate(difference, rates[best], chance)))
    runs = min(fewest_runs(*of_past.values()) for of_past in pasts.values())
    return judged("T11", (least, "share"), runs, share, shown=level, parts=[(what,) for what in share],
                  testable=any_of(best_leads))


def judge_scaling(grown, brownian):
    """Claim T12, from agents with more and more maps.

    grown: {which: `Result`s of agents with one map, with two, and so on}. brownian: Brownian motion on the same board.
    Returns a `Claim`.
    """
    final = {name: [each.rate(*FINAL) for each in results] for name, results in grown.items()}
    everyone = [each for results in grown.values() for each in results]
    return judged("T12", (least, "correlation"), fewest_runs(*everyone),
                  {"correlation": {name: estimate(rank_correlation, *each) for name, each in final.items()}},
                  shown={f"final reward per second, {name}": {f"{k} map{'s' * (k > 1)}": estimate(np.mean, rates)
                                                              for k, rates in enumerate(each, 1)}
                         for name, each in final.items()}, testable=any_learned(everyone, brownian))


def judge_latent_learning(agent, rivals, first_reward=11):
    """Demonstration H1, from {group: record} of animals, each record with ``errors`` (animals, days).

    agent: of neoRL, for the groups "throughout", "never" and "delayed", which is rewarded from day ``first_reward`` on.
    rivals: {name: the same} of other learners, which are reported and not judged.
    Returns a `Claim`.
    """
    after, next_day = slice(first_reward, None), slice(first_reward, first_reward + 1)
    lead = _more_errors(agent, "delayed", "throughout", after)
    at_once = _more_errors(agent, "delayed", "throughout", next_day)
    worth = _more_errors(agent, "never", "throughout", after)
    level = most([lead, at_once])
    level = type(level)(*(quotient(each, worth.value) for each in level))
    return judged("H1", lead, min(len(record.errors) for record in agent.values()),
                  also={"level": level}, shown={
                      "on the day after the first reward": at_once, "effect of reward": worth, **{
                          f"with {name}": _more_errors(groups, "delayed", "throughout", after)
                          for name, groups in rivals.items()}}, testable=POSITIVE.decide(worth))


def _powers(xs, ys):
    """The slope of each row of ys over xs."""
    return np.polyfit(xs, np.asarray(ys).T, 1)[0]


def _loss(whole, short, axis):
    return 1 - ratio(short, whole, axis)


def _share_of_gain(step, cell, chance, axis):
    base = chance.mean(axis)
    return quotient(step.mean(axis) - base, cell.mean(axis) - base)


def _more_errors(groups, more, less, days):
    return estimate(difference, *(groups[group].errors[:, days].mean(axis=1) for group in (more, less)))


def _cost_ratio(together, none, *alone, axis):
    base = np.median(none, axis)
    return (np.median(together, axis) - base) / sum(np.median(each, axis) - base for each in alone)


def judge_efficiency(agent, table, chance):
    """Demonstration G1, from the duration of the second trial at a new place, in seconds (runs,).

    agent: of agents. table: of Q-learning on the same cells. chance: of animals that swim at random.
    Returns a `Claim`.
    """
    share, gain = estimate(ratio, agent, table), estimate(difference, chance, agent)
    return judged("G1", share, min(map(len, (agent, table, chance))), {"seconds less than at random": gain},
                  {"share of the quicker of both": estimate(_share_of_less, agent, table, chance)})


def _share_of_less(steps, one, other, axis):
    return quotient(steps.mean(axis), np.minimum(one.mean(axis), other.mean(axis)))


def judge_generality(scores):
    """Demonstration G2, from {world: (agent (runs,), chance (runs,))}, of agents with one learning rule and at random.

    Returns a `Claim`.
    """
    better = {world: probability_of_improvement(*pair) for world, pair in scores.items()}
    return judged("G2", (least, "world"), min(len(each) for pair in scores.values() for each in pair),
                  {"world": better})


def judge_composition(apart, whole, chance):
    """Demonstration G3, from the steps to a point of a space of two features.

    Steps are multiples of the fewest possible, (runs,).

    apart: of agents with a map for each feature. whole: with one map of both. chance: at random.
    Returns a `Claim`.
    """
    cost, gain = estimate(ratio, apart, whole), estimate(ratio, chance, apart)
    return judged("G3", cost, min(map(len, (apart, whole, chance))), {"random agents": gain},
                  {"share of twice as many, or of random agents'": estimate(_share_of_less, apart, 2 * whole, chance)})


def judge_extension(joined, alone, chance):
    """Demonstration G4, from `Result`s of runs of the same length.

    joined: agents that gain a second map at half-time. alone: agents that do not. chance: at random.
    Returns a `Claim`.
    """
    gain = estimate(difference, 60 * joined.rate(*FINAL), 60 * alone.rate(*FINAL))
    kept = estimate(ratio, joined.rate(*AFTER_TURN), alone.rate(*AFTER_TURN))
    return judged("G4", gain, fewest_runs(joined, alone, chance), {"kept": kept},
                  testable=learned(alone, chance))
