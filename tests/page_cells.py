"""What the cells of a notebook define, for tests: a page's world, rules and toy systems are cells of its notebook."""

import ast
import json
import re
from pathlib import Path
from symtable import symtable
from types import SimpleNamespace

from cells import tags
from markdown_it import MarkdownIt
from programs import changed_names, figure_of, read_names, statements

NOTEBOOKS = Path(__file__).parents[1] / "notebooks"
HIDDEN = {"remove-input", "hide-input", "hide-cell"}


def code(page):
    """The code in the cells of a page, in their order: {cell: source}."""
    cells = json.loads((NOTEBOOKS / f"{page}.ipynb").read_text(encoding="utf-8"))["cells"]
    return {each["id"]: "".join(each["source"]) for each in cells if each["cell_type"] == "code"}


def suggested(page, section):
    """What a section of a page suggests: programs to paste below the page, and arguments of papermill, two lists."""
    cells = json.loads((NOTEBOOKS / f"{page}.ipynb").read_text(encoding="utf-8"))["cells"]
    text = "\n\n".join("".join(each["source"]) for each in cells if each["cell_type"] == "markdown")
    _, _, text = text.partition(f"## {section}\n")
    blocks = [each for each in MarkdownIt().parse(re.split(r"^## ", text, flags=re.MULTILINE)[0])
              if each.type in ("fence", "code_block")]
    return ([each.content for each in blocks if each.info in ("", "python")],
            re.findall(r"\.ipynb out\.ipynb (.*)", "\n".join(each.content for each in blocks)))


def source(page, cell):
    return code(page)[cell]


def defined(page, *cells, **given):
    """The names that cells define, as attributes. given: names that they look up, such as those of folded imports."""
    names = {"__name__": f"cells_of_{page}", **given}
    for cell in cells:
        exec(compile(source(page, cell), f"{page}.ipynb, {cell}", "exec"), names)
    return SimpleNamespace(**names)


def planned(page, *cells, until=(), **given):
    """The names that a page's parameters, imports and some of its cells define, with conditions in place of results.

    until: lines that need results; a cell ends before the first of them. given: other values of names.
    """
    parameters, imports, *_ = code(page).values()
    names = {"__name__": f"cells_of_{page}"}
    exec(parameters, names)
    chosen = {name: value for name, value in given.items() if name in names}
    names |= chosen
    exec(re.sub(r"notebook\.begin\([^)]*\)", "", imports), names)  # lists become tuples
    names |= {"sweep": iter, **{name: value for name, value in given.items() if name not in chosen}}
    for cell in cells:
        text = source(page, cell)
        for line in until:
            text = text.partition(line)[0]
        exec(compile(text, f"{page}.ipynb, {cell}", "exec"), names)
    return names


def computed_below(cells, experiment, parameters):
    """The cells below the experiment that open ones compute with parameters, and those that show what these have."""
    changing, found = set(), set()
    for place, cell in enumerate(cells):
        writes = figure_of(cell) or tags(cell) & HIDDEN or "Markdown(" in cell.source
        for node, text in statements(cell.source):
            table = symtable(text, cell.id, "exec")
            bound = {each.get_name() for each in table.get_symbols() if each.is_assigned()} | changed_names(node)
            read = read_names(table)
            if place <= experiment:
                changes = isinstance(node, ast.FunctionDef | ast.ClassDef) and read & (changing | parameters)
            else:
                changes = read & changing or not writes and read & parameters
            if changes:
                changing |= bound
                found |= {cell.id} if place > experiment else set()
            elif isinstance(node, ast.Assign):
                changing -= bound
    return found
