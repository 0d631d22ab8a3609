"""One score per run and world of the page, for its agent and for the same agent acting at random; higher is better."""

import numpy as np

from neorl.evidence.verdict import FINAL

LATER = slice(4, None)  # the days in the pool that count, after some learning


def of_each_world(reached, sailed, swum, asked, driven):
    """Scores from what the modules of the page return: {world: (agent float64 (runs,), random float64 (runs,))}.

    For arms and the vessel, the reward per second in the last fifth. For the pool with a moved platform, the seconds of
    the trials after the first of each later day; for birds, the steps of a question as a multiple of the fewest; for
    the car, the steps per episode in the last quarter; these three with a minus sign.
    """
    return {"arm of two links": _rates(reached[2, "agent"], reached[2, "random"]),
            "arm of three links": _rates(reached[3, "agent"], reached[3, "random"]),
            "vessel": _rates(sailed["radar"], sailed["random"]),
            "water maze": tuple(-swum["moved"][name][:, LATER, 1:].mean(axis=(1, 2)) for name in ("neoRL", "random")),
            "birds": tuple(-asked[name].mean(axis=1) for name in ("one map", "random")),
            "mountain car": tuple(-driven[name][:, -2:].mean(axis=1) for name in ("neoRL", "random"))}


def seconds_at_a_new_place(swum, swimmer):
    """Seconds of the second trial of each later day with a moved platform: float64 (runs,)."""
    return swum["moved"][swimmer][:, LATER, 1].mean(axis=1)


def _rates(*results):
    return tuple(np.asarray(result.rate(*FINAL)) for result in results)
