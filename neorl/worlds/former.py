"""The user's code in a saved file: its identity when it was saved, and what stands for it once it has changed.

A file names kernels and worlds of the user's (`neorl.description`), while the code of a name may change, or be that of
another program whose ``__main__`` has the same name. So a file also holds digests of each part's code, with all that it
looks up (`neorl.kernels.identity`). A run goes on with the same code alone. A result is read in any case: a former
kernel or a `FormerWorld` takes the place of each part that has changed or cannot be found.
"""

import hashlib
import json
import re
from collections.abc import Callable
from dataclasses import dataclass
from sys import version_info
from typing import Any

from neorl.core.scene import Actions
from neorl.description import MAIN, described, main_program, restored, users_parts
from neorl.kernels.annotations import new_tuple
from neorl.kernels.identity import identity
from neorl.kernels.kernel import Kernel, kernel_maker
from neorl.worlds.world import World

GONE = "{} must have the code that a saved result was computed with to be run, but has not: use the present code's"
PYTHON = f"{version_info.major}.{version_info.minor}"


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
    """The code of each part of the user's in a value: {path: table}. data: the value as plain data.

    Raises ValueError for code that cannot be read.
    """
    parts = [(path, name, table, _within(value, path)) for path, name, table in users_parts(data)]
    return {path: _saved(name, table, part) for path, name, table, part in parts if callable(part)
            or isinstance(part, World)}  # other objects count by what their world takes from them


def changes(data, code):
    """How the user's parts in plain data differ from their `code` when they were saved: {path: clause}.

    Raises ValueError if code is None, since it was not saved.
    """
    parts = list(users_parts(data))
    if code is None and parts:
        raise ValueError(f"the digests of {parts[0][1]} must be in the file, but are not: an earlier neorl has written "
                         "it; read its arrays with numpy.load")
    found = {path: _change(name, table, code[path]) for path, name, table in parts if path in code}
    return {path: f"{path} {clause}" for path, clause in found.items() if clause}


def stand_in(data, code, paths):
    """Let former kernels and worlds take the place of the parts at some paths of plain data."""
    for path, _, table in list(users_parts(data)):
        if path in paths:
            table.clear()
            table.update(code[path]["former"])


def _saved(name, table, part):
    digests = _digests(part)
    digest = hashlib.sha256(json.dumps(digests).encode()).hexdigest()
    former = FormerWorld(
        name=name, digest=digest, data=json.dumps(table), kinds=tuple(part.kinds), actions=part.actions,
        things=int(part.things), size=float(part.size), fps=float(part.fps)) if isinstance(part, World) else (
        former_kernel(name, digest))
    return {"digests": digests, "python": PYTHON, "program": name.startswith(MAIN) and main_program(),
            "former": described(former)}


def _digests(part):
    """Digests of all that a run takes from a world besides its fields, by name; of a kernel, of its code."""
    determinants = part.dynamics._asdict() | {
        "rules": part.rules, "kinds": tuple(part.kinds), "actions": part.actions, "things": part.things,
        "size": part.size, "fps": part.fps, "state": new_tuple(part.State, part.sizes, {})} if isinstance(
        part, World) else {"code": part}
    return {name: hashlib.sha256(identity(each).encode()).hexdigest() for name, each in determinants.items()}


def _change(name, table, saved):
    """A clause on how a part differs from the one that was saved, or "" if it does not."""
    named = f"({name}, then of {saved['program']})" if name.startswith(MAIN) else f"({name})"
    try:
        now = _digests(restored(table))
    except Exception as error:  # of any class: the user's code is run
        return f"{named} cannot be found: {error}"
    changed = [each for each in now if now[each] != saved["digests"].get(each)]
    if changed and saved["python"] != PYTHON:
        return f"{named} cannot be compared: Python {saved['python']} has compiled it, and this is {PYTHON}"
    return changed and f"{named} has changed" + f" in its {', '.join(changed)}" * ("code" not in now)


def _within(value, path):
    """The part of a value at a path of its plain data."""
    for key in re.findall(r"\w+", path):
        if isinstance(value, tuple | list):
            value = value[int(key)]
        else:  # the field of a dataclass, or the arguments of a kernel that was made
            value = value.origin[1] if key == "of" and hasattr(value, "origin") else getattr(value, key)
    return value
