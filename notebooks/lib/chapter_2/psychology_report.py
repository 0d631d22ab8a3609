"""Sentences on the behaviour of animals in boxes and under desires."""

import numpy as np

from neorl.evidence.statistics import estimate

LAST_SESSIONS = 3  # of a phase, over which presses are counted


def describe_latencies(latencies, published):
    """How fast cats escape from the box under each law, {name: seconds (runs, trials)}, and a real cat, (trials,)."""
    paces, early = [], []
    for law, seconds in latencies.items():
        mean = seconds.mean(axis=0)
        halved = np.flatnonzero(mean <= mean[0] / 2)
        when = f"trial {halved[0] + 1} is the earliest to take" if len(halved) else "no trial takes"
        first, last = (estimate(np.mean, seconds[:, trial]) for trial in (0, -1))
        paces.append(f"with *{law}* a cat takes {first} seconds in the first trial and {last} in the last, and {when} "
                     "at most half as long as the first")
        early.append(f"{mean[: len(published)].mean():.0f} with *{law}*")
    return (f"On average, {'; '.join(paces)}. Over its first {len(published)} trials the cat of 1899 took "
            f"{np.mean(published):.0f} seconds on average; the simulated cats take {', '.join(early)}.")


def describe_presses(minutes, ends):
    """How light gates presses at the end of phases in which the lever always pays, pays in the light, never pays.

    minutes: presses per minute of rats {"sees", "blind"}, (runs, sessions, 2), in the light first, then in the dark.
    ends: the number of sessions completed at the end of each phase, of which the last three count.
    """
    sees, blind = ([minutes[rat][:, end - LAST_SESSIONS : end].mean(axis=1) for end in ends]
                   for rat in ("sees", "blind"))
    rates = [estimate(np.mean, each) for light_and_dark in sees for each in light_and_dark.T]
    gap, by_food = (estimate(np.mean, gated[:, 0] - gated[:, 1]) for _, gated, _ in (sees, blind))
    last_press = (": if the last press paid, the next one may pay too, so food itself acts as a stimulus"
                  if by_food.low > 0 else "")
    light = ("The light gates the response much better, but only in rats that perceive it."
             if gap.low > by_food.high else
             "So few rats do not show the effect of the light.")
    return ("In the last three sessions of each phase a rat that sees the light presses {} times per minute in the "
            "light and {} in the dark while the lever always pays, {} and {} while it pays in the light, and {} and {} "
            "once it never pays. ".format(*rates)
            + f"In the second phase the light makes a difference of {gap} presses per minute. In blind rats the "
            f"difference is {by_food}{last_press}. {light}")


def describe_way(steps):
    """The length of a path in words. steps: None if there is no path."""
    return "no path" if steps is None else f"{steps} steps"
