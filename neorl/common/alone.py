"""One caller at a time: what an object's kernels write belongs to one call, until that returns.

A call within a call, such as by a function that the first one calls back, is refused as a second thread's is: what both
write would belong to neither.
"""

import contextlib
import threading
from collections.abc import Iterator


class Alone:
    """The flag of one object. remedy: what the caller can do instead of a call within a call, a clause."""

    def __init__(self, remedy: str) -> None:
        self._lock, self._thread, self._remedy = threading.Lock(), 0, remedy

    def __reduce__(self):  # in a copy, no call is going on
        return Alone, (self._remedy,)

    @contextlib.contextmanager
    def call(self, what: str) -> Iterator[None]:
        """Within this context, every other call is refused. Raises RuntimeError if one is going on."""
        if not self._lock.acquire(blocking=False):
            self.check(what)
        self._thread = threading.get_ident()
        try:
            yield
        finally:
            self._thread = 0
            self._lock.release()

    def check(self, what: str, called_back: bool = False) -> None:
        """Raise RuntimeError if another call is going on. called_back: whether it may have called this one."""
        if not self._lock.locked() or called_back and self._thread == threading.get_ident():
            return
        if self._thread == threading.get_ident():
            raise RuntimeError(f"{what} must not be called before the call that is going on has returned: "
                               f"{self._remedy}")
        raise RuntimeError(f"{what} must not be called while another thread's call is going on; give each thread an "
                           "object of its own, such as a copy")
