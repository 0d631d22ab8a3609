"""Agents without desires in the first part of a run, beside agents that have them throughout: a demonstration.

1. Both are agents of paper B with all maps of both modalities.
2. An *indifferent* agent has the same desires, each with a valence of 0. It moves at random, and learns.
3. At a given step it receives the valences of the other agents.
"""

from dataclasses import replace

import numpy as np

from neorl.agents import papers
from neorl.evidence.statistics import difference, estimate
from neorl.evidence.verdict import EARLY, FINAL
from neorl.experiments.sweeping import simulate_once
from neorl.worlds.waterworld import WaterWorld

BEFORE, AFTER = (0.4, 0.5), (0.5, 0.6)  # the tenths of the run before and after half-time


def live(reading, begin, steps, runs, seed=0):
    """Run agents under a `Reading` that have desires from step ``begin`` on, 0 for throughout: a `Result`.

    steps, runs, seed: as `neorl.simulate` takes them.
    """
    desiring = papers.multimodal(papers.PRIMES, place_gain=reading.place_gain, **reading.agents)
    indifferent = replace(desiring, desires=[replace(desire, valence=0.0) for desire in desiring.desires])
    agent, changes = (indifferent, [(begin, desiring)]) if begin else (desiring, [])
    world = WaterWorld(fps=reading.fps, contact=reading.contact)
    return simulate_once(agent, world, steps=steps, runs=runs, seed=seed, changes=changes)


def in_words(throughout, from_half_time):
    """Whether agents with desires from half-time on have learned before it, in Markdown. Both are a `Result`."""
    before = estimate(np.mean, from_half_time.rate(*BEFORE))
    after = estimate(np.mean, from_half_time.rate(*AFTER))
    newborn = estimate(np.mean, throughout.rate(*EARLY))
    lead = estimate(difference, from_half_time.rate(*AFTER), throughout.rate(*EARLY))
    gap, at_last = (estimate(difference, from_half_time.rate(*share), throughout.rate(*share))
                    for share in (AFTER, FINAL))
    said = [f"In the tenth of the run before half-time the indifferent agents earn {before} per second, in the tenth "
            f"after it {after}. The others earned {newborn} in the first tenth of their run."]
    if lead.low > 0:
        said.append(f"The indifferent agents thus learned before half-time: their lead over the first tenth is {lead}.")
    else:
        said.append(f"Their lead over that tenth is not certain: {lead}.")
    if gap.low <= 0 <= gap.high:
        why = ", which these runs do not distinguish from 0"
    elif gap.high < 0:
        why = ": lower, since agents that pursue creeps meet more of them"
    else:
        why = ": higher, since drifting agents visit more of the tank"
    ahead = ", so the agents without desires for half the run are ahead" if at_last.low > 0 else ""
    said.append(f"In the tenth after half-time their lead over agents with desires throughout is {gap}{why}; in the "
                f"last fifth of the run it is {at_last}{ahead}.")
    return " ".join(said)


def vary_begin(reading, begins, steps, runs, seed=0):
    """Reward per second in the tenth of a run after desires begin: {minutes before: `Estimate`}.

    begins: steps, each ≥ 1. Other arguments as in `live`.
    """
    earned = {}
    for begin in begins:
        result = live(reading, begin, steps, runs, seed)
        earned[begin / result.world.fps / 60] = estimate(np.mean, result.rate(begin / steps, begin / steps + 0.1))
    return earned


def beginnings(earned):
    """The results of `vary_begin` as text, one line each."""
    return "\n".join(f"{minutes:5.2f} minutes without: {reward} per second in the next tenth"
                     for minutes, reward in earned.items())
