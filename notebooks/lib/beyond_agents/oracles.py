"""The gap between the forager and a planner with the exact model, split by planners that lack parts of its knowledge.

1. All plan in the same way (`lib.alternatives.controllers`). Those of one capture look no further than the
   next green creep, as the forager does; they have perfect control to a point.
2. *still*: creeps stand still in the model. The gain of a planner without this flaw is the worth of perfect prediction.
3. *red ignored*: the model has no red creeps. The gain of a planner without this flaw is the worth of perfect
   avoidance. For the forager, to ignore red is to give it a valence of 0.
4. A planner does not learn, so its runs have `PLANNED` of the steps of a forager's, of which the last third counts.
"""

import numpy as np

from lib.alternatives.contestants import PLANNED
from lib.alternatives.controllers import planner
from lib.alternatives.living import BOARDS, live
from lib.alternatives.search import best_settings
from neorl import checks
from neorl.agents.beyond import forager
from neorl.experiments.cache import Condition
from neorl.experiments.sweeping import sweep

FORAGER, BLIND_FORAGER = "forager", "forager, red ignored"
CONTROL, STILL_CONTROL = "perfect control, red ignored", "perfect control, red ignored, still"
AVOIDANCE, STILL_AVOIDANCE = "perfect control and avoidance", "perfect control and avoidance, still"
TWO, ALL = "two captures ahead", "all captures ahead"
ORACLES = {STILL_CONTROL: {"captures": 1, "moving": False, "avoiding": False},
           CONTROL: {"captures": 1, "avoiding": False},
           STILL_AVOIDANCE: {"captures": 1, "moving": False},
           AVOIDANCE: {"captures": 1}, TWO: {"captures": 2}, ALL: {}}


def rates_of_oracles(creeps, steps, runs, seed=0):
    """Reward per second of foragers and planners on a board of 3 or 8 creeps: {name: float64 (runs,)}."""
    checks.one_of("creeps", creeps, tuple(BOARDS))
    board, watched = BOARDS[creeps], max(1, round(PLANNED * steps))
    agents = {BLIND_FORAGER: forager(valence_red=0.0), FORAGER: forager()}
    results = sweep([Condition(agent, board, steps, runs, seed) for agent in agents.values()], progress=False)
    rates = {name: result.rate(2 / 3, 1.0) for name, result in zip(agents, results)}
    gains = best_settings()["PD"]
    for name, lacking in ORACLES.items():
        lived = live(planner(gains, **lacking), board, steps=watched, runs=runs, bins=1, seed=seed)
        rates[name] = lived.rewards[:, 0] / (watched / board.fps)
    return rates


def rates_by_creeps(steps, runs, seed=0):
    """The same on both boards: {creeps: {name: float64 (runs,)}}."""
    return {creeps: rates_of_oracles(creeps, steps, runs, seed) for creeps in BOARDS}


def gaps(rates):
    """The parts of the gap between forager and planner, in reward per second of each run: {name: float64 (runs,)}.

    They add up to the whole gap between the forager and the planner that looks ahead to all captures.
    """
    return {"control to a point": rates[STILL_CONTROL] - rates[BLIND_FORAGER],
            "prediction of creeps": rates[CONTROL] - rates[STILL_CONTROL],
            "avoidance of red creeps": (rates[AVOIDANCE] - rates[CONTROL]) - (rates[FORAGER] - rates[BLIND_FORAGER]),
            "looking beyond the next capture": rates[ALL] - rates[AVOIDANCE]}


def shares(rates):
    """Each part of the gap as a share of the whole, means over runs: {name: share}."""
    whole = np.mean(rates[ALL] - rates[FORAGER])
    return {name: float(np.mean(gap) / whole) for name, gap in gaps(rates).items()}
