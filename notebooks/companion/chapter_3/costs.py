"""What claims T3 and T4 are about: learners that remember some of the symbols that matter, and learners in grids.

What learners run is given as in `decision.Experience.ran`; they take `STEPS` steps.
"""

from companion.chapter_3 import decision
from companion.shared.tabular import Rates

STEPS = 100_000
MEMORY = 6  # symbols that matter
SIDES = (3, 4, 6, 8, 10, 13)  # of grids


def remembering(seed):
    """What T3 is about: {rule: [what was run, for each length of memory, from none to all]}."""
    return {rule: [(decision.mechanism(2, MEMORY, rule, seed), tuple(decision.window(2, MEMORY, length).tolist()),
                    Rates(0.0, 0.0, 0.1)) for length in range(MEMORY + 1)] for rule in ("sum", "table")}


def crossing():
    """What T4 is about: {side of a grid: what was run}."""
    return {side: (decision.reaching(decision.lattice(side, 2), {side**2 - 1: 1.0}, slip=0.2),
                   tuple(range(side**2)), Rates(0.0, 0.9, 1.0)) for side in SIDES}
