"""Docstrings and annotations of public callables: arguments are named and annotated, errors documented."""

import dataclasses
import importlib
import inspect
import re

import pytest
from public_calls import TABLE
from public_names import NOTHING_TO_REPLACE

NAMES = sorted({name.partition(",")[0] for name in (*TABLE, *NOTHING_TO_REPLACE)})
SAID_BY_THE_MODULE = ("choices", "ax")  # described in the docstring of their module
OTHERS = re.compile(r"[Tt]he (others|other fields|fields|arguments) are those of")  # and are described there


def found(name):
    """The object with a full name, and the class that it is a method of, or None."""
    module, inner = re.match(r"((?:[a-z_0-9]+[.])+)(.*)", name).groups()
    for split in range(len(module.split(".")), 1, -1):
        parts = name.split(".")
        try:
            value, owner = importlib.import_module(".".join(parts[:split])), None
        except ImportError:
            continue
        for part in parts[split:]:
            value, owner = getattr(value, part), value
        return value, owner if inspect.isclass(owner) else None
    raise LookupError(f"{name}: {inner}")


def lacking(name):
    value, owner = found(name)
    if isinstance(getattr(owner, name.rpartition(".")[2], None), property):
        return
    text = inspect.getdoc(value) or ""
    if not text:
        yield "a docstring"
    dataclass = dataclasses.is_dataclass(value)
    parameters = inspect.signature(value).parameters
    for parameter in parameters.values():
        named = re.search(rf"\b{parameter.name}\b", text) or OTHERS.search(text)
        if parameter.name not in ("self", *SAID_BY_THE_MODULE) and not named:
            yield f"the argument {parameter.name} in the docstring"
        if parameter.name != "self" and parameter.annotation is inspect.Parameter.empty:
            yield f"an annotation of {parameter.name}"
    if not inspect.isclass(value) and inspect.signature(value).return_annotation is inspect.Signature.empty:
        yield "an annotation of the return value"
    source = inspect.getsource(value)
    if re.search(r"checks[.](?!shown|LARGEST)|raise ValueError", source) and "Raise" not in text and (
            dataclass or inspect.isfunction(value)):
        yield "the errors raised in the docstring"


@pytest.mark.parametrize("name", NAMES)
def test_arguments_are_named_and_annotated_and_errors_documented(name):
    assert list(lacking(name)) == []
