"""Agents and worlds as plain data, ready for JSON, and back.

A frozen dataclass becomes {"is": "module:name", field: value, …}; a kernel becomes {"kernel": "module:name"}, or, if a
function of the user's has made it (`neorl.kernel_maker`), {"kernel": "module:name of the function", "of": arguments}.
So what it describes can be made again wherever these modules can be imported.
"""

import importlib
from dataclasses import fields, is_dataclass

from neorl.core.identity import name_of


def described(value):
    """A value as plain data. Raises ValueError for a kernel that no module has."""
    if is_dataclass(value):
        kind = type(value)
        return {"is": name_of(kind), **{each.name: described(getattr(value, each.name)) for each in fields(kind)}}
    if isinstance(value, tuple | list):
        return [described(each) for each in value]
    if callable(value):
        origin, arguments = getattr(value, "origin", (value, None))
        if _find(name_of(origin)) is not origin:
            raise ValueError(f"{value!r} cannot be saved, allowed are kernels that a module defines or that a "
                             "neorl.kernel_maker has made")
        return {"kernel": name_of(origin)} | ({} if arguments is None else {"of": described(arguments)})
    return value


def restored(data):
    """What plain data describe. Raises ValueError if that cannot be."""
    if isinstance(data, list):
        return tuple(restored(each) for each in data)
    if not isinstance(data, dict):
        return data
    found = _find(data.get("is") or data.get("kernel"))
    if "is" not in data:
        if "of" in data and not getattr(found, "makes_kernels", False):  # a file may name any function
            raise ValueError(f"{data['kernel']} is {found!r}, allowed is what a neorl.kernel_maker makes of a function")
        return found(*restored(data["of"])) if "of" in data else found
    if not is_dataclass(found):
        raise ValueError(f"{data['is']} is {found!r}, allowed are dataclasses")
    return getattr(found, "of_fields", found)(**{name: restored(each) for name, each in data.items() if name != "is"})


def _find(name):
    module, _, inner = str(name).partition(":")
    try:
        return getattr(importlib.import_module(module), inner)
    except (ImportError, AttributeError, ValueError):
        return None
