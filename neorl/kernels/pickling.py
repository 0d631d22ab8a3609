"""How the user's kernels, worlds and states are pickled: by name, with a digest of their code, or by their content.

pickle finds code by its name again, and cloudpickle saves by its content what others could not find, such as what a
notebook defines. An object is not told which of them asks it, so a *definition*, a class that is an attribute of the
code, stands for it: cloudpickle saves it by its content where it so saves other classes of the same module, and pickle
by the name of the code.

Once a cell has run again, a name stands for another object. If that has the same code, it is saved instead. If not,
pickle refuses what has the name no longer, and unpickling refuses what has another digest.
"""

import contextlib
import copyreg
import importlib
import operator
import os
import pickle
import sys
from typing import Any
from weakref import WeakKeyDictionary

from neorl.kernels.annotations import fields, is_again, is_tuple
from neorl.kernels.identity import digest_of, is_ours, name_of

AGAIN = "{} has been defined again since, with other code: make again what was made with it"
_defined = WeakKeyDictionary[type, Any]()  # what each definition stands for


class Definition(type):
    """The type of definitions."""


def definition_of(code, *made_of):
    """A definition of a kernel, a maker of kernels or a class. made_of: a function that makes it, and its arguments."""
    definition = Definition("_definition", (), {"made_of": made_of, "__module__": code.__module__,
                                               "__qualname__": f"{code.__qualname__}._definition"})
    _defined[definition] = code
    return definition


def code_of(definition):
    """What a definition stands for."""
    if definition not in _defined:  # from another process
        make, *arguments = definition.made_of
        code = _defined[definition] = make(*arguments)
        code._definition = definition
    return _defined[definition]


def itself(code):
    """The code, which cloudpickle saves by its content."""
    return code


def present(code):
    """What the name of a function or a class stands for now, or None."""
    try:
        return operator.attrgetter(code.__qualname__)(sys.modules[code.__module__])
    except (AttributeError, KeyError):
        return None


def refused(code):
    """The error for code that pickle does not find by its name."""
    if present(code) is not None:
        return pickle.PicklingError(AGAIN.format(name_of(code)))
    return pickle.PicklingError(f"{name_of(code)} must be found by its name to be pickled, but is not: move it to a "
                                "module, or use cloudpickle")


def restored(code, arguments=None, digest=None):
    """What was pickled: code, or what it makes of arguments. code: or its definition. digest: of that, or None.

    Raises ValueError if it has another digest now.
    """
    code = code_of(code) if isinstance(code, Definition) else code
    value = code if arguments is None else code(*arguments)
    if digest is not None:
        check_digest(code, lambda: value, digest)
    return value


def check_digest(code, look_up, digest):
    """Raise ValueError unless what a function returns has the digest that was pickled with the name of some code."""
    with contextlib.suppress(Exception):  # of any class: the user's code is run
        if digest_of(look_up()) == digest:
            return
    raise ValueError(f"{name_of(code)} must have the code that it was pickled with, but has other code in process "
                     f"{os.getpid()}: restore that code, restart the process, or make again what was pickled")


def _by_name(definition):
    code = code_of(definition)
    if not _is_same(present(code), code):
        raise refused(code)
    return _found, (code.__module__, code.__qualname__)


def _is_same(now, code):
    """Whether code is the same as it was before it was defined again."""
    if now is code or is_again(now, code):
        return True
    functions = [getattr(each, "__wrapped__", None) for each in (now, code)]
    return type(now) is type(code) and None not in functions and digest_of(functions[0]) == digest_of(functions[1])


def _found(module, name):
    return operator.attrgetter(name)(importlib.import_module(module))


copyreg.pickle(Definition, _by_name)


def pickle_again(kind):
    """Let named tuples of a kind, and of those within it, be pickled when the kind has been defined again."""
    for each in fields(kind).values():
        if is_tuple(each):
            pickle_again(each)
    if not is_ours(kind) and "_definition" not in vars(kind):
        kind._definition = definition_of(kind, itself, kind)
        kind.__reduce_ex__ = lambda values, protocol: (restored, (type(values)._definition, tuple(values)))
