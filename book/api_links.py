"""Sphinx extension: the rendering of docstrings on the reference pages.

Kernels are left out, since users of the package call the functions around them. The fields of a class are
described by the comments beside them. Types and defaults appear as in code. A name in single backticks links to its
entry, if the reference has one.
"""

import ast
import dataclasses
import inspect
import pydoc
import re
import textwrap

from numpy.typing import ArrayLike
from sphinx.util.nodes import make_refnode
from sphinx.util.typing import stringify_annotation

from neorl.core.kernel import Kernel

ITEM = re.compile(r"(Raises|Returns) |([a-z_]\w*(?:,? \w+){0,3}): ")
ENDS = (".", ".)", ";", ":")  # of the line before an item: in the middle of a sentence, a line may begin like one
ARRAY_LIKE = stringify_annotation(ArrayLike, "smart")
ARRAY = re.compile(r"~numpy\.ndarray\[tuple\[~typing\.Any, \.\.\.\], ~numpy\.dtype\[([^]]+)\]\]")
SENTENCE = re.compile(r"(?<=\.) (?=[a-z_]\w*(?:, \w+)*: )")


def setup(app):
    app.setup_extension("sphinx.ext.autodoc")
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
    if dataclasses.is_dataclass(member):
        for field in dataclasses.fields(member):
            if field.default_factory is not dataclasses.MISSING:
                signature = signature.replace("<factory>", f"{field.default_factory.__name__}()", 1)
    signature = re.sub(r"<kernel [\w.]*?(\w+)>", r"\1", signature)
    return tuple(each and ARRAY.sub(r"NDArray[\1]", each.replace(ARRAY_LIKE, "ArrayLike"))
                 for each in (signature, returned))


def read_docstring(app, what, name, member, options, lines):
    """List the items of a docstring, and append the comments beside the fields of a class."""
    opening, *rest = SENTENCE.split(lines[0], maxsplit=1) if lines else [""]
    lines[:] = [escaped(opening), *as_list(rest + lines[1:])]  # a docstring opens with a sentence, not an item
    if what == "class" and (hasattr(member, "_fields") or dataclasses.is_dataclass(member)):
        source = textwrap.dedent(inspect.getsource(member))
        rows = source.splitlines()
        for node in ast.parse(source).body[0].body:
            comment = isinstance(node, ast.AnnAssign) and re.search(r"  # (?!type:)(.*)", rows[node.end_lineno - 1])
            if comment:
                lines += as_list([f"{node.target.id}: {comment[1]}"])
        lines += [""]


def as_list(lines):
    """The lines of a docstring, with an item for each sentence that starts as "name: " or "Raises "."""
    made, in_item, before = [], False, "."
    for line in [part for line in lines for part in SENTENCE.split(escaped(line))]:
        start = ITEM.match(line) if not before or before.endswith(ENDS) else None
        if start:
            made += ["", f"*{start[1]}*" if start[1] else f"``{start[2]}``", f"    {line[start.end():]}"]
        else:
            made.append(f"    {line.strip()}" if in_item and line else line)
        in_item, before = bool(start or in_item and line), line
    return made


def escaped(line):
    """A line of a docstring, with what reStructuredText would take for markup escaped."""
    return re.sub(r"`(\w+)`(?=\w)", r"`\1`\\ ", line.replace("|", r"\|").replace("−`", "−\\ `"))


def find_name(app, env, node, content):
    """Resolve a name in a docstring from any module of the package; others stay as written."""
    if node.get("refdomain") != "py":
        return None
    target = node["reftarget"]
    found = env.get_domain("py").find_obj(env, None, None, target.removeprefix("neorl."), None, searchmode=1)
    if len(found) == 1:
        [(name, entry)] = found
        return make_refnode(app.builder, node["refdoc"], entry.docname, entry.node_id, content, name)
    return None if target.startswith("neorl.") and pydoc.locate(target) is None else content
