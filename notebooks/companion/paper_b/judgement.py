"""The claims that the page on paper B judges: each by its rule, if all that the rule compares is the paper's own."""

from dataclasses import replace

from companion.page import judging
from companion.thesis import claims
from companion.thesis.reading import PRIMES
from companion.thesis.statements import STATEMENTS

PAYING = 1.0  # for the last green creep, where resets are counted by what they pay


def judge(ran, reading, paced, paying, joined, stays):
    """The claims of the page under a reading, a list.

    ran: `Result`s of the agents of figures 4 and 5 and of Brownian motion, a list. paced: of longer runs of those of
    figure 5, by which the time to the final level is judged, a list. paying: the `Result` of the agent with both
    modalities on boards that pay for a reset. joined: that of the agent to which a modality is added. stays: a
    `trials.Stays`.
    """
    found = judging.judge_papers(ran, reading, "modal", "resolutions") or judging.judge_papers(ran, reading, "modal")
    found += judging.judge_papers(ran + paced, reading, "pace")
    wanted = judging.papers_conditions(reading, "modal")
    both, place, control = (wanted[key] for key in ("both", ("place", "all"), ("brownian", 3)))
    compared = judging.by_condition(ran, {"place": place, "control": control})
    changed = replace(place, changes=((place.steps // 2, both.agent),))
    found += judging.judge(lambda: [claims.judge_points(paying)], paying,
                           replace(both, world=replace(both.world, win_reward=PAYING)))
    found += judging.judge(lambda: [claims.judge_joining(joined, compared["place"], compared["control"])],
                           compared | {"joined": joined}, {"joined": changed, "place": place, "control": control})
    found += judging.judge(lambda: [claims.judge_time_scale(PRIMES, stays.seconds, stays.without)], stays.condition,
                           place)
    return sorted(found, key=lambda claim: [*STATEMENTS].index(claim.name))
