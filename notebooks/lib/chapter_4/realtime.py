"""A run in real time: steps are due by the clock, and their cost is measured (claim T5).

1. Step k begins k / fps seconds after the first, or, if the step before it is not done by then, as soon as it is.
2. A step is in time if it is done before the next one is due. Its *delay* is the time from its due time until it is
   done, in steps: up to 1 is in time.
3. Time is cut into windows. The *load* of a window is the processor time of the whole process in it, over all threads,
   divided by the length of the window: 1 is a core that is never idle.
"""

import os
import time
from typing import NamedTuple

import numpy as np

from neorl import checks


class Pace(NamedTuple):
    """How well a run kept up with the clock."""

    load: np.ndarray  # of each window, in cores: float64 (windows,)
    delay: np.ndarray  # of each step, in steps: float64 (windows, steps per window)


def busy():
    """Processes ready to run on a core of the machine, on average over the last minute; None if it is not known."""
    return os.getloadavg()[0] / os.cpu_count() if hasattr(os, "getloadavg") else None


def keep_pace(run, windows, seconds):
    """Advance a `Run` in real time, and return its `Pace`.

    windows: integer ≥ 1. seconds: length of a window, at least a step of the run's world.
    Raises ValueError for anything else.
    """
    fps = run.world.fps
    checks.integer("windows", windows, at_least=1)
    checks.real("seconds", seconds, 1 / fps)
    steps = round(seconds * fps)
    load, delay = np.empty(windows), np.empty((windows, steps))
    begin = time.monotonic()
    for window in range(windows):
        begun, used = time.monotonic(), time.process_time()
        for step in range(steps):
            due = begin + (window * steps + step) / fps
            time.sleep(max(0.0, due - time.monotonic()))
            run.advance(1)
            delay[window, step] = (time.monotonic() - due) * fps
        # The last step's idle time belongs to its window.
        time.sleep(max(0.0, begin + (window + 1) * steps / fps - time.monotonic()))
        load[window] = (time.process_time() - used) / (time.monotonic() - begun)
    return Pace(load, delay)
