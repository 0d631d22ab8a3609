"""Errors of a user's kernel that numba cannot compile, or that raises: the message begins with that kernel.

numba reports the kernel that was called from Python, and then, call by call, the way to the one that is wrong. A user
knows only the latter. Its errors have no parts but their text, so this module searches that; where another version of
numba words it otherwise, the message names all of the user's kernels that may be to blame.
"""

import inspect
import re
import traceback

from neorl.kernels.identity import Reading

MOST_CHARACTERS = 2_000  # of numba's message


def not_compiled(kernel, error):
    """The error for a kernel that numba cannot compile, itself or one that it calls."""
    text = re.sub(r"Failed in nopython mode pipeline \(step: [^)]*\)\s*", "", str(error)).strip()
    what = " ".join(re.split(r"\n\s*\n(?!\s*>>>)|\nDuring: |\nFile ", text)[0].split())
    to_blame = _users(kernel)
    to_blame = _named_in(text, to_blame) or _called_in(text, kernel) or [
        each for each in to_blame if _fails_alone(each)] or to_blame
    names = " or ".join(map(_where, to_blame)) or repr(kernel)
    returned = re.search(r"or_\(Literal\[int\]\(0\), (.+?)\)$", what)  # by a policy, see `neorl.core.functions.choice`
    must = (f"return the number of an action, an integer, but returns {returned[1]}" if returned else
            f"be one that numba can compile, but {what}")
    return TypeError(f"the kernel {names} must {must}\n\nnumba's message: {text[:MOST_CHARACTERS]}")


def raise_named(kernels, error):
    """Raise the error for the user's kernel among those called that has raised one; any other error unchanged."""
    users = _users(tuple(kernels))
    for frame in reversed(traceback.extract_tb(error.__traceback__)):
        for function in users:
            if frame.filename == function.__code__.co_filename and frame.name in (function.__name__,
                                                                                   function.__qualname__):
                raise ValueError(f"the kernel {_where(function, frame.lineno)} must not raise, but has raised "
                                 f"{type(error).__name__}: {error}; let it return a value in every case") from error
    if users and re.fullmatch(r"expected \w+, got None", str(error)):  # numba says no more
        raise ValueError(f"the kernel {' or '.join(map(_where, users))} must return a value in every case, but has "
                         "returned None") from error
    raise error


def _users(kernel):
    """The functions of the user's among a kernel and those that it calls."""
    return Reading(kernel).functions


def _where(function, line=None):
    return (f"{function.__module__}.{function.__qualname__} ({function.__code__.co_filename}, line "
            f"{line or function.__code__.co_firstlineno})")


def _named_in(text, functions):
    """The innermost function that numba's message names, by itself or by a line of it."""
    named = {}
    for function in functions:
        code = function.__code__
        lines = [line for *_, line in code.co_lines() if line and code.co_filename[:1] != "<"]
        file = re.escape(code.co_filename)
        at = [text.find(repr(function)), *(each.start() for each in re.finditer(rf"at {file} \((\d+)\)", text)
                                           if lines and min(lines) <= int(each[1]) <= max(lines))]
        if max(at) >= 0:
            named[min(place for place in at if place >= 0)] = function
    return [named[min(named)]] if named else []


def _called_in(text, kernel):
    """The function that is called last in the lines of this package to which numba's message points."""
    lines = text.partition("^")[0]
    names = inspect.getclosurevars(kernel.py_func).nonlocals
    for name, value in list(names.items()):
        names |= {f"{name}.{field}": each for field, each in getattr(value, "_asdict", dict)().items()}
    called = {call.start(): function for name, value in names.items() for function in _users(value)
              if function is getattr(value, "py_func", None) for call in re.finditer(rf"\b{name}\(", lines)}
    return [called[max(called)]] if called else []


def _fails_alone(function):
    from numba.core.compiler import run_frontend

    try:
        run_frontend(function)
    except Exception:  # of many classes
        return True
    return False
