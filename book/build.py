"""Compute the notebooks and build the book: ``make book`` runs this, from the root of the repository.

Each notebook runs through papermill into ``book/chapters``, where the book finds it, and is left alone while nothing
that it depends on has changed. A file there is complete or absent, so the work can be stopped at any moment.
"""

import argparse
import hashlib
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from itertools import groupby
from pathlib import Path

import nbformat
import papermill
from papermill.exceptions import PapermillExecutionError
from traitlets.config import Config

from neorl.evidence import report
from neorl.files import cache_folder

ROOT = Path(__file__).resolve().parent.parent
CHAPTERS = ROOT / "book" / "chapters"
HTML = ROOT / "_build" / "html" / "index.html"
CONCLUSION = "chapter_5"  # reads what all others have found
# Notebooks of one round are computed two at a time, since much of each keeps one core busy alone: compiling, drawing.
# All but the first read the shares of readings. The papers keep all cores busy, and paper B measures times. The last
# page measures nothing else, and what the others took.
ROUNDS = (("assumptions", "chapter_1", "chapter_2", "chapter_3"), ("calibration", "chapter_4", "own_world"),
          ("paper_a",), ("paper_b",), ("paper_c",), (CONCLUSION,), ("performance",))
WIDGET_STATE = "application/vnd.jupyter.widget-state+json"
WIDGET_VIEW = "application/vnd.jupyter.widget-view+json"


def main():
    chosen = parse_arguments()
    parameters = {name: value for name, value in vars(chosen).items() if value is not None}
    notebooks = dict.fromkeys(sorted(sorted((ROOT / "notebooks").glob("*.ipynb")), key=turn), parameters)
    notebooks[ROOT / "notebooks" / "assumptions.ipynb"] = parameters | {"points": points(chosen.runs)}
    for notebook, its_parameters in notebooks.items():
        check_parameters(notebook, its_parameters)
    for _, some in groupby(notebooks.items(), key=lambda item: turn(item[0])):
        with ProcessPoolExecutor(2) as pool:
            errors = [error for error in pool.map(attempt, *zip(*some)) if error]
        if errors:
            sys.exit("\n" + "\n".join(errors))
    write_claims()
    build()
    print(f"the book is at {HTML.as_uri()}")


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--runs", type=whole_number, default=10, help="runs a condition (default 10)")
    parser.add_argument("--steps", type=whole_number, help="steps a run (by default the paper's)")
    return parser.parse_args()


def whole_number(text):
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"is {text!r}, allowed are integers ≥ 1")
    return int(text)


def points(runs):
    """How many readings the assumptions are varied in: a power of two, 128 with 100 runs and 16 with 10."""
    return 2 ** max(2, int(math.log2(1.6 * runs)))


def turn(notebook):
    """In which round a notebook is computed. One that no round names is in the first."""
    return next((place for place, names in enumerate(ROUNDS) if notebook.stem in names), 0)


def records(notebook):
    """The records of claims that a notebook reads: first none, in the second round that of shares, then all."""
    if turn(notebook) == 0:
        return []
    read = "*" if notebook.stem == CONCLUSION else "assumptions"
    return sorted(set(CHAPTERS.glob(f"{read}.claims.json")) - {CHAPTERS / f"{notebook.stem}.claims.json"})


def attempt(notebook, parameters):
    """`compute`, for a process of a pool: what went wrong, as text, or None."""
    try:
        compute(notebook, parameters)
    except PapermillExecutionError as error:
        return str(error)


def compute(notebook, parameters):
    """Run a notebook into the chapters, unless it is there already with the same parameters and sources."""
    target, record = CHAPTERS / notebook.name, CHAPTERS / f"{notebook.stem}.inputs.json"
    inputs = [notebook, ROOT / "environment.txt", *sources(), *records(notebook)]
    wanted = {"parameters": parameters, "inputs": digest(inputs)}
    if target.exists() and record.exists() and json.loads(record.read_text()) == wanted:
        say(f"{notebook.name}: nothing has changed")
        return
    say(f"{notebook.name}: {', '.join(f'{name} {value}' for name, value in parameters.items())}")
    began = time.monotonic()
    CHAPTERS.mkdir(parents=True, exist_ok=True)
    record.unlink(missing_ok=True)
    work = CHAPTERS / f".{notebook.stem}"  # at a place of its own, so that what a killed process left is cleared
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir()
    with tempfile.TemporaryDirectory() as sockets:  # over TCP the kernel warns that it is not encrypted
        papermill.execute_notebook(
            notebook, work / notebook.name, parameters, cwd=ROOT / "notebooks", request_save_on_cell_execute=False,
            progress_bar=False,  # two of them would write over each other
            config=Config(KernelManager={"transport": "ipc", "ip": f"{sockets}/kernel"}))
    executed = nbformat.read(work / notebook.name, nbformat.NO_CONVERT)
    for cell in executed.cells:  # links are written for notebooks/, and the page lies in book/chapters/
        cell.source = link_terms(cell.source).replace("](../book/", "](../")
    save_figures(executed)
    save_widgets(executed)
    claims = cache_folder() / "claims" / f"{notebook.stem}.json"
    if claims.exists():
        shutil.copy(claims, CHAPTERS / f"{notebook.stem}.claims.json")
    nbformat.write(executed, work / notebook.name)
    os.replace(work / notebook.name, target)
    work.rmdir()
    record.write_text(json.dumps(wanted))
    say(f"{notebook.name}: {time.monotonic() - began:.0f} s")


def say(line):
    """Print a line at once, so that those of two processes do not mix."""
    print(f"{line}\n", end="", flush=True)


def check_parameters(notebook, parameters):
    """Refuse a parameter that the notebook does not have; papermill itself would pass over it."""
    known = papermill.inspect_notebook(str(notebook))
    for name, value in parameters.items():
        if name not in known:
            raise ValueError(f"parameter {name} is {value!r}, allowed for {notebook.name} are {', '.join(known)}")


def link_terms(text):
    """Markdown whose links into the glossary are Sphinx's references to its terms."""
    known = terms()
    return re.sub(r"\[([^]]+)\]\(\.\./book/glossary\.md#([^)]+)\)",
                  lambda link: f"{{term}}`{link[1]} <{known.get(link[2], link[2])}>`", text)


def terms():
    """The terms of the glossary by the names that links have for them, in lower case with hyphens: {name: term}."""
    _, listed = (ROOT / "book" / "glossary.md").read_text(encoding="utf-8").split("```{glossary}\n")
    return {term.lower().replace(" ", "-"): term for term in re.findall(r"^\w.*", listed, re.MULTILINE)}


def save_figures(notebook):
    """Keep each named figure as a file of its own, so that other pages can show it."""
    for cell in notebook.cells:
        name = cell.metadata.get("mystnb", {}).get("figure", {}).get("name")
        for output in cell.get("outputs", []):
            image = output.get("data", {}).get("image/svg+xml")
            if name and image:
                (CHAPTERS / f"{name}.svg").write_text(image)


def save_widgets(notebook):
    """Keep each named widget as a file of its own, and in the notebook no state but that of the widgets it shows."""
    stored = notebook.metadata.get("widgets", {}).get(WIDGET_STATE, {"state": {}})
    kept = {}
    for cell in notebook.cells:
        name = cell.metadata.get("widget", {}).get("name")
        data = [output.get("data", {}) for output in cell.get("outputs", [])]
        views = [shown[WIDGET_VIEW] for shown in data if WIDGET_VIEW in shown]
        if name and len(views) != 1:
            raise ValueError(f"cell of widget {name} shows {len(views)} widgets, allowed is 1")
        for view in views:
            records = reachable(stored["state"], view["model_id"])
            kept.update(records)
            if name:
                tags = [script(WIDGET_STATE, {**stored, "state": records}), script(WIDGET_VIEW, view)]
                (CHAPTERS / f"{name}.html").write_text("\n".join(tags) + "\n")
    stored["state"] = kept


def reachable(state, model):
    """The records of a model and of all that it refers to, directly or through others."""
    found, waiting = {}, [model]
    while waiting:
        model = waiting.pop()
        if model in state and model not in found:
            found[model] = state[model]
            waiting += re.findall(r'"(?:IPY_MODEL_|anywidget:)(\w+)"', json.dumps(state[model]["state"]))
    return found


def script(kind, content):
    """A tag that holds JSON. No "<" is left in it, so nothing that a string says can end the tag."""
    text = json.dumps(content).replace("<", r"\u003c")
    return f'<script type="{kind}">{text}</script>'


def write_claims():
    """The table of all claims, from what the notebooks have found, for the page that includes it."""
    table = report.page(report.load(sorted(CHAPTERS.glob("*.claims.json"))))
    target = CHAPTERS / "claims-table.md"
    if not target.exists() or target.read_text(encoding="utf-8") != table:
        target.write_text(table, encoding="utf-8")


def build():
    """Build the book, with warnings as errors."""
    record = ROOT / "_build" / "inputs.txt"
    pages = files(ROOT / "book")
    wanted = digest([ROOT / "_config.yml", ROOT / "environment.txt", *sources(), *pages])
    if HTML.exists() and record.exists() and record.read_text() == wanted:
        return
    record.unlink(missing_ok=True)
    command = [Path(sys.executable).with_name("jupyter-book"), "build", "book", "--config", "_config.yml",
               "--path-output", ".", "--all", "--quiet", "--warningiserror", "--keep-going", "--nitpick"]
    if subprocess.run(command, cwd=ROOT).returncode:
        sys.exit("the book was not built, see above")
    record.write_text(wanted)


def sources():
    return files(ROOT / "neorl")


def files(folder):
    return sorted(path for path in folder.rglob("*") if path.is_file() and "__pycache__" not in path.parts)


def digest(paths):
    return hashlib.sha256(b"".join(hashlib.sha256(path.read_bytes()).digest() for path in paths)).hexdigest()


if __name__ == "__main__":
    main()
