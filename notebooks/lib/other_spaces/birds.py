"""A space of concepts: birds that differ in the lengths of neck and legs.

1. The birds are those of Constantinescu et al. (2016). One is a point of a
   square, neck along x and legs along y, both from 0 (short) to 1 (long).
   The square is an `Arena` whose four actions make the neck or the legs
   shorter or longer by a `STEP`.
2. Six birds are named after symbols of Christmas, as in the study. Their
   positions are ours.
3. An agent first morphs birds without a desire, for `MORPHING` steps. It is
   then asked for one bird after another: the named ones, then some without a
   name. A question is answered when the agent comes within `REACH` of the
   bird, and abandoned after `PATIENCE` steps.
"""

import math

import numpy as np

from lib.other_spaces import minds
from neorl import Arena, Run

NAMED = {"bell": (0.15, 0.25), "candle": (0.8, 0.15), "star": (0.5, 0.55),
         "sleigh": (0.85, 0.75), "wreath": (0.2, 0.9),
         "gingerbread": (0.6, 0.9)}
NAMELESS = ((0.1, 0.6), (0.9, 0.45), (0.4, 0.1), (0.35, 0.75))
STEP, REACH, PATIENCE = 0.05, 0.08, 300
MORPHING = 20_000
SPACE = Arena([(name, *bird) for name, bird in NAMED.items()],
              shape="square", motion="steps", step_length=STEP, radius=REACH,
              ends=False, start=(0.5, 0.5), trial_seconds=1e6, fps=10)
ONE_MAP, MAP_OF_EACH = minds.thinker(False), minds.thinker(True)
THINKERS = {"one map": (ONE_MAP, MORPHING),
            "a map of each": (MAP_OF_EACH, MORPHING),
            "a map of each, hasty": (minds.in_haste(MAP_OF_EACH), MORPHING),
            "newborn": (ONE_MAP, 0), "random": (minds.aimless(ONE_MAP), 0)}


def ask(runs, seed):
    """Steps that each question takes, as multiples of the fewest.

    Returns {thinker: float64 (runs, birds)}, named birds first. thinker:
    with "one map" of both features; "a map of each", also "hasty", with a
    higher learning rate; "newborn", with one map and without earlier
    morphing; "random".
    """
    return {name: np.array([_ask(agent, morphing, seed, run)
                            for run in range(runs)])
            for name, (agent, morphing) in THINKERS.items()}


def fewest(here, there):
    """The fewest steps from one bird to another, to within a step."""
    gap = [abs(a - b) for a, b in zip(here, there)]
    columns = np.arange(math.floor(gap[0] / STEP) + 2)
    rows = np.arange(math.floor(gap[1] / STEP) + 2)
    left, up = np.meshgrid(gap[0] - STEP * columns, gap[1] - STEP * rows,
                           indexing="ij")
    steps = np.add.outer(columns, rows)
    return int(steps[left**2 + up**2 < REACH**2].min())


def path(apart, seed, birds):
    """The birds that an agent passes through on its way to each of `birds`.

    Returns a list of float64 (steps, 2).
    """
    run = Run(minds.thinker(apart), SPACE, seed)
    run.advance(MORPHING)
    return [_morph(run, bird) for bird in birds]


def _ask(agent, morphing, seed, run):
    life = Run(agent, SPACE, seed, run)
    life.advance(morphing)
    taken = []
    for bird in (*NAMED.values(), *NAMELESS):
        least = fewest(life.world_state.scene.position, bird)
        taken.append((len(_morph(life, bird)) - 1) / max(least, 1))
    return taken


def _morph(life, bird):
    life.change(minds.thinks_of(life.agent, bird))
    path = [life.world_state.scene.position.copy()]
    while math.dist(path[-1], bird) >= REACH and len(path) <= PATIENCE:
        life.advance(1)
        path.append(life.world_state.scene.position.copy())
    return np.array(path)
