"""Sphinx extension: the rendering of docstrings on the reference pages.

Kernels are left out, since users of the package call the functions around them. The fields of a class are
described by the comments beside them. Types and defaults appear as in code, except that a constant appears as its
value if that is short. A name in single backticks links to its entry, if the reference has one that can be meant
there; a constant without an entry is followed by its value.
"""

import ast
import dataclasses
import enum
import inspect
import operator
import pydoc
import re
import sys
import textwrap
import tomllib
from pathlib import Path

from docutils import nodes
from numpy.typing import ArrayLike
from sphinx import addnodes
from sphinx.ext.autodoc import PropertyDocumenter
from sphinx.util.inspect import stringify_signature
from sphinx.util.nodes import make_refnode
from sphinx.util.typing import stringify_annotation

import neorl
from neorl.core.kernel import Kernel

PROJECT = tomllib.loads(Path(neorl.__file__).parents[1].joinpath("pyproject.toml").read_text(encoding="utf-8"))
LAYERS = PROJECT["tool"]["importlinter"]["contracts"][0]["layers"]
ROOMS = [room for layer in reversed(LAYERS) for room in layer.split(" | ")]  # upwards
ITEM = re.compile(r"(Raises|Returns) |([a-z_]\w*(?:(?:, \w+)*|(?:,? \w+){0,3})):(?: |$)")
ENDS = (".", ".)", ";", ":")  # of the line before an item: in the middle of a sentence, a line may begin like one
DEFAULT = re.compile(r"(?<==)( ?-?)([A-Za-z_][\w.]*)(?=[,)])")
ARRAY_LIKE = stringify_annotation(ArrayLike, "smart")
ANNOTATED = re.compile(r"(?:~typing\.)?Annotated\[(?:~numpy\.)?ndarray, ([^]]+)\]")  # by `neorl.core.kernel.array`
RANGED = re.compile(r"(?:~typing\.)?Annotated\[(int|float|str), [^]]+\]")  # by `neorl.checks`
ARRAY = re.compile(r"~numpy\.ndarray\[tuple\[~typing\.Any, \.\.\.\], ~numpy\.dtype\[([^]]+)\]\]")
SENTENCE = re.compile(r"(?<=\.) (?=[a-z_]\w*(?:, \w+)*:(?: |$))")
OF_THE_WHOLE = re.compile(r"(?<=\.) (?=(?:Raises|Returns) )")  # in an item, which is of one argument


class Property(PropertyDocumenter):
    """A property, with its type as in code."""

    def add_line(self, line, source, *lineno):
        super().add_line(ARRAY.sub(r"NDArray[\1]", line), source, *lineno)


def setup(app):
    app.setup_extension("sphinx.ext.autodoc")
    app.add_autodocumenter(Property, override=True)
    app.connect("autodoc-skip-member", skip_member)
    app.connect("autodoc-process-signature", read_signature)
    app.connect("autodoc-process-docstring", read_docstring)
    app.connect("missing-reference", find_name)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def skip_member(app, what, name, member, skip, options):
    """Leave out kernels, and Python's own docstrings of the fields of a named tuple."""
    if isinstance(member, Kernel) or str(member.__doc__).startswith("Alias for field number"):
        return True
    return None


def read_signature(app, what, name, member, options, signature, returned):
    """Write types and defaults as in code: types that Python has expanded, and defaults that it cannot write."""
    if not signature:
        return None
    if what == "class" and issubclass(member, enum.Enum):
        return "", None
    if signature.startswith("(*args") and "__init__" in vars(member):  # of a widget: traitlets hides its own
        _, *own = inspect.signature(member.__init__).parameters.values()
        signature = stringify_signature(inspect.Signature(own))
    if dataclasses.is_dataclass(member):
        written = {node.target.id: ast.unparse(node.value) for node in fields_of(member) if node.value}
        for field in dataclasses.fields(member):
            if field.default_factory is not dataclasses.MISSING:
                signature = signature.replace("<factory>", f"{field.default_factory.__name__}()", 1)
            elif dataclasses.is_dataclass(field.default) and field.name in written:
                signature = signature.replace(repr(field.default), written[field.name], 1)
    signature = RANGED.sub(r"\1", ANNOTATED.sub(r"array(\1)", signature))
    signature = re.sub(r"<kernel [\w.]*?(\w+)>", r"\1", signature)
    module = sys.modules.get(getattr(member, "__module__", None))
    signature = DEFAULT.sub(lambda found: found[1] + value_of(found[2], module), signature)
    return tuple(each and ARRAY.sub(r"NDArray[\1]", each.replace(ARRAY_LIKE, "ArrayLike"))
                 for each in (signature, returned))


def value_of(name, module):
    """What a default names in a module, as code, if that is a number, a text or a short tuple; else the name."""
    try:
        value = operator.attrgetter(name)(module)
    except AttributeError:  # a keyword, such as None, or a builtin
        return name
    plain = all(type(each) in (bool, int, float, str) for each in (value if type(value) is tuple else [value]))
    written = f"{value:.3g}" if type(value) is float and len(repr(value)) > 8 else repr(value)
    return written if plain and len(written) <= 40 else name


def read_docstring(app, what, name, member, options, lines):
    """List the items of a docstring, and append the comments beside the fields of a class, or its choices."""
    if what == "data":
        lines[:] = [*assignment(name), ""]  # its docstring would be that of its class
        return
    opening, *rest = SENTENCE.split(lines[0], maxsplit=1) if lines else [""]
    lines[:] = [escaped(opening), *as_list(rest + lines[1:])]  # a docstring opens with a sentence, not an item
    if what == "class" and issubclass(member, enum.Enum):
        lines[:] = [", ".join(f"``{choice.name}`` {choice.value}" for choice in member) + ".", ""]
    elif what == "class" and (hasattr(member, "_fields") or dataclasses.is_dataclass(member)):
        rows = source_of(member).splitlines()
        for node in fields_of(member):
            comment = re.search(r"  # (?!type:)(.*)", rows[node.end_lineno - 1])
            if comment:
                lines += as_list([f"{node.target.id}: {comment[1]}"])
        lines += [""]


def assignment(name):
    """What a module assigns to a constant, as in code, and the comment beside it: lines of text."""
    module, _, constant = name.rpartition(".")
    source = inspect.getsource(sys.modules[module])
    for node in ast.parse(source).body:
        if isinstance(node, ast.Assign) and constant == getattr(node.targets[0], "id", None):
            comment = re.search(r"  # (.*)", source.splitlines()[node.end_lineno - 1])
            yield f"``{ast.unparse(node.value)}``" + (f" {escaped(comment[1])}" if comment else "")


def fields_of(kind):
    """The annotated fields in the source of a class, as nodes of its syntax tree."""
    return [node for node in ast.parse(source_of(kind)).body[0].body if isinstance(node, ast.AnnAssign)]


def source_of(kind):
    """The source of a class, as if it were defined in a module."""
    return textwrap.dedent(inspect.getsource(kind))


def as_list(lines):
    """The lines of a docstring, with an item for each sentence that starts as "name: " or "Raises "."""
    made, in_item, before = [], False, "."
    waiting = [part for line in lines for part in SENTENCE.split(escaped(line))]
    while waiting:
        line = waiting.pop(0)
        start = ITEM.match(line) if not before or before.endswith(ENDS) else None
        if start or in_item and line:
            line, *rest = OF_THE_WHOLE.split(line, maxsplit=1)
            waiting = rest + waiting
        if start:
            made += ["", f"*{start[1]}*" if start[1] else f"``{start[2]}``"]
            made += [f"    {line[start.end():]}"] if line[start.end():] else []
        else:
            made.append(f"    {line.strip()}" if in_item and line else line)
        in_item, before = bool(start or in_item and line), line
    return made


def escaped(line):
    """A line of a docstring, with what reStructuredText would take for markup escaped."""
    return re.sub(r"`(\w+)`(?=\w)", r"`\1`\\ ", line.replace("|", r"\|").replace("−`", "−\\ `"))


def find_name(app, env, node, content):
    """Resolve a name in a docstring, but not that of an argument, from anywhere; others stay as written.

    A constant without an entry is followed by its value, if that is short.
    """
    if node.get("refdomain") != "py":
        return None
    target, here = node["reftarget"], node.get("py:module")
    if target in arguments(node):
        return content
    named = pydoc.locate(target) if target.startswith("neorl.") else None
    whole = f"{getattr(named, '__module__', '')}.{getattr(named, '__qualname__', '')}"  # "neorl.Run" is imported there
    find = env.get_domain("py").find_obj
    short = target.removeprefix("neorl.")
    found = find(env, None, None, whole, None) or find(env, None, None, short, None, searchmode=1)
    if here and target.isidentifier():
        found = meant(found, here, target[0].isupper())
    if len(found) == 1:
        [(name, entry)] = found
        return make_refnode(app.builder, node["refdoc"], entry.docname, entry.node_id, content, name)
    value = value_of(target, sys.modules[here]) if here and target.isupper() and not found else target
    if value != target:
        content.clear()
        content += nodes.Text(f"{target} = {value}")
    return None if target.startswith("neorl.") and named is None else content


def meant(found, here, is_class):
    """Which objects of one short name, [(name, entry)], a docstring of the module `here` can mean.

    A class or constant of its module, else of its room or below, or else of any; a function of its room or below, a
    method of its module, a room.
    """
    below = [(name, entry) for name, entry in found if height(name) <= height(here)]
    if is_class:
        return [(name, entry) for name, entry in found if name.rpartition(".")[0] == here] or below or found
    return [(name, entry) for name, entry in below if entry.objtype == "function" or name.count(".") == 1
            or entry.objtype != "module" and name.rpartition(".")[0].rpartition(".")[0] == here]


def arguments(node):
    """The names of the arguments of what a node of its docstring describes."""
    while node is not None and not isinstance(node, addnodes.desc):
        node = node.parent
    return [] if node is None else [parameter.next_node(addnodes.desc_sig_name).astext()
                                    for parameter in node[0].findall(addnodes.desc_parameter)
                                    if parameter.next_node(addnodes.desc_sig_name)]


def height(name):
    """The number of the room of a module, class or function; the package itself is above them all."""
    room = (name.split(".") + [""])[1]
    return ROOMS.index(room) if room in ROOMS else len(ROOMS)
