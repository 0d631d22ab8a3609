"""The user's code in a saved file: a digest of each part, and what stands for a part whose code has changed.

A file names kernels and worlds of the user's (`neorl.description`), while the code of a name may change, or be that of
another program whose ``__main__`` has the same name. So a file also holds a digest of each part, with all that it looks
up (`neorl.kernels.identity`). A run goes on with the same code alone. A result is read in any case: a former kernel or
a `FormerWorld` takes the place of each part that has changed or cannot be found.
"""

import json
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from neorl.common import checks
from neorl.core.scene import Actions
from neorl.description import described, restored, users_parts
from neorl.kernels.identity import digest_of, name_of
from neorl.kernels.kernel import Kernel, kernel_maker
from neorl.worlds.world import World

GONE = "{} must have the code that a saved result was computed with to be run, but has not: use the present code's"


@dataclass(frozen=True, kw_only=True)
class FormerWorld(World):
    """What a saved result knows of its world without the world's code, by which it cannot be run.

    name: of the world's class, "module:name". digest: of its code. data: the world as plain data, in JSON. The other
    fields are the world's.
    """

    name: str
    digest: str
    data: str
    kinds: tuple[str, ...]
    actions: Actions
    things: int
    size: float
    fps: float

    @property
    def State(self) -> type:
        """None: raises ValueError."""
        raise ValueError(GONE.format(self.name))


class FormerKernel(Kernel):
    """A kernel that is not compiled."""

    def _present(self, name):
        return self.py_func()


@kernel_maker
def former_kernel(name: str, digest: str) -> Callable[..., Any]:
    """What a saved result knows of a kernel, by which it cannot be run: its name, "module:name", and its digest."""
    def refuse(*arguments):
        raise ValueError(GONE.format(name))

    return FormerKernel(refuse, is_inlined=False)


def check_present(*kernels):
    """Raise ValueError if a kernel has no code."""
    for each in kernels:
        if isinstance(each, FormerKernel):
            each.py_func()


def code_of(data, value):
    """The code of each part of the user's in plain data: {path: {"digest": …}}, with what stands for the world.

    value: what the data describe, which has a world. Raises ValueError for code that cannot be read.
    """
    code = {path: {"digest": digest_of(restored(table))} for path, _, table in users_parts(data)}
    if "world" in code:
        code["world"] |= {name: described(checks.plain(getattr(value.world, name)))
                          for name in ("kinds", "actions", "things", "size", "fps")}
    return code


def changes(data, code):
    """How the user's parts in plain data differ from their `code` when they were saved: {path: clause}.

    Raises ValueError for a part that is not in the code.
    """
    found = {}
    for path, name, table in users_parts(data):
        if path not in (code or ()):
            raise ValueError(f"the digest of {path} ({name}) must be in the file, but is not: an earlier neorl has "
                             "written it; read its arrays with numpy.load")
        try:
            if digest_of(restored(table)) != code[path]["digest"]:
                found[path] = f"{path} ({name}) has changed, or another Python has compiled it"
        except Exception as error:  # of any class: the user's code is run
            found[path] = f"{path} ({name}) cannot be found: {error}"
    return found


def stand_in(data, code, paths):
    """Let former kernels and worlds take the place of the parts at some paths of plain data."""
    for path, name, table in [each for each in users_parts(data) if each[0] in paths]:
        former = ({"is": name_of(FormerWorld), "name": name, "data": json.dumps(table), **code[path]}
                  if path == "world" else {"kernel": name_of(former_kernel), "of": [name, code[path]["digest"]]})
        table.clear()
        table.update(former)
