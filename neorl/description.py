"""Agents, worlds and conditions as plain data, ready for TOML and JSON, and back.

- A frozen dataclass is a table of its fields, {field: value, …}. Where its place does not determine its type, as for a
  world, the table names it: {"is": "WaterWorld", …}. It may also name a function that makes an agent of the papers,
  with its arguments: {"is": "place_cells", "resolutions": [3, 7]}.
- A kernel is {"kernel": "module:name"}, or, if a function has made it (`neorl.custom.kernel_maker`),
  {"kernel": "module:name of the function", "of": arguments}.
- A text in place of a table is the name of a modality, "place cell", or of a constant, "module:NAME".
- A tuple is a list. None is left out where it is the default, since TOML cannot express it.

A name without a module is one that the package has given to `name_shortly`. A named module is imported, so a file can
run code just as a program can.
"""

import contextlib
import difflib
import functools
import importlib
import json
import os
import sys
from collections.abc import Iterator, Mapping
from dataclasses import MISSING, fields, is_dataclass
from os import PathLike
from types import UnionType
from typing import Any, Self, Union, get_args, get_origin, get_type_hints

import numpy as np

from neorl.common import checks
from neorl.common.extras import require
from neorl.common.files import write_whole
from neorl.common.warn import warn
from neorl.core.modality import MODALITIES
from neorl.kernels.identity import identity, name_of
from neorl.kernels.pickling import AGAIN

SUFFIXES = (".toml", ".json")
SHORT_NAMES: dict[str, Any] = {}  # what files name without a module
MAIN = "__main__:"  # before the names of what the running program defines
PLAIN = {bool: "true or false", int: "an integer", float: "a number", str: "a text", type(None): "None"}


class Described:
    """A frozen dataclass that can be written as plain data, and read back as an equal value with the same key."""

    def to_dict(self) -> dict[str, Any]:
        """The value as plain data, see `neorl.description`.

        Raises ValueError for values that cannot be found by name, such as a kernel defined in a function, or that are
        not plain data.
        """
        return described(self)

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Self:
        """The value described by plain data.

        data: as `to_dict` returns them; fields with a default may be left out.

        Raises ValueError for anything else, with the path to it, such as "nodes[0].resolutions is (), …".
        """
        try:
            return checked(restored(data, cls), cls)
        except RecursionError:
            raise ValueError("data must be nested less deeply than these to be described") from None

    def save(self, path: str | PathLike[str]) -> None:
        """Write the value to a file.

        path: a name that ends in .toml, which needs the package tomli-w, or .json.
        Raises ValueError for any other name, and for values that `to_dict` refuses. Warns of what stands in
        ``__main__``, which other programs cannot read again.
        """
        (file, suffix), data = _file(path), self.to_dict()
        if suffix == ".json":
            text = json.dumps(data, indent=1, ensure_ascii=False, allow_nan=False)
        else:
            try:
                text = require("tomli_w", extra="data").dumps(data)
            except TypeError as error:  # None
                raise ValueError(f"{path} cannot be written: {error}; choose a name that ends in .json") from error
        write_whole(file, text.encode())
        warn_of_main(path, data)

    @classmethod
    def load(cls, path: str | PathLike[str]) -> Self:
        """The value described by a file.

        path: a name that ends in .toml or .json.
        Raises OSError if there is no such file, ValueError for data that `from_dict` refuses.
        """
        import tomllib  # here, so that importing the package stays fast

        file, suffix = _file(path)
        try:
            text = file.read_text(encoding="utf-8-sig")  # some editors begin with a mark
            if "\0" in text:  # of UTF-16 without a mark
                raise UnicodeError("it contains null characters")
            data = tomllib.loads(text) if suffix == ".toml" else json.loads(text)
        except UnicodeError as error:
            raise ValueError(f"{path} must be a text in UTF-8, but is not: {error}; save it as UTF-8") from error
        except (ValueError, RecursionError) as error:
            raise ValueError(f"{path} must be written in {suffix[1:].upper()}, but is not: {error}") from error
        if not isinstance(data, dict):
            raise checks.error(str(path), "a table of fields", data)
        try:
            return cls.from_dict(data)
        except ValueError as error:
            raise ValueError(f"{path}: {error}") from error


def name_shortly(*values):
    """Let files name classes and functions without their modules."""
    SHORT_NAMES.update((each.__name__, each) for each in values)


def _file(path):
    """A file, and the suffix of its name."""
    file = checks.path("path", path)
    if file.suffix.lower() in SUFFIXES:
        return file, file.suffix.lower()
    raise checks.error("path", f"a name that ends in {' or '.join(SUFFIXES)}", path)


def described(value, expected=object, path=""):
    """A value as plain data. expected: the type that its place implies, which need not be named.

    Raises ValueError for values that cannot be found by name, or that are not plain data.
    """
    if is_dataclass(value) and not isinstance(value, type):
        kind, given = type(value), {name: getattr(value, name) for name in _taken(type(value))}
        named = {} if kind in _options(expected) else {"is": _name(kind, path, value, lambda now: now(**given))}
        return named | {name: described(given[name], hint, _at(path, name))
                        for name, (hint, default) in _taken(kind).items()
                        if default is not None or given[name] is not None}
    if isinstance(value, tuple | list):
        return [described(each, hint, f"{path}[{i}]") for i, (each, hint) in enumerate(_members(value, expected))]
    if callable(value):
        if not hasattr(value, "origin"):
            return {"kernel": _name(value, path, value, lambda now: now)}
        make, arguments = value.origin
        return {"kernel": _name(make, path, value, lambda now: now(*arguments)), "of": described(arguments)}
    if type(value) in PLAIN:
        return value
    raise checks.error(path or "the value", "a number, a text, a tuple, a dataclass or a kernel to be saved", value)


def restored(data, expected=object, path=""):
    """The value described by plain data. expected: its type. Raises ValueError, with the path, if they do not fit."""
    if isinstance(data, np.generic) or isinstance(data, np.ndarray) and data.ndim == 0:
        return data.item()
    if isinstance(data, Mapping):
        return _kernel(data, path) if "kernel" in data else _instance(data, expected, path)
    if isinstance(data, list | tuple | np.ndarray):
        values = [restored(each, hint, f"{path}[{i}]") for i, (each, hint) in enumerate(_members(data, expected))]
        return values if list in map(get_origin, _options(expected)) else tuple(values)
    options = _options(expected)
    if isinstance(data, str) and str not in options and any(map(is_dataclass, options)):
        return _constant(data, options, path)
    if all(is_dataclass(each) or hasattr(each, "from_dict") for each in options):
        return checked(data, expected, path)
    return data


def users_parts(data: object, path: str = "") -> Iterator[tuple[str, str, dict]]:
    """The kernels and the objects of classes that are not neorl's in plain data: (path, name, table), outer ones first.

    Their names are "module:name".
    """
    inner = []
    if isinstance(data, dict):
        name = str(data.get("kernel", data.get("is")))
        if ":" in name and not name.startswith("neorl."):
            yield path, name, data
        inner = [(_at(path, key), each) for key, each in data.items()]
    elif isinstance(data, list):
        inner = [(f"{path}[{i}]", each) for i, each in enumerate(data)]
    for where, each in inner:
        yield from users_parts(each, where)


def warn_of_main(path, data):
    """Warn that what a file names of the running program's own can be read again by that program alone."""
    if names := ", ".join({name: None for _, name, _ in users_parts(data) if name.startswith(MAIN)}):
        warn(f"{path} can be read again by {main_program()} alone, where {names} stands: to read it elsewhere, move "
             "that to a module, import it from there, and save again")


def main_program():
    """The running program in words: its file, its notebook, or that it has neither."""
    return (getattr(sys.modules["__main__"], "__file__", None) or os.environ.get("JPY_SESSION_NAME")
            or "the program that saved it")


def _instance(data, expected, path):
    """The dataclass instance described by a table."""
    kind = _kind(data, expected, path)
    taken = kind.takes if hasattr(kind, "takes") else _taken(kind)
    for name in data:
        if name != "is" and name not in taken:
            raise checks.error(f"a field of {path or 'the data'}", checks.either(taken), name, _nearest(name, taken))
    values = {name: restored(data[name], taken[name][0], _at(path, name)) for name in taken if name in data}
    for name, (hint, default) in taken.items():
        if default is MISSING and name not in data:
            raise ValueError(f"{_at(path, name)} must be {_words(hint)}, but is missing")
    try:
        made = getattr(kind, "of_fields", kind)(**values)
    except (ValueError, TypeError) as error:
        within = str(error).partition(" ")[0] in taken
        raise ValueError(f"{path}{'.' if within else ': '}{error}" if path else str(error)) from error
    if is_dataclass(kind):
        for name, (hint, _) in taken.items():
            checked(getattr(made, name), hint, _at(path, name))
    return made


def _kind(data, expected, path):
    """The type described by a table: a dataclass, or a function that makes one."""
    options = [each for each in _options(expected) if isinstance(each, type) and each not in PLAIN]
    options_in_words = " or ".join(each.__name__ for each in options) or _words(expected)
    if "is" not in data:
        dataclasses = [each for each in options if is_dataclass(each)]
        if len(dataclasses) == 1:
            return dataclasses[0]
        if not options:
            raise checks.error(path, options_in_words, data)
        raise ValueError(f"{_at(path, 'is')} must be the name of a kind of {options_in_words}, but is missing")
    kind = _found(data["is"], _at(path, "is"))
    made = getattr(kind, "makes", kind)
    if isinstance(made, type) and is_dataclass(made) and issubclass(made, tuple(options)):
        return kind
    raise checks.error(_at(path, "is"), f"the name of a kind of {options_in_words}", data["is"])


def _kernel(data, path):
    """The kernel described by a table."""
    found = _found(data["kernel"], _at(path, "kernel"))
    for name in data.keys() - {"kernel", "of"}:
        raise ValueError(f"the fields of {path or 'a kernel'} must be 'kernel' and 'of', but {name!r} is among them")
    if "of" not in data:
        return found
    if not getattr(found, "makes_kernels", False):  # a file may name any function
        raise checks.error(_at(path, "kernel"), "a neorl.custom.kernel_maker, since of is given", data["kernel"])
    try:
        return found(*restored(data["of"], object, _at(path, "of")))
    except (ValueError, TypeError) as error:
        raise ValueError(f"{_at(path, 'of')} is {checks.shown(data['of'])}: {error}") from error


def _constant(name, options, path):
    """The value of a name, which is of one of the types."""
    modalities = {each.name: each for each in MODALITIES if type(each) in options}
    found = modalities.get(name)
    if found is None and ":" in name:
        found = _found(name, path)
    if type(found) in options:
        return found
    known = "".join(f", {each!r}" for each in modalities)
    raise checks.error(path, f"a table, 'module:NAME'{known}", name, _nearest(name, modalities))


def checked(value, hint, path=""):
    """`value`, if it matches a type hint, as far as that can be checked; raises ValueError otherwise."""
    options = _options(hint)
    if any(_is_of(value, each) for each in options) or callable(value) and str in options:  # a kernel
        for i, (each, inner) in enumerate(_members(value, hint) if isinstance(value, tuple | list) else ()):
            checked(each, inner, f"{path}[{i}]")
        return value
    raise checks.error(path or "data", _words(hint), value)


def _is_of(value, option):
    kind = get_origin(option) or option
    if kind in (int, float):
        return isinstance(value, (int, kind)) and not isinstance(value, bool)
    try:
        inner = get_args(option)
        return isinstance(value, kind) and (kind is not tuple or ... in inner or len(value) == len(inner) or not inner)
    except TypeError:  # a hint that only a type checker understands
        return True


def _words(hint):
    return " or ".join(PLAIN.get(each) or checks.with_article(getattr(get_origin(each) or each, "__name__", str(each)))
                       for each in _options(hint))


def _options(hint):
    """The types that a hint allows."""
    if get_origin(hint) in (Union, UnionType):
        return [each for option in get_args(hint) for each in _options(option)]
    return [object if hint is Any else hint]


def _members(values, hint):
    """The values of a list, each with its own hint."""
    inner = next((get_args(each) for each in _options(hint) if get_origin(each)), ())
    if inner[1:] in ((), (...,)):
        inner = (inner or (object,))[:1] * len(values)
    elif len(inner) != len(values):
        inner = (object,) * len(values)
    return zip(values, inner)


@functools.cache
def _taken(kind):
    """The arguments of a dataclass: {name: (hint, default)}, the default MISSING where there is none."""
    try:
        hints = get_type_hints(kind)
    except (NameError, TypeError):  # a hint that only a type checker understands
        hints = {}
    return {each.name: (hints.get(each.name, object), each.default if each.default_factory is MISSING else ...)
            for each in fields(kind) if each.init}


def _nearest(name, names):
    near = difflib.get_close_matches(str(name), names, 1)
    return f"did you mean {near[0]!r}?" if near else ""


def _at(path, name):
    return f"{path}.{name}" if path else str(name)


def _name(code, path, value, made_by):
    """The name of a class, a kernel or a maker of kernels, which stands for it, or for the same defined again.

    value, made_by: what is made with the code, and a function that makes it with what has the name now.
    """
    for name in (code.__qualname__, name_of(code)):
        with contextlib.suppress(ValueError, AttributeError):
            now = _found(name, path)
            if now is code and (code is value or code is type(value)):  # not a maker, which may make another now
                return name
            if name_of(now) == name_of(code):
                break
    else:
        raise checks.error(path or "the value", "a kernel that a module defines or a neorl.custom.kernel_maker has "
                           "made, or a class that a module defines, to be saved", code)
    with contextlib.suppress(Exception):  # of any class: the user's code is run
        if (again := made_by(now)) is value or identity(again) == identity(value):
            return name
    raise ValueError(f"{path or 'the value'} cannot be saved: {AGAIN.format(name)}")


def _found(name, path):
    """The object that a name refers to."""
    module, _, inner = str(name).rpartition(":")
    try:
        return getattr(importlib.import_module(module), inner) if module else SHORT_NAMES[inner]
    except Exception as error:  # importing a module may raise anything
        hint = str(error) if module else _nearest(name, SHORT_NAMES)
        raise checks.error(path, "a name of neorl, or 'module:name' of what can be imported", name, hint) from error
