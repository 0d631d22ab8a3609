"""The Steering: a widget in which the reader drags a goal, and walkers go there by what an agent has learned.

After watching, nothing is learned any more, so all that steers are the desire vectors of its maps, one for each cell
and goal. They are in the widget's state, computed from the agent's values; `steering.js` adds them up, and walks as
`companion.recordings.ways.walk` does in an open box.
"""

from pathlib import Path

import numpy as np

from companion.recordings import pilots, ways
from neorl.browser.explorer import text_of, traitlets
from neorl.browser.figure import Figure, discs

FRAMES = 6  # of the recording, of which one is drawn
FINENESS = 1_000  # positions of the recording are stored as integers, in this fraction of the box
GOAL = (0.5, 0.5)  # at first


def vectors_of(learner, index):
    """The part of a map in the desire vector, float32 (cells, goals, 2), for one thing of valence 1; 0 in its cell."""
    weights = np.concatenate([np.square(node.resolutions) for node in learner.agent.nodes])
    pushes = np.array(learner.world.actions.pushes)
    vectors = np.einsum("sag,ax->sgx", learner.q(index), pushes) * weights[index] / weights.sum()
    vectors[np.arange(len(vectors)), np.arange(len(vectors))] = 0.0
    return vectors.astype(np.float32)


class Steering(Figure):
    """Ways from some places to a goal that the reader drags, over the path that an agent has watched.

    learner: a `pupil` of the path, (steps + 1, 2), whose frames are missing where `missing` says. starts: (ways, 2).
    noise: (ways, steps, 2), of standard deviation 1.
    """

    _esm = text_of("elements.js", "drawing.js", Path(__file__).with_name("steering.js"))
    _css = text_of("widget.css", Path(__file__).with_name("steering.css"))
    _watched = traitlets.List().tag(sync=True)
    _maps = traitlets.List().tag(sync=True)
    _walk = traitlets.Dict().tag(sync=True)

    def __init__(self, learner, path, missing, starts, noise):
        seen = np.insert(path, np.flatnonzero(missing) + 1, np.nan, axis=0)[::FRAMES]
        drawn = [None if np.isnan(place).any() else (FINENESS * place).round().astype(int).tolist() for place in seen]
        maps = [{"side": resolution, "vectors": vectors_of(learner, index).tobytes()}
                for index, resolution in enumerate(learner.agent.nodes[0].resolutions)]
        walk = {"starts": np.asarray(starts).tolist(), "noise": noise.astype(np.float32).tobytes(), "goal": GOAL,
                "step": ways.SPEED * ways.SECONDS, "near": ways.NEAR, "sway": ways.NOISE, "clear": ways.CLEAR}
        super().__init__(_watched=drawn, _maps=maps, _walk=walk)

    def _sentence(self):
        return (f"Ways from {len(self._walk['starts'])} places to a goal that can be dragged, by what an agent has "
                "learned from the path of a rat.")

    def _drawn(self):
        places = [*self._walk["starts"], self._walk["goal"]]
        return discs(places, ["agent"] * len(self._walk["starts"]) + ["green"], 0.02)


def of_rat(resolutions, minutes=10, number=8, seed=0):
    """The `Steering` by what an agent with these maps has learned from the minutes of a rat."""
    path, missing = ways.rat(minutes)
    rng = np.random.default_rng(seed)
    learner = pilots.pupil(path, resolutions, ends=missing)
    starts = rng.uniform(0.05, 0.95, (number, 2))
    return Steering(learner, path, missing, starts, rng.normal(size=(number, ways.LIMIT, 2)))
