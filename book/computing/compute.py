"""Compute a notebook for the book: make runs ``python book/computing/compute.py notebooks/paper_a.ipynb --runs 4``.

papermill runs the notebook. Its page, its figures, its widgets and the record of its claims replace earlier ones in
``book/chapters`` once all of them are complete, so that a computation can end at any time.
"""

import argparse
import os
import re
import shutil
import sys
import tempfile
import time
from pathlib import Path

import nbformat
import papermill
import psutil
from nbclient.exceptions import DeadKernelError
from papermill.exceptions import PapermillExecutionError, strip_color
from traitlets.config import Config

from computing.cells import of_page
from computing.excerpts import save_figures, save_widgets, without_ground
from computing.programs import with_programs
from neorl.common.files import cache_folder

ROOT = Path(__file__).resolve().parents[2]
CHAPTERS = ROOT / "book" / "chapters"
GLOSSARY = ROOT / "book" / "glossary.md"
CLAIMS_PAGE = "../book/claims.md"  # as in `companion.page.opening`, which would take a second to import for each page


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("notebook", type=Path)
    parser.add_argument("--runs", type=int, help="runs per condition")
    parser.add_argument("--steps", type=int, help="steps per run (by default the paper's)")
    parser.add_argument("--reading", help="of the thesis, \"letter\" or by default \"calibrated\"")
    chosen = vars(parser.parse_args())
    notebook = chosen.pop("notebook")
    os.environ["NEORL_CACHE"] = str(cache_folder())  # notebooks run in their own folder
    try:
        compute(notebook, {name: value for name, value in chosen.items() if value is not None})
    except PapermillExecutionError as error:
        sys.exit("\n".join([*map(strip_color, error.traceback),
                            f"{notebook.name}, In [{error.exec_count}]: {error.ename}: {error.evalue}",
                            f"{work_of(notebook)} has the notebook up to this cell"]))
    except DeadKernelError as error:
        sys.exit(f"{notebook.name}: its kernel has died, perhaps for lack of memory ({error})")
    except (OSError, ValueError) as error:
        sys.exit(f"{notebook.name}: {error}")
    except KeyboardInterrupt:
        sys.exit(f"{notebook.name}: interrupted")


def compute(notebook, parameters):
    """Run a notebook with these parameters, and put its page in place.

    Raises PapermillExecutionError for a cell that raises, DeadKernelError for a kernel that dies.
    """
    began = time.time()
    parameters = of_notebook(notebook, parameters)
    given = ", ".join(f"{name} {value}" for name, value in parameters.items()) or "its own parameters"
    print(f"{notebook.name}: {given}", flush=True)
    work = work_of(notebook)
    for remains in CHAPTERS.glob(f".{notebook.stem}-*"):
        if remains == work or not psutil.pid_exists(int(remains.name.rpartition("-")[2])):  # its process was killed
            shutil.rmtree(remains, ignore_errors=True)
    work.mkdir(parents=True)
    claims_of(notebook).unlink(missing_ok=True)
    execute(notebook, work / notebook.name, parameters)
    executed = nbformat.read(work / notebook.name, nbformat.NO_CONVERT)
    for cell in executed.cells:  # links are written for notebooks/, but the page is in book/chapters/
        cell.source = link_terms(cell.source).replace("](../book/", "](../")
        for output in cell.get("outputs", []):
            shown = output.get("data", {})
            for text in {"text/markdown", "text/html"} & shown.keys():
                shown[text] = shown[text].replace(f'"{CLAIMS_PAGE}', '"../claims.html')
            if "image/svg+xml" in shown:
                shown["image/svg+xml"] = without_ground(shown["image/svg+xml"])
    executed.cells = with_programs(of_page(executed.cells, parameters))
    save_figures(executed, work)
    save_widgets(executed, work)
    if claims_of(notebook).exists():
        shutil.copy(claims_of(notebook), work / f"{notebook.stem}.claims.json")
    else:
        (CHAPTERS / f"{notebook.stem}.claims.json").unlink(missing_ok=True)
    page = work / notebook.name
    nbformat.write(executed, page)
    os.utime(page, (began, began))  # it is older than a source that has changed in the meantime
    for path in sorted(work.iterdir(), key=lambda path: path == page):  # the page last
        os.replace(path, CHAPTERS / path.name)
    work.rmdir()
    print(f"{notebook.name}: {time.time() - began:.0f} s", flush=True)


def work_of(notebook):
    """Where this process computes a page, which another may do at the same time."""
    return CHAPTERS / f".{notebook.stem}-{os.getpid()}"


def of_notebook(notebook, parameters):
    """Parameters of a notebook, without a reading if it has none.

    Raises ValueError for another parameter that the notebook does not have; papermill itself would ignore it.
    """
    known = papermill.inspect_notebook(str(notebook))
    parameters = {name: value for name, value in parameters.items() if name in known or name != "reading"}
    for name, value in parameters.items():
        if name not in known:
            raise ValueError(f"a parameter of {notebook.name} must be {', '.join(known)}, but is {name}, {value!r}")
    return parameters


def claims_of(notebook):
    """Where a notebook saves its claims."""
    return cache_folder() / "claims" / f"{notebook.stem}.json"


def records():
    """What the pages whose notebooks are there have saved of claims: {name: path}."""
    found = {each.stem: CHAPTERS / f"{each.stem}.claims.json" for each in sorted((ROOT / "notebooks").glob("*.ipynb"))}
    return {name: path for name, path in found.items() if path.exists()}


def execute(notebook, target, parameters):
    """Run a notebook through papermill into a file."""
    with tempfile.TemporaryDirectory() as sockets:
        papermill.execute_notebook(
            notebook, target, parameters, cwd=ROOT / "notebooks", request_save_on_cell_execute=False,
            progress_bar=False,  # two of them would write over each other
            shutdown_kernel="immediate",  # it would report an interrupt in the output
            # over TCP the kernel warns that it is not encrypted
            config=Config(KernelManager={"transport": "ipc", "ip": f"{sockets}/kernel"}))


def link_terms(text):
    """Markdown with its links to the glossary turned into Sphinx's references to terms."""
    known = terms()
    # A role's text cannot contain markup, so emphasis goes around it.
    return re.sub(r"\[(\*?)([^]]+?)\1\]\(\.\./book/glossary\.md#([^)]+)\)",
                  lambda link: f"{link[1]}{{term}}`{link[2]} <{known.get(link[3], link[3])}>`{link[1]}", text)


def terms():
    """The terms of the glossary by their names in links, in lower case with hyphens: {name: term}."""
    _, listed = GLOSSARY.read_text(encoding="utf-8").split("```{glossary}\n")
    return {term.lower().replace(" ", "-"): term for term in re.findall(r"^\w.*", listed, re.MULTILINE)}


if __name__ == "__main__":
    main()
