"""The rules that judge the claims of the chapters, and the demonstration beside them.

`neorl.evidence.verdict` defines verdicts.
"""

import numpy as np

from neorl.evidence.statements import STATEMENTS
from neorl.evidence.statistics import difference, estimate, minutes_sooner, quotient, ratio
from neorl.evidence.verdict import AFTER_TURN, BEFORE_TURN, FINAL, fewest_runs, judged, lead_over_brownian, learned


def judge_changes(revalued, moved=None):
    """Claim T1 on revaluing elements, and on its page also on moving them, compared with the same agents later.

    revalued: the `Result` of agents that desire red creeps too, from half-time on.
    moved: mean distances, in board widths, to a desired place in the time after each of its moves between two points:
        {"experienced": (runs, moves), "ignorant": (runs, moves)}, an even number of moves, 4 or more, of agents with
        and without experience among creeps. Readings are judged without it, by revaluing alone.
    Returns a `Claim`.
    """
    before, after, later = (_red_a_minute(revalued, *share) for share in (BEFORE_TURN, AFTER_TURN, FINAL))
    kept, turn = estimate(ratio, after, later), estimate(difference, after, before)
    settled = estimate(difference, later, before)
    at_once, as_near = STATEMENTS["T1"].bounds, STATEMENTS["T1"].also["moved"]
    whole, room = [turn.low > 0 and at_once.hold(kept)], [turn.high > 0 and at_once.allow(kept)]
    decay = "" if settled.low > 0 else " Finally the rate is not above that before the turn, so it decays."
    detail = (f"Per minute, {estimate(np.mean, before)} before the turn, {estimate(np.mean, after)} after it and "
              f"{estimate(np.mean, later)} finally. No retraining is read as a rise at once, to {at_once} of the later "
              f"level.{decay}")
    if moved:
        first, others = moved["experienced"][:, :2].mean(axis=1), moved["experienced"][:, 2:].mean(axis=1)
        near = estimate(ratio, others, first)
        known = estimate(difference, moved["ignorant"][:, :2].mean(axis=1), first)
        whole.append(as_near.hold(near) and known.low > 0)
        room.append(as_near.allow(near) and known.high > 0)
        detail += (f" After later moves of a place the distance is {near} times that after the first two, and after "
                   f"these it is {known} smaller than for agents that have learned nothing.")
    return judged("T1", kept, detail, revalued.runs, reproduced=all(whole), partly=turn.low > 0 or any(whole),
                  possible=all(room))


def judge_cost(together, alone, none):
    """Claim T2, from the cost of an agent's maps together and alone; each (repetitions,), in the same unit per step.

    together: with all maps. alone: a sequence, with each map alone. none: without any.
    Returns a `Claim`.
    """
    cost, linear = estimate(_cost_ratio, together, none, *alone), STATEMENTS["T2"].bounds
    return judged("T2", cost, f"The rule allows {linear}.", len(together), reproduced=linear.hold(cost), partly=False,
                  possible=linear.allow(cost))


def judge_temporality(whole, short):
    """Claim T3, from the loss of agents that remember one step less than the process
    (`notebooks/lib/chapter_3/temporality.py`).

    whole, short: {name of a process: reward above chance, (runs,)}, of agents that remember all L steps, and of agents
    that remember one step less.
    Returns a `Claim`.
    """
    loss = {name: estimate(_loss, whole[name], short[name]) for name in whole}
    least = min(loss, key=lambda name: loss[name].value)
    found = "; ".join(f"{lost} with “{name}”" for name, lost in loss.items())
    worth = STATEMENTS["T3"].bounds
    needed = [worth.hold(lost) for lost in loss.values()]
    return judged("T3", loss[least], f"It is {found}. All L steps are needed if {worth} is lost in every process.",
                  min(map(len, (*whole.values(), *short.values()))), reproduced=all(needed), partly=any(needed),
                  possible=all(worth.allow(lost) for lost in loss.values()),
                  testable=all(estimate(np.mean, each).low > 0 for each in whole.values()))


def judge_tables(states, values, entries, filled):
    """Claim T4, from the tables of learners in processes of many sizes.

    states: S of each process, (sizes,). values, entries, filled: the numbers of a learner's action values, of entries
    in its model of the transitions, and of those that are not 0; each (runs, sizes).
    Returns a `Claim`.
    """
    value, entry, full = (estimate(np.mean, _powers(np.log(states), np.log(table)))
                          for table in (values, entries, filled))
    square, linear = STATEMENTS["T4"].bounds, STATEMENTS["T4"].also["values"]
    fits = [linear.low <= value.value <= linear.high, square.low <= entry.value <= square.high]
    return judged("T4", entry, f"For the values of Q-learning the exponent is {value}, and for the entries of the "
                  f"model that differ from 0 it is {full}. The rule allows {square} for the model and {linear} for the "
                  "values.", len(values),
                  reproduced=all(fits), partly=any(fits), possible=False)


def judge_real_time(load, delay, beside=None):
    """Claim T5, from the load of each window of a run in real time, in cores, and the delay of each step.

    load: (windows,). delay: (windows, steps), the time from when a step was due until it was done, in steps.
    beside: processes that were ready to run on a core of the machine, on average over the minute before the run, or
        None if the machine does not count them.
    Returns a `Claim`.
    """
    share, latest, within = estimate(np.mean, load), delay.max(), STATEMENTS["T5"].bounds
    latest_allowed = STATEMENTS["T5"].also["steps late"].high
    busy = "" if beside is None else f" The machine ran {beside:.2f} processes per core just before."
    return judged("T5", share, f"Steps done after the next one was due: {(delay > 1).sum()} of {delay.size}; the "
                  f"latest was done {latest:.2f} steps after it was due. The rule allows {latest_allowed:g}.{busy}",
                  len(load), reproduced=share.high < within.high and latest <= latest_allowed,
                  partly=share.high < within.high, possible=share.low < within.high)


def judge_more_maps(additions):
    """Claim T6, from agents with more maps, compared with agents with some of these.

    additions: {what is added: (more, fewer, brownian)}. more: the `Result` of the agent with more maps. fewer: a
    sequence of those of the agents with fewer, in runs of the same length. brownian: Brownian motion on the same board.
    Returns a `Claim`.
    """
    sooner, room, testable, later = {}, {}, [], STATEMENTS["T6"].also["shares of a run later"].high
    for name, (more, fewer, brownian) in additions.items():
        sooner[name] = sooner_with_more(more, fewer)
        room[name] = later * more.seconds / 60
        if any(learned(result, brownian) for result in fewer):
            testable.append(name)
    counted = testable or list(additions)
    least = min(counted, key=lambda name: sooner[name].value)
    as_soon = [sooner[name].low >= -room[name] for name in counted]
    found = "; ".join(f"{sooner[name]} by {name}" for name in counted)
    rest = ", ".join(name for name in additions if name not in counted)
    left_out = f" Left out, since no agent with fewer maps has learned there: {rest}." if rest else ""
    return judged("T6", sooner[least], f"It is {found}, at half the final level of the best agent with fewer maps, "
                  f"over the quickest.{left_out} Not slower is read as at most a fortieth of the run later.",
                  min(fewest_runs(more, *fewer) for more, fewer, _ in additions.values()),
                  reproduced=all(as_soon), partly=any(as_soon),
                  possible=all(sooner[name].high >= -room[name] for name in counted), testable=bool(testable))


def sooner_with_more(more, fewer):
    """The lead in minutes of agents with more maps over the quickest with fewer, at half the best one's final level.

    more: a `Result`. fewer: a sequence. Returns an `Estimate`.
    """
    level = 0.5 * max(result.rate(*FINAL).mean() for result in fewer)
    return min((minutes_sooner(more, result, level) for result in fewer), key=lambda lead: lead.value)


def judge_persistence(agents):
    """Claim T7, from agents that learn at changes of cell, and the same that learn at every step.

    agents: {which: (persistent, per_step, brownian)}. persistent: the `Result` of agents that learn at changes of cell.
    per_step: {discount: that of agents that learn at every step}, otherwise the same; the best one counts. brownian:
    Brownian motion on the same board.
    Returns a `Claim`.
    """
    share, lead, text = {}, {}, {}
    for name, (persistent, per_step, brownian) in agents.items():
        best = max(per_step, key=lambda discount: per_step[discount].rate(*FINAL).mean())
        step, cell = per_step[best].rate(*FINAL), persistent.rate(*FINAL)
        share[name] = estimate(_share_of_lead, step, cell, brownian.rate())
        lead[name] = estimate(difference, cell, step)
        text[name] = (f"With {name}, learning at every step does best with {best}, and leads Brownian motion by "
                      f"{lead_over_brownian(per_step[best], brownian)}; the lead of learning at changes of cell over "
                      f"it is {lead[name]}.")
    counted = [name for name, (persistent, _, brownian) in agents.items() if learned(persistent, brownian)]
    rest = ", ".join(name for name in agents if name not in counted)
    left_out = f" Left out, as learning at changes of cell gains nothing there: {rest}." if rest and counted else ""
    counted, testable = counted or list(agents), bool(counted)
    runs = min(fewest_runs(persistent, *per_step.values()) for persistent, per_step, _ in agents.values())
    most, fails = max(counted, key=lambda name: share[name].value), STATEMENTS["T7"].bounds
    return judged("T7", share[most], f"{' '.join(text[name] for name in counted)}{left_out} Learning at "
                  f"every step fails if it gains {fails} of the other.", runs,
                  reproduced=all(fails.hold(share[name]) for name in counted),
                  partly=any(lead[name].low > 0 for name in counted),
                  possible=all(fails.allow(share[name]) for name in counted), testable=testable)


def judge_time_scale(resolutions, stays):
    """Claim T8, from how long agents stay in the cells of maps of several resolutions.

    resolutions: N of each map, (maps,). stays: the mean time from one change of cell to the next, (runs, maps), in
    any unit.
    Returns a `Claim`.
    """
    order = np.argsort(resolutions)[::-1]
    width, time = -np.log(np.asarray(resolutions, float)[order]), np.log(stays)[:, order]
    power = estimate(np.mean, _powers(width, time))
    longer = [estimate(np.mean, each) for each in np.diff(time, axis=1).T]
    direct = STATEMENTS["T8"].bounds
    return judged("T8", power, f"1 means in proportion. The rule asks for {direct}, and for longer stays in every "
                  "coarser map.", len(stays),
                  reproduced=direct.hold(power) and all(each.low > 0 for each in longer), partly=power.low > 0,
                  possible=direct.allow(power) and all(each.high > 0 for each in longer))


def judge_latent_learning(agent, rivals, first_reward=11):
    """Demonstration H1, from {group: record} of animals, each record with ``errors`` (animals, days).

    agent: of neoRL, for the groups "throughout", "never" and "delayed", which is rewarded from day ``first_reward`` on.
    rivals: {name: the same} of other learners, which are reported and not judged.
    Returns a `Claim`.
    """
    runs, level = min(len(record.errors) for record in agent.values()), STATEMENTS["H1"].also["level"].high
    after, next_day = slice(first_reward, None), slice(first_reward, first_reward + 1)
    lead = _more_errors(agent, "delayed", "throughout", after)
    at_once = _more_errors(agent, "delayed", "throughout", next_day)
    worth = _more_errors(agent, "never", "throughout", after)
    others = "; ".join(f"{name} {_more_errors(groups, 'delayed', 'throughout', after)}"
                       for name, groups in rivals.items())
    return judged("H1", lead, f"On the day after the first reward it is {at_once}. Drawing level is read as within a "
                  f"tenth of the effect of reward, {worth.value:.2f}. With other learners it is: {others}.", runs,
                  reproduced=lead.high < 0, partly=max(lead.high, at_once.high) <= level * worth.value,
                  possible=lead.low < 0, testable=worth.low > 0)


def _red_a_minute(result, begin, end):
    return 60 * result.hit_rate(begin, end)[:, 1]


def _powers(xs, ys):
    """The slope of each row of ys over xs."""
    return np.polyfit(xs, np.asarray(ys).T, 1)[0]


def _loss(whole, short, axis):
    return 1 - ratio(short, whole, axis)


def _share_of_lead(step, cell, chance, axis):
    base = chance.mean(axis)
    return quotient(step.mean(axis) - base, cell.mean(axis) - base)


def _more_errors(groups, more, less, days):
    return estimate(difference, *(groups[group].errors[:, days].mean(axis=1) for group in (more, less)))


def _cost_ratio(together, none, *alone, axis):
    base = np.median(none, axis)
    return (np.median(together, axis) - base) / sum(np.median(each, axis) - base for each in alone)
