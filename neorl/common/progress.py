"""Progress bars, in a terminal or a notebook, or by a function of the user's."""

import contextlib
import sys
import threading

from neorl.common import checks


def progress_bar(steps, name, shown):
    """A progress bar over steps, with the time left at the pace so far, or a `Report` to a function.

    Raises ValueError unless `shown`, the caller's argument `progress`, is True, False or a function.
    """
    from tqdm import tqdm

    if callable(shown):
        return Report(shown, steps)
    if not isinstance(checks.plain(shown), bool):
        raise checks.error("progress", "True, False or a function that takes the steps done and their total", shown)
    watched = _watched_output()
    return tqdm(total=steps, desc=name, unit="step", unit_scale=True, leave=False, file=watched,
                disable=not shown or watched is None)


def _watched_output():
    """Standard error if it is a terminal, the output of a notebook whose front end can be asked for input, or None.

    What papermill, nbconvert or a build runs cannot be asked, and records its output. In a notebook, standard error
    would leave a red bar behind.
    """
    ipython = sys.modules.get("IPython")
    shell = ipython and ipython.get_ipython()
    if hasattr(shell, "get_parent"):  # of a kernel
        return sys.stdout if shell.get_parent().get("content", {}).get("allow_stdin", True) else None
    return sys.stderr if sys.stderr is not None and sys.stderr.isatty() else None


class Report(contextlib.nullcontext):
    """A progress bar whose display is a function (done, total) of the user's."""

    def __init__(self, function, total):
        super().__init__(self)
        self.function, self.total, self.done, self.lock = function, total, 0, threading.Lock()

    def set_description(self, text):
        """Do nothing: the function takes numbers."""

    def update(self, steps):
        """Count more steps, and call the function."""
        with self.lock:
            self.done += steps
            self.function(self.done, self.total)
