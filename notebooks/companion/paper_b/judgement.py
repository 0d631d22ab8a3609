"""The claims that the page on paper B judges: each by its rule, if all that the rule compares was run as in the paper.

The results under one reading are those of `companion.paper_b.figures`, and what the page measures further down.
"""

from dataclasses import replace

from companion.shared import judging
from companion.thesis import claims
from companion.thesis import reading as readings
from companion.thesis.reading import GROUPS, PRIMES

PAYING = 1.0  # for the last green creep, where resets are counted by what they pay
TIMED = 20_000  # steps of an agent whose cost is measured


def of_figures(results, reading):
    """The claims on figures 4 and 5 under a reading, B1, B3, B6 and B2, a list."""
    return (judging.of_papers(results, reading, "modal", "resolutions")
            or judging.of_papers(results, reading, "modal"))


def of_trials(results, reading, *, layers, paced, boards, joined, turned, wanting, moved, cost, stays):
    """The other claims under a reading, B4, B5, B7, T1, T2, T6 and T8, a list.

    layers: {key: `Result`} of paper A's agents. paced, boards: {agent of figure 5: `Result`}, of long runs, and of
    boards that pay for a reset. joined, turned, wanting: a `Result` of agents to which a modality is added, of agents
    whose desires change, and of agents that had the new desires from the start. moved, cost, stays: a `trials.Moved`,
    `trials.Costs` and `trials.Stays`.
    """
    papers = judging.papers(reading, *GROUPS)
    both, place = papers["both"], papers["place", "all"]
    ran = results | layers | {
        ("pace", "place"): paced["PC"], ("pace", "both"): paced["PC + OVC"],
        "paying": boards["PC + OVC"], "joined": joined, "revalued": turned, "wanting": wanting,
        "moved": moved.condition, "cost": cost.condition, "stays": stays.condition}
    wanted = papers | {
        "paying": replace(both, world=replace(both.world, win_reward=PAYING)),
        "joined": replace(place, changes=((place.steps // 2, both.agent),)),
        "moved": place, "cost": replace(both, steps=TIMED), "stays": place}
    chance, near = results["brownian", 3], {group: each.mean(axis=2) for group, each in moved.distances.items()}
    rules = {
        GROUPS["pace"]: lambda: claims.judge_pace(paced["PC"], paced["PC + OVC"], chance),
        ("paying",): lambda: claims.judge_points(boards["PC + OVC"]),
        ("joined", ("place", "all"), ("brownian", 3)):
            lambda: claims.judge_joining(joined, results["place", "all"], chance),
        ("revalued", "wanting", "moved"): lambda: claims.judge_changes(turned, wanting, near),
        ("cost",): lambda: claims.judge_cost(cost.first[-1], cost.alone, cost.none),
        GROUPS["layers"] + GROUPS["modal"] + GROUPS["resolutions"]:
            lambda: claims.judge_more_maps(readings.additions(ran)),
        ("stays",): lambda: claims.judge_time_scale(PRIMES, stays.seconds)}
    return [claim for keys, rule in rules.items() for claim in judging.judged(
        lambda rule=rule: [rule()], ran, {key: wanted[key] for key in keys})]
