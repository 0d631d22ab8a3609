"""The Replay: a widget that replays recorded runs side by side and in step, in JupyterLab and in a static page.

It computes nothing: the recordings are in its state, and `replay.js` draws them in the Explorer's style.
"""

import numpy as np

from neorl import checks
from neorl.browser.explorer import AnyWidget, _text, traitlets
from neorl.experiments.recording import Recording

FRAMES_A_SECOND = 25
FINENESS = 1_000  # positions are stored as integers, in this fraction of a board


class Replay(AnyWidget):
    """Recorded runs side by side.

    recordings: one or more `Recording`, all of the same length and steps per second.
    playing: whether it starts to play when it comes into view. With reduced motion, playback is started by a button.
    speed: recorded seconds per second of playback, an integer ≥ 1.

    Raises ValueError for anything else.
    """

    _esm = _text("drawing.js", "movers.js", "replay.js")
    _css = _text("widget.css")
    _recordings = traitlets.List().tag(sync=True)

    playing = traitlets.Bool(True).tag(sync=True)
    speed = traitlets.Int(1).tag(sync=True)

    def __init__(self, recordings, playing=True, speed=1):
        recordings = [checks.instance("recordings", each, Recording)
                      for each in checks.several("recordings", recordings)]
        if len({(len(each.agent), each.fps) for each in recordings}) != 1:
            raise ValueError("recordings must be one or more, of the same length and steps per second, but are of "
                             f"{[len(each.agent) - 1 for each in recordings]} steps")
        speed = checks.integer("speed", speed, at_least=1)
        super().__init__(_recordings=[_thinned(each, speed) for each in recordings], playing=playing, speed=speed)


def _thinned(recording, speed):
    """A recording in the page's format: a subset of its frames, with positions as integers."""
    frames = np.arange(0, len(recording.agent), max(1, speed * recording.fps // FRAMES_A_SECOND))
    return {"name": recording.name, "radius": recording.radius, "fineness": FINENESS,
            "seconds": (frames / recording.fps).tolist(), "hits": recording.hits[frames].tolist(),
            "green": recording.green[frames].astype(int).tolist(),
            "agent": (FINENESS * recording.agent[frames]).round().astype(int).tolist(),
            "creeps": (FINENESS * recording.creeps[frames]).round().astype(int).tolist()}
