"""Warnings that point at the user's line, by which this package was called."""

import functools
import sys
import threading
import warnings
from types import FrameType

# Packages whose lines may lie between that line and this package.
BETWEEN = {"neorl", "numba", "gymnasium", "concurrent", "contextlib", "threading"}
_thread = threading.local()


def warn(message):
    """Issue a RuntimeWarning."""
    frame = users_frame() or vars(_thread).get("caller") or sys._getframe(1)
    warnings.warn_explicit(message, RuntimeWarning, frame.f_code.co_filename, frame.f_lineno,
                           frame.f_globals.get("__name__"), frame.f_globals.setdefault("__warningregistry__", {}))


warn_once = functools.cache(warn)  # in a process


def users_frame() -> FrameType | None:
    """The innermost frame of the user's, or None in a thread of this package's own."""
    frame: FrameType | None = sys._getframe(1)
    while frame and str(frame.f_globals.get("__name__")).partition(".")[0] in BETWEEN:
        frame = frame.f_back
    return frame


def work_for(frame):
    """Let the warnings of this thread point at a frame of another thread: that of the user who waits for it."""
    _thread.caller = frame
