"""Sphinx extension: docstrings in the style of this project on the reference pages.

1. Kernels are left out, since users of the package call the functions around them.
2. A signature is written as in the source, where Sphinx would write types and defaults as Python has expanded them.
3. A sentence of a docstring that begins with the name of an argument, "name: ", with Raises or with Returns is an item
   of a list. The fields of a class are described by the comments beside them.
4. A name in single backticks links to what it names in the module of the docstring, if the reference has an entry.
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

from docutils import nodes
from sphinx.ext.autodoc import PropertyDocumenter
from sphinx.util.nodes import make_refnode

from neorl.kernels.kernel import Kernel

ITEM = re.compile(r"(?:Raises|Returns) |([a-z_]\w*(?:(?:, \w+)*|(?:,? \w+){0,3})):(?= |$)")
ENDS = (".", ".)", ";", ":")  # of the line before an item: in the middle of a sentence, a line may begin like one
SENTENCE = re.compile(r"(?<=\.) (?=(?:Raises|Returns) |[a-z_]\w*(?:, \w+)*:(?: |$))")


class Property(PropertyDocumenter):
    """A property, with its type as in the source."""

    def add_line(self, line, source, *lineno):
        before, mark, _ = line.partition(":type: ")
        super().add_line(f"{before}{mark}{ast.unparse(syntax(self.object.fget).returns)}" if mark else line, source,
                         *lineno)


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
    return isinstance(member, Kernel) or str(member.__doc__).startswith("Alias for field number") or None


def read_signature(app, what, name, member, options, signature, returned):
    """Write a signature as in the source."""
    if what not in ("class", "function", "method"):
        return None
    if what == "class" and issubclass(member, enum.Enum):
        return "", None
    plain = Plain(sys.modules[member.__module__])
    if what == "class" and has_fields(member):
        fields = {node.target.id: node for kind in reversed(member.__mro__) for node in fields_of(kind)}
        taken = [ast.unparse(plain.visit(fields[each])) for each in inspect.signature(member).parameters]
        return f"({', '.join(taken)})", None
    function = member.__init__ if what == "class" else member
    if not signature or function is object.__init__:
        return None
    function = plain.visit(syntax(function))
    function.args.args = [each for each in function.args.args if each.arg not in ("self", "cls")]
    return f"({ast.unparse(function.args)})", returned and ast.unparse(function.returns)


class Plain(ast.NodeTransformer):
    """Replace a type with a range by the type, a factory by its call, and a constant by its value, if that is short."""

    def __init__(self, module):
        self.module = module

    def visit_Subscript(self, node):
        return node.slice.elts[0] if ast.unparse(node.value) == "Annotated" else self.generic_visit(node)

    def visit_Call(self, node):
        factories = [each.value for each in node.keywords if each.arg == "default_factory"]
        return ast.Call(*factories, [], []) if factories else self.generic_visit(node)

    def visit_Name(self, node):
        named, value = getattr(self.module, node.id, None), constant(node.id, self.module)
        if hasattr(named, "__metadata__"):  # a type with a range (`neorl.common.checks`)
            return ast.Name(named.__origin__.__name__)
        return node if value is None else ast.Constant(value)


def constant(name, module):
    """The value of a constant of a module if it is a number, a text or a short tuple of them, else None."""
    value = getattr(module, name, None) if name.isupper() else None
    plain = all(type(each) in (int, float, str) for each in (value if type(value) is tuple else [value]))
    return value if plain and len(repr(value)) <= 40 else None


def has_fields(kind):
    """Whether a class is a named tuple, or a dataclass whose fields are its arguments."""
    return hasattr(kind, "_fields") or dataclasses.is_dataclass(kind) and kind.__dataclass_params__.init


def fields_of(kind):
    """The annotated fields in the source of a class, as nodes of its syntax tree."""
    return [] if kind.__module__ == "builtins" else [
        node for node in syntax(kind).body if isinstance(node, ast.AnnAssign)]


def syntax(member):
    """The syntax tree of a class or function, as if it were defined in a module."""
    return ast.parse(textwrap.dedent(inspect.getsource(member))).body[0]


def read_docstring(app, what, name, member, options, lines):
    """List the items of a docstring, and append the comments beside the fields of a class, or its choices."""
    if what == "data":
        lines[:] = [*assignment(name), ""]  # its docstring would be that of its class
        return
    opening, *rest = SENTENCE.split(lines[0], maxsplit=1) if lines else [""]
    lines[:] = [escaped(opening), *as_list(rest + lines[1:])]  # a docstring opens with a sentence, not an item
    if what == "class" and issubclass(member, enum.Enum):
        lines += [", ".join(f"``{choice.name}`` {choice.value}" for choice in member) + ".", ""]
    elif what == "class" and has_fields(member):
        rows = textwrap.dedent(inspect.getsource(member)).splitlines()
        comments = ((node.target.id, rows[node.end_lineno - 1].partition("  # ")[2]) for node in fields_of(member))
        lines += as_list([f"{field}: {comment}" for field, comment in comments if comment])


def assignment(name):
    """What a module assigns to a constant, as in code, and the comment beside it: lines of text."""
    module, _, constant = name.rpartition(".")
    source = inspect.getsource(sys.modules[module])
    for node in ast.parse(source).body:
        if isinstance(node, ast.Assign) and constant == getattr(node.targets[0], "id", None):
            comment = source.splitlines()[node.end_lineno - 1].partition("  # ")[2]
            yield f"``{ast.unparse(node.value)}`` {escaped(comment)}"


def as_list(lines):
    """The lines of a docstring, with an item of a list for each sentence that begins as "name: ", "Raises "."""
    made, in_item, before = [""], False, ""
    for line in (part for line in lines for part in SENTENCE.split(escaped(line))):
        item = ITEM.match(line) if not before or before.endswith(ENDS) else None
        if item:
            made += ["", f"* ``{item[1]}``{line[item.end(1):]}" if item[1] else f"* {line}"]
        else:
            made.append(f"  {line.strip()}" if in_item and line else line)
        in_item, before = bool(item or in_item and line), line
    return [*made, ""]


def escaped(line):
    """A line of a docstring, with what reStructuredText would take for markup escaped."""
    return re.sub(r"`(\w+)`(?=\w)", r"`\1`\\ ", line.replace("|", r"\|").replace("−`", "−\\ `"))


def find_name(app, env, node, content):
    """Link a name in a docstring or signature to the entry of what it names there; without one it stays as written.

    A constant without an entry is followed by its value, if that is short.
    """
    if node.get("refdomain") != "py":
        return None
    target, of_package = node["reftarget"], node["reftarget"].startswith("neorl.")
    module, path = sys.modules.get(node.get("py:module")), target.removeprefix("neorl.")
    try:
        named = pydoc.locate(target) if of_package else operator.attrgetter(path)(module)
    except AttributeError:
        named = None
    find = env.get_domain("py").find_obj
    whole = named.__name__ if inspect.ismodule(named) else (
        f"{getattr(named, '__module__', '')}.{getattr(named, '__qualname__', '')}")
    found = find(env, None, None, whole, None)
    if not found and (path[:1].isupper() or "." in path):  # a class or constant that the module does not import
        found = find(env, None, None, path, None, searchmode=1)
    if len(found) == 1:
        [(name, entry)] = found
        return make_refnode(app.builder, node["refdoc"], entry.docname, entry.node_id, content, name)
    value = constant(target, module)
    if value is not None:
        content += nodes.Text(f" = {value!r}")
    return None if of_package and named is None else content
