"""The program of a figure: all statements of its notebook that it depends on, as its page shows them.

``python book/computing/programs.py fig-proficiency -p runs 4`` runs one, and saves the figure as a file in the current
folder.
"""

import argparse
import ast
import re
from pathlib import Path
from symtable import symtable

import nbformat

from computing.cells import of_page, tags

NOTEBOOKS = Path(__file__).resolve().parents[2] / "notebooks"
IMPORT = ast.Import | ast.ImportFrom
BEGIN = "page.begin("  # checks the parameters, and sets the style of figures
SAVE = 'from matplotlib import pyplot as plt\nplt.savefig("{name}.svg")'
LINE = "#     .venv/bin/python book/computing/programs.py {name} -p runs 4\n"
HEAD = "# This draws the figure, in the folder notebooks. In the root of a clone, one line does:\n" + LINE
FOLDED = "# In the root of a clone, one line draws just this figure:\n" + LINE


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("figure", help="its name, such as fig-proficiency")
    parser.add_argument("-p", dest="values", nargs=2, action="append", default=[], metavar=("NAME", "VALUE"),
                        help="a parameter of its notebook")
    chosen = parser.parse_args()
    for path in NOTEBOOKS.glob("*.ipynb"):
        cells = nbformat.read(path, nbformat.NO_CONVERT).cells
        if chosen.figure in map(figure_of, cells):
            cells = of_page(cells, {name: ast.literal_eval(value) for name, value in chosen.values})
            return exec(program(cells, chosen.figure), {"__name__": "__main__"})
    parser.error(f"the figure must be one of a notebook's, such as fig-proficiency, but is {chosen.figure!r}")


def with_programs(cells):
    """The cells of a page, with the whole program of each figure in the fold of the cell that draws it.

    What a cell shows without a fold stays in a cell of its own before it. A figure that is itself folded has only the
    line that runs its program, since the program would stand between the fold's title and the figure.
    """
    found, programs = [], {figure_of(cell): program(cells, figure_of(cell)) for cell in cells
                           if figure_of(cell) and "hide-cell" not in tags(cell)}
    for cell in cells:
        name = figure_of(cell)
        if name and name not in programs:
            cell.source = FOLDED.format(name=name) + cell.source
        elif name:
            if not tags(cell):
                found.append(nbformat.v4.new_code_cell(cell.source, id=f"{cell.id}-shown"))
                cell.metadata["tags"] = ["hide-input"]
            cell.source = HEAD.format(name=name) + programs[name]
            for prompt in ("code_prompt_show", "code_prompt_hide"):
                cell.metadata["mystnb"].setdefault(prompt, "Run just this figure")
        found.append(cell)
    return found


def figure_of(cell):
    """The name of the figure that a cell draws, or None."""
    return cell.metadata.get("mystnb", {}).get("figure", {}).get("name")


def program(cells, name):
    """The program of a figure. cells: of its notebook. name: of the figure."""
    sources = []
    for cell in cells:
        if cell.cell_type == "code":
            sources.append(cell.source)
        if figure_of(cell) == name:
            break
    last = len(sources) - 1
    parts = [(*each, place == last) for place, source in enumerate(sources) for each in statements(source)]
    modules = {each.asname or each.name for node, *_ in parts if isinstance(node, IMPORT) for each in node.names}
    kept, needed = [SAVE.format(name=name)], set()
    for node, text, draws in reversed(parts):
        table = symtable(text, name, "exec")
        bound = {each.get_name() for each in table.get_symbols() if each.is_assigned() or each.is_imported()}
        changed = needed & (bound | changed_names(node) - modules)
        draws = draws or ast.unparse(node).startswith(BEGIN)
        if isinstance(node, IMPORT):
            node.names = [each for each in node.names if (each.asname or each.name) in changed]
            text = ast.unparse(node)
        elif changed or draws:
            needed -= bound if isinstance(node, ast.Assign) else set()
            needed |= read_names(table)
        if changed or draws:
            kept.insert(0, text)
    return re.sub(r"\n{3,}", "\n\n", "\n".join(kept).strip())


def statements(source):
    """The statements of a cell, each with its text and the comments above it, except those above a parameter."""
    lines, begin = ["", *source.splitlines()], 0
    for node in ast.parse(source).body:
        begin = node.lineno if isinstance(node, ast.AnnAssign) else begin
        yield node, "\n".join(lines[begin:node.end_lineno + 1])
        begin = node.end_lineno + 1


def read_names(table, top=True):
    """The global names that a piece of code reads, in its functions too."""
    names = {each.get_name() for each in table.get_symbols() if each.is_referenced() and (top or each.is_global())}
    return names.union(*(read_names(child, False) for child in table.get_children()))


def changed_names(node):
    """The names of objects that a statement changes: it sets an item, calls a method, or fills an array."""
    found = set()
    for part in ast.walk(node):
        if isinstance(part, ast.Expr) and isinstance(part.value, ast.Call):
            found |= _roots(part.value.func)
        elif isinstance(part, ast.keyword) and part.arg == "out":
            found |= _roots(part)
        elif isinstance(getattr(part, "ctx", None), ast.Store):
            found |= _roots(part)
    return found


def _roots(node):
    """The name of the object that an item or an attribute is of: a set of one, or none."""
    while isinstance(getattr(node, "value", None), ast.Attribute | ast.Subscript):
        node = node.value
    return {node.value.id} if isinstance(getattr(node, "value", None), ast.Name) else set()


if __name__ == "__main__":
    main()
