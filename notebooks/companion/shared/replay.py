"""The Replay: a widget that replays runs in WaterWorld side by side and in step, in JupyterLab and in a static page.

It computes nothing: the runs, recorded step by step, are in its state, and `replay.js` draws them in the Explorer's
style.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from neorl.browser.explorer import text_of, traitlets
from neorl.browser.figure import Figure, discs
from neorl.common import checks
from neorl.experiments.bins import new_bins
from neorl.experiments.run import Run
from neorl.worlds.waterworld import GREEN, WaterWorld

FRAMES_A_SECOND = 25
FINENESS = 1_000  # positions are stored as integers, in this fraction of a board


@dataclass(frozen=True, eq=False)
class Recording:
    """The movements and captures in a tank, step by step, in board widths and seconds."""

    name: str
    fps: int
    radius: float
    agent: NDArray[np.float32]  # (steps + 1, 4): position and velocity
    creeps: NDArray[np.float32]  # (steps + 1, creeps, 4)
    green: NDArray[np.bool]  # (steps + 1, creeps)
    hits: NDArray[np.int64]  # (steps + 1, 2): green and red creeps taken so far

    __eq__ = checks.equal_fields


def record(name: str, run: Run, steps: int) -> Recording:
    """Advance a run by `steps` steps, and return the `Recording`, called `name`.

    run: a `neorl.Run` in `neorl.WaterWorld`, which is advanced. steps: integer ≥ 1.
    Raises ValueError for anything else.
    """
    steps = checks.integer("steps", steps, at_least=1)
    checks.instance("world of run", checks.instance("run", run, Run).world, WaterWorld)
    scale, frames, taken = 1 / run.world.width, [], np.zeros(2, np.int64)
    rewards, hits = new_bins(run.world, 1, run.step + steps)
    for step in range(steps + 1):
        if step:
            hits[:] = 0
            run.advance(1, rewards[0], hits[0])
            taken = taken + hits[0].sum(axis=0)
        state = run.world_state
        scene, velocity = state.scene, state.direction * state.speed[:, None]
        frames.append((np.concatenate([scene.position, scene.velocity]) * scale,
                       np.hstack([scene.things, velocity]) * scale, scene.kinds == GREEN, taken))
    agent, creeps, green, hits = map(np.array, zip(*frames))
    return Recording(name, run.world.fps, run.world.radius * scale, agent.astype(np.float32),
                     creeps.astype(np.float32), green, hits)


class Replay(Figure):
    """Recorded runs side by side.

    recordings: one or more `Recording`, all of the same length and steps per second.
    playing: whether it starts to play when it comes into view. With reduced motion, playback is started by a button.
    speed: recorded seconds per second of playback, an integer ≥ 1.

    Raises ValueError for anything else.
    """

    _esm = text_of("elements.js", "drawing.js", "movers.js", Path(__file__).with_name("replay.js"))
    _css = text_of("widget.css")
    _recordings = traitlets.List().tag(sync=True)

    playing = traitlets.Bool(True).tag(sync=True)
    speed = traitlets.Int(1).tag(sync=True)

    def __init__(self, recordings, playing=True, speed=1):
        recordings = [checks.instance("recordings", each, Recording)
                      for each in checks.several("recordings", recordings)]
        if len({(len(each.agent), each.fps) for each in recordings}) != 1:
            raise ValueError("recordings must be one or more, of the same length and steps per second, but are of "
                             f"{[len(each.agent) - 1 for each in recordings]} steps")
        playing, speed = checks.flag("playing", playing), checks.integer("speed", speed, at_least=1)
        super().__init__(_recordings=[_thinned(each, speed) for each in recordings], playing=playing, speed=speed)

    def _sentence(self):
        names = " and ".join(each["name"] for each in self._recordings)
        seconds = self._recordings[0]["seconds"][-1]
        return f"A replay of {seconds:g} second{'' if seconds == 1 else 's'} of {names}."

    def _drawn(self):
        first = self._recordings[0]
        kinds = ["agent", *("green" if green else "red" for green in first["green"][-1])]
        return discs(np.array([first["agent"][-1], *first["creeps"][-1]]) / FINENESS, kinds, first["radius"])


def _thinned(recording, speed):
    """A recording in the page's format: a subset of its frames, with positions as integers."""
    frames = np.arange(0, len(recording.agent), max(1, speed * recording.fps // FRAMES_A_SECOND))
    return {"name": recording.name, "radius": recording.radius, "fineness": FINENESS,
            "seconds": (frames / recording.fps).tolist(), "hits": recording.hits[frames].tolist(),
            "green": recording.green[frames].astype(int).tolist(),
            "agent": (FINENESS * recording.agent[frames]).round().astype(int).tolist(),
            "creeps": (FINENESS * recording.creeps[frames]).round().astype(int).tolist()}
