"""What claims T7 and T5 are about: agents with either temporal driver, and an agent that runs in real time."""

from neorl import WaterWorld, multimodal
from companion.thesis.reading import conditions

STEPS, STAYS = 150_000, (1, 10, 50)
# The agents that are compared: the keys of their conditions, and of Brownian motion in their tank.
AGENTS = {"place cells": ("layers", ("brownian", 8)), "object-vector cells": (("objects", "all"), ("brownian", 3)),
          "both": ("both", ("brownian", 3))}
REAL_TIME = (multimodal(), WaterWorld(), 0.7)  # agent, world, and the seconds of a window


def compared(reading):
    """What T7 is about under a reading, {which: {driver: `Condition`}}; learning at every step by the stay."""
    cell, *every_step = (
        conditions(each, STEPS, 1, groups=("layers", "modal"))
        for each in (reading, *(reading.varied(credit="step", discount=reading.learning.discount ** (1 / stay))
                                for stay in STAYS)))
    return {which: {"changes of cell": cell[key], "Brownian motion": cell[chance],
                    **{stay: made[key] for stay, made in zip(STAYS, every_step)}}
            for which, (key, chance) in AGENTS.items()}


def at_every_step(results):
    """Of the results of an agent, {driver: result}, those of learning at every step: {stay: result}."""
    return {stay: result for stay, result in results.items() if isinstance(stay, int)}
