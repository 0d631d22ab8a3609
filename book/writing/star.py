"""The star: an agent with experience, and a place that it comes to want, for the front page and the README.

1. Two agents run in tanks that begin alike: one has learned for `LESSON` in a run of another seed, and the other has
   learned nothing. From then on both act and learn no more, so that what they do is what the lesson is worth: one that
   learned on would come to find the star, too.
2. Both want the star, an element of interest at a place, besides the green creeps. No reward is ever paid for it.
3. The page (`star.js`) runs them in the reader's browser; `experienced` and `with_star` are the same runs in Python.
"""

from dataclasses import replace
from html import escape
from pathlib import Path

import neorl
from neorl.browser.explorer import parameters_in_page, world_in_page

AGENT, TANK = neorl.multimodal(), neorl.WaterWorld()
SEED = 19  # the distances of both agents to the star, on the page and in the picture, are near the medians of 24 seeds
LESSON = 100 * 60 * TANK.fps  # steps
VALENCE = 2.0  # of the star; green creeps have 1, red ones −1
START = (0.8, 0.2)  # of the star
BOOK = Path(__file__).parents[1]
TITLE = "A tank with an agent, and green and red discs; the path of the agent ends at a star."


def with_star(agent, place):
    """An agent that learns no more, and also wants to be at a place, in board widths from the upper left corner."""
    star = neorl.Place(*place)
    wants = [neorl.Desire(star, node.name, VALENCE) for node in agent.nodes]
    return replace(agent, desires=(*agent.desires, *wants), learning=replace(agent.learning, learning_rate=0.0))


def experienced(place=START, lesson=LESSON):
    """The run of the experienced agent when the reader meets it, with the star at a place: a `neorl.Run`."""
    learner = neorl.Run(AGENT, TANK, SEED + 1)
    learner.advance(lesson)
    run = neorl.Run(with_star(AGENT, place), TANK, SEED)
    run.transfer(learner)
    return run


def data(lesson=LESSON):
    """What the page needs of the star, ready for JSON."""
    return {"lesson": lesson, "seed": SEED, "valence": VALENCE, "star": dict(zip("xy", START)),
            "parameters": parameters_in_page(AGENT, TANK), "world": world_in_page(TANK),
            "red": [e for e, desire in enumerate(AGENT.desires) if desire.source == "red"]}


def markup():
    """The star's part of the page, as HTML, with a picture for readers without scripts."""
    return (BOOK / "star.html").read_text(encoding="utf-8").replace("{title}", escape(TITLE))
