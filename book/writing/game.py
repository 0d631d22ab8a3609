"""The game below the star: twenty seconds of a reader beside an experienced agent, and half-way red becomes good.

1. Two tanks begin alike. In one the agent of the star acts, which has had its lesson and learns no more; in the other a
   reader, who is pushed as the agent is.
2. From half of the steps on, red discs are as good as green ones, to both. Nobody is told; discs carry signs.
3. The page (`game.js`) runs both; `round_of_agent` is the agent's part in Python.
"""

from dataclasses import replace
from pathlib import Path

import neorl
from neorl.browser.explorer import parameters_in_page
from writing.star import AGENT, LESSON, SEED, TANK

LESSON_SEED = SEED + 1  # as the star's agent has
STEPS = 20 * TANK.fps
BOOK = Path(__file__).parents[1]


def wants():
    """The agent, which learns no more, before and after red discs become good."""
    before = replace(AGENT, learning=replace(AGENT.learning, learning_rate=0.0))
    return before, replace(before, desires=[replace(desire, valence=1.0) for desire in before.desires])


def round_of_agent(board, lesson=LESSON):
    """What the agent meets in a round on a board, (halves, kinds). board: integer ≥ 0, the seed of the tank."""
    teacher, (before, after) = neorl.Run(AGENT, TANK, LESSON_SEED), wants()
    teacher.advance(lesson)
    run = neorl.Run(before, TANK, board)
    run.transfer(teacher)
    first = run.record(STEPS // 2).hits.sum(axis=0)
    run.change(after)
    return first, run.record(STEPS // 2).hits.sum(axis=0)


def data():
    """What the page needs of the game besides the star's, ready for JSON."""
    return {"game": [parameters_in_page(agent, TANK) for agent in wants()], "lesson_seed": LESSON_SEED, "steps": STEPS}


def markup(lesson=LESSON):
    """The game's part of the page, as HTML."""
    return (BOOK / "game.html").read_text(encoding="utf-8").replace("{lesson}", f"{lesson // 60 // TANK.fps}")
