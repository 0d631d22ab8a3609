"""A book of three short notebooks in a tree of its own, built as ``make book`` builds the real one.

The conclusion comes last.
"""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import nbformat
from nbformat.v4 import new_code_cell, new_markdown_cell
from saved_files import share_compiled

ROOT = Path(__file__).parents[1]
NOTEBOOKS = ("assumptions", "chapter_5", "paper_a")
SIMULATE = """from pathlib import Path
from IPython.display import SVG
import neorl
from companion.page import report
result = neorl.simulate(neorl.place_cells([3]), neorl.WaterWorld(), steps=10_000, runs=runs, cache=True, progress=False)
lines = "".join(f"<path d='M{k} 0V{abs(paid):.0f}'/>" for k, paid in enumerate(result.rewards[:, ::4].ravel()))
print(f"{result.totals.sum():.6f}")"""
REPEAT = """from IPython.display import SVG
from companion.page import report
lines = "".join(f"<path d='M{k} 0V{k % 7}'/>" for k in range(200))"""
DRAW = """SVG(f"<svg xmlns='http://www.w3.org/2000/svg' width='75pt' height='30pt'>{lines}<!--{lines * 80}--></svg>")"""
SAVE = "report.CLAIMS_OF.clear()\nreport.save('{}')"  # as a page without claims, since these judge none
CONCLUDE = f"from companion.page import report\n{SAVE.format('chapter_5')}"
CONFIG = """title: A small book
only_build_toc_files: true
execute: {execute_notebooks: "off"}
sphinx:
  config:
    extensions: [myst_nb, jupyter_book, sphinx_external_toc, sphinx_design, sphinx_comments, sphinx_book_theme]
"""
TOC = "format: jb-book\nroot: index\nchapters:\n  - file: glossary\n  - file: running\n" + "".join(
    f"  - file: chapters/{name}\n" for name in NOTEBOOKS)
INDEX = "# A small book\n\n```{include} chapters/contents.md\n```\n"


def make_tree(tree):
    """Write the sources of the book into a folder."""
    (tree / "book").mkdir(parents=True)
    for room in ("page", "thesis"):
        shutil.copytree(ROOT / "notebooks" / "companion" / room, tree / "notebooks" / "companion" / room)
    shutil.copy(ROOT / "notebooks" / "companion" / "__init__.py", tree / "notebooks" / "companion")
    shutil.copy(ROOT / "Makefile", tree)
    for room in ("computing", "writing"):  # links would lead the build to the real tree
        shutil.copytree(ROOT / "book" / room, tree / "book" / room)
    for path in (each for kind in ("*.toml", "*.js", "*.html", "rules_before.json")
                 for each in (ROOT / "book").glob(kind)):
        shutil.copy(path, tree / "book")
    (tree / "neorl").mkdir()  # pages depend on the sources here, but import the real package
    (tree / ".cache").mkdir()
    share_compiled(tree / ".cache")
    for name, content in {"_config.yml": CONFIG, "pyproject.toml": "[project]\n", "environment.txt": "",
                          "book/_toc.yml": TOC, "book/index.md": INDEX, "book/running.md": "# Running it\n",
                          "book/glossary.md": "# Glossary\n\n```{glossary}\nmap\n  Cells.\n```\n"}.items():
        (tree / name).write_text(content)
    write_notebook(tree, "assumptions", SIMULATE, DRAW, SAVE.format("assumptions"))
    write_notebook(tree, "paper_a", REPEAT, DRAW, SAVE.format("paper_a"))
    write_notebook(tree, "chapter_5", CONCLUDE)
    return tree


def write_notebook(tree, name, *sources, **parameters):
    """Write a notebook with these code cells; the figure of the cell that draws is named after the notebook."""
    parameters = "".join(f"{each}: int = {value}\n" for each, value in {"runs": 2, **parameters}.items())
    figure = {"mystnb": {"figure": {"name": f"fig-{name}", "caption": "Rewards."}, "image": {"alt": "Paths."}}}
    cells = [new_markdown_cell(f"# Page {name}\n\nText."),
             new_code_cell(parameters, metadata={"tags": ["parameters"]}),
             *(new_code_cell(source, metadata=figure if source == DRAW else {}) for source in sources)]
    for k, cell in enumerate(cells):
        cell["id"] = f"cell-{k}"
    metadata = {"kernelspec": {"name": "python3", "display_name": "Python 3", "language": "python"}}
    nbformat.write(nbformat.v4.new_notebook(cells=cells, metadata=metadata), tree / "notebooks" / f"{name}.ipynb")


def start(tree, runs=2, *options):
    """Start a build of the tree in a session of its own, and return its process, with stderr merged into stdout."""
    command = ["make", "--no-print-directory", "--keep-going", "--jobs=2", f"BIN={Path(sys.executable).parent}",
               f"RUNS={runs}", "_build/html/index.html", *options]
    environment = {name: value for name, value in os.environ.items() if not name.startswith("MAKE")}  # of `make test`
    return subprocess.Popen(command, text=True, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT, cwd=tree, start_new_session=True,
                            env=environment | {"PYTHONPATH": os.pathsep.join([str(tree / "book"), str(ROOT)]),
                                               "NEORL_CACHE": str(tree / ".cache")})


def build(tree, runs=2, *options):
    """Build the tree, with other options of make: (exit code, output)."""
    process = start(tree, runs, *options)
    said, _ = process.communicate()
    return process.returncode, said


def written(tree):
    """The time at which each page was begun: {notebook: time}."""
    paths = {name: tree / "book" / "chapters" / f"{name}.ipynb" for name in NOTEBOOKS}
    return {name: path.stat().st_mtime_ns for name, path in paths.items() if path.exists()}


def assert_no_half_page(tree):
    """Assert that all files that exist are complete: computed pages, records of claims, and the book in HTML."""
    chapters = tree / "book" / "chapters"
    for path in chapters.glob("*.ipynb"):
        nbformat.read(path, nbformat.NO_CONVERT)
    for path in [*chapters.glob("*.json"), *(tree / ".cache" / "claims").glob("[!.]*")]:
        json.loads(path.read_text())
    for path in chapters.glob("*.svg"):
        assert path.read_text().rstrip().endswith("</svg>"), path
    html = tree / "_build" / "html"
    if html.exists():
        pages = ["index", "glossary", "running", *(f"chapters/{name}" for name in NOTEBOOKS)]
        for page in pages:
            assert (html / f"{page}.html").read_text().rstrip().endswith("</html>"), page
        assert len(list((html / "_images").glob("fig-*.svg"))) == 2
        assert {path.stem for path in chapters.glob("*.claims.json")} == {f"{name}.claims" for name in NOTEBOOKS}


def pages(tree):
    """The built pages, without the parts that differ from build to build: {name: text}."""
    html = tree / "_build" / "html"
    return {path.relative_to(html).as_posix(): re.sub(r"took \d+ seconds|\?digest=\w+", "", path.read_text())
            for path in html.rglob("*.html")}
