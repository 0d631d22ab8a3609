"""Compute the notebooks and build the book: ``make book`` runs this, from the root of the repository.

Each notebook runs through papermill into ``book/chapters``, where the book finds it, and is skipped while nothing that
it depends on has changed and its outputs are intact. A page there is complete or absent, so a build can be interrupted
at any time. One build at a time works in a tree.
"""

import argparse
import fcntl
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
from pathlib import Path

sys.modules["rfc3987_syntax"] = None  # jsonschema would read for a second a grammar that no notebook needs
sys.path.append(str(Path(__file__).resolve().parents[1] / "notebooks"))  # has what pages share

# ruff: noqa: E402
import contents
import ledger
import nbformat
import papermill
import psutil
import rules
import workers
from excerpts import save_figures, save_widgets
from jupyter_client import AsyncKernelManager
from lib.shared import report
from lib.shared.opening import CLAIMS_PAGE
from nbclient.exceptions import DeadKernelError
from cells import of_page
from papermill.exceptions import PapermillExecutionError, strip_color
from programs import with_programs
from traitlets.config import Config

from neorl.files import cache_folder, write_whole

ROOT = Path(__file__).resolve().parent.parent
CHAPTERS = ROOT / "book" / "chapters"
BUILT = ROOT / "_build"
HTML = BUILT / "html" / "index.html"
SHARES = "assumptions"  # finds the shares of readings
CONCLUSION = "chapter_5"  # reads what all others have found
ALONE = ("paper_b", "performance")  # measure times
ORDER = (SHARES, "beyond_agents", "calibration", "paper_a", "paper_b", "paper_c")  # long ones first
# Much of a notebook keeps only one core busy: compiling, drawing. The papers' tables of values take gigabytes.
AT_ONCE, GIGABYTES_EACH = 2, 4
# Beside another notebook, threads of linear algebra waiting for each other took fifty times as long as one thread.
ONE_THREAD = {"OPENBLAS_NUM_THREADS": "1"}
# Cells compute, or wait for modules that another page compiles, which takes minutes on a busy machine.
STALL_SECONDS = 900  # without processor time
ROOM = 2**20  # bytes: less than one page of the book
CLAIMS, RULES, FRONT, SQUARES, ERRATA, PICTURES = INCLUDED = (
    "claims-table.md", "claims-rules.md", "claims-front.html", "claims-squares.html", "errata-table.md", "contents.md")


def main():
    chosen = parse_arguments()
    os.environ["NEORL_CACHE"] = str(cache_folder().absolute())  # notebooks run in their own folder
    if chosen.notebook:
        return attempt(chosen.notebook, json.loads(chosen.parameters))
    if chosen.pages:
        return make_pages()
    parameters = {name: value for name, value in (("runs", chosen.runs), ("steps", chosen.steps)) if value is not None}
    notebooks = dict.fromkeys(sorted((ROOT / "notebooks").glob("*.ipynb"), key=preference), parameters)
    notebooks[ROOT / "notebooks" / f"{SHARES}.ipynb"] = parameters | {"points": points(chosen.runs)}
    for notebook, its_parameters in notebooks.items():
        check_parameters(notebook, its_parameters)
    try:
        lock = the_only_build()  # until this process ends
        compute_all(notebooks)
        write_tables()
        build()
    except KeyboardInterrupt:
        sys.exit("\ninterrupted; make book resumes from here")
    except OSError as error:
        sys.exit(f"\nthe book was not built: {error}; make book resumes from here")
    lock.close()
    print(f"the book is at {HTML.as_uri()}")


def the_only_build():
    """Check that all folders are writable, and return a locked file; the lock ends with the process."""
    for folder in (CHAPTERS, BUILT, cache_folder()):
        try:
            folder.mkdir(parents=True, exist_ok=True)
            tempfile.TemporaryFile(dir=folder).close()
        except OSError as error:
            sys.exit(f"{folder} cannot be written to: {error}")
    file = (BUILT / ".lock").open("a+")
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        with file:
            file.seek(0)
            sys.exit(f"another make book is at work in this tree, {file.read()}: wait for its end, or end it")
    file.truncate(0)
    file.write(f"process {os.getpid()} since {time.strftime('%H:%M:%S')}")
    file.flush()
    return file


def compute_all(notebooks):
    """Compute notebooks, {path: parameters}: most in parallel, then those that measure times, and the conclusion."""
    tidy(notebooks)
    restore_claims(notebooks)

    def work(notebooks_now, at_once=1):
        return workers.work({each.name: (__file__, "--notebook", each, "--parameters", json.dumps(notebooks[each]))
                             for each in notebooks_now}, at_once, say)

    fit = psutil.virtual_memory().available // (GIGABYTES_EACH * 2**30)
    last = [each for each in notebooks if each.stem == CONCLUSION]
    alone = [each for each in notebooks if each.stem in ALONE]
    together = [each for each in notebooks if each not in (*alone, *last)]
    failed = work(together, max(1, min(AT_ONCE, os.cpu_count(), fit))) + work(alone)
    if not failed:
        failed = work(last)
    elif last:
        say(f"{CONCLUSION}.ipynb: left out, since it needs {', '.join(failed)}")
        failed += [each.name for each in last]
    if failed:
        sys.exit(f"\nnot computed, see above: {', '.join(failed)}; all others are kept")
    tidy(notebooks)


def restore_claims(notebooks):
    """Make the cached records of claims, which notebooks read, those of the chapters and no others."""
    folder = cache_folder() / "claims"
    shutil.rmtree(folder, ignore_errors=True)
    for notebook in notebooks:
        path = CHAPTERS / f"{notebook.stem}.claims.json"
        if path.name in (kept_record(notebook) or {}).get("outputs", ()) and is_whole(notebook):
            write_whole(folder / f"{notebook.stem}.json", path.read_bytes())


def tidy(notebooks):
    """Remove from the chapters all files that no notebook has made, such as the page of a deleted one."""
    made = {*INCLUDED}
    for notebook in notebooks:
        made |= {f"{notebook.stem}.inputs.json", *(kept_record(notebook) or {"outputs": ()})["outputs"]}
    for path in CHAPTERS.iterdir():
        if path.name not in made:
            shutil.rmtree(path) if path.is_dir() else path.unlink()


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--runs", type=whole_number, default=10, help="runs per condition (default 10)")
    parser.add_argument("--steps", type=whole_number, help="steps per run (by default the paper's)")
    # For the processes that this one starts:
    parser.add_argument("--notebook", type=Path, help=argparse.SUPPRESS)
    parser.add_argument("--parameters", help=argparse.SUPPRESS)
    parser.add_argument("--pages", action="store_true", help=argparse.SUPPRESS)
    return parser.parse_args()


def whole_number(text):
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"must be an integer of at least 1, but is {text!r}")
    return int(text)


def points(runs):
    """The number of readings on the page of assumptions: a power of two, 128 with 100 runs and 16 with 10."""
    return 2 ** max(2, int(math.log2(1.6 * runs)))


def preference(notebook):
    """The sort key of a notebook by `ORDER`, as far as dependencies allow; notebooks not listed there come last."""
    return (ORDER.index(notebook.stem) if notebook.stem in ORDER else len(ORDER), notebook.stem)


def records(notebook):
    """The records of claims that a notebook reads: all of the others, or none."""
    if notebook.stem != CONCLUSION:
        return []
    return sorted(set(CHAPTERS.glob("*.claims.json")) - {CHAPTERS / f"{CONCLUSION}.claims.json"})


def attempt(notebook, parameters):
    """Run `compute` as a process of its own: return 0, or 1 after printing what went wrong."""
    os.environ |= ONE_THREAD
    try:
        compute(notebook, parameters)
    except PapermillExecutionError as error:
        say("\n".join([*map(strip_color, error.traceback),
                        f"{notebook.name}, In [{error.exec_count}]: {error.ename}: {error.evalue}",
                        f"{CHAPTERS / f'.{notebook.stem}'} has the notebook up to this cell"]))
    except Exception as error:
        say(f"{notebook.name}: {type(error).__name__}: {error}")
    else:
        return 0
    return 1


def compute(notebook, parameters):
    """Run a notebook into the chapters, unless it is there already with the same parameters and sources.

    Raises PapermillExecutionError for a cell that raises, RuntimeError for a kernel that dies or hangs.
    """
    inputs = [notebook, ROOT / "environment.txt", *sources(), *records(notebook)]
    wanted = {"parameters": parameters, "inputs": digest(inputs)}
    if is_whole(notebook) and wanted.items() <= kept_record(notebook).items():
        say(f"{notebook.name}: nothing has changed")
        return
    say(f"{notebook.name}: {', '.join(f'{name} {value}' for name, value in parameters.items())}")
    began = time.monotonic()
    work = CHAPTERS / f".{notebook.stem}"  # always the same place, so that the remains of a killed process are cleared
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    claims = cache_folder() / "claims" / f"{notebook.stem}.json"
    claims.unlink(missing_ok=True)
    execute(notebook, work / notebook.name, parameters)
    executed = nbformat.read(work / notebook.name, nbformat.NO_CONVERT)
    for cell in executed.cells:  # links are written for notebooks/, but the page is in book/chapters/
        cell.source = link_terms(cell.source).replace("](../book/", "](../")
        for output in cell.get("outputs", []):
            shown = output.get("data", {})
            if "text/markdown" in shown:
                shown["text/markdown"] = shown["text/markdown"].replace(f'"{CLAIMS_PAGE}', '"../claims.html')
    executed.cells = with_programs(of_page(executed.cells, parameters))
    save_figures(executed, work)
    save_widgets(executed, work)
    if claims.exists():
        shutil.copy(claims, work / f"{notebook.stem}.claims.json")
    nbformat.write(executed, work / notebook.name)
    wanted["outputs"] = {path.name: digest([path]) for path in sorted(work.iterdir())}
    record = record_of(notebook)
    write_whole(work / record.name, json.dumps(wanted).encode())  # all writing is done before the old page goes
    record.unlink(missing_ok=True)
    for name in (*wanted["outputs"], record.name):
        os.replace(work / name, CHAPTERS / name)
    work.rmdir()
    say(f"{notebook.name}: {time.monotonic() - began:.0f} s")


def execute(notebook, target, parameters):
    """Run a notebook through papermill into a file."""
    at = ["its start"]
    with tempfile.TemporaryDirectory() as sockets, workers.watch(STALL_SECONDS) as hung:
        try:
            papermill.execute_notebook(
                notebook, target, parameters, cwd=ROOT / "notebooks", request_save_on_cell_execute=False,
                progress_bar=False,  # two of them would write over each other
                kernel_manager_class=Kernel,
                on_cell_start=lambda cell, cell_index: at.append(f"the cell that begins {cell.source[:60]!r}"),
                # over TCP the kernel warns that it is not encrypted
                config=Config(KernelManager={"transport": "ipc", "ip": f"{sockets}/kernel"}))
        except (DeadKernelError, RuntimeError) as error:
            why = (f"has hung: no processor time in {STALL_SECONDS} s" if hung.is_set() else
                   f"has died, perhaps for lack of memory ({error})")
            raise RuntimeError(f"its kernel {why}, in {at[-1]}") from error


class Kernel(AsyncKernelManager):
    """A kernel that is asked to shut down after its last cell, without an interrupt first.

    It may still be finishing that cell, and would report the interrupt in the build's output.
    """

    async def _async_interrupt_kernel(self):
        if not self.shutting_down:
            await super()._async_interrupt_kernel()


def record_of(notebook):
    return CHAPTERS / f"{notebook.stem}.inputs.json"


def kept_record(notebook):
    """The record of how a page was computed, {"parameters", "inputs", "outputs"}, or None if there is none."""
    try:
        kept = json.loads(record_of(notebook).read_bytes())
        return kept if kept.keys() == {"parameters", "inputs", "outputs"} else None
    except (OSError, ValueError, AttributeError):
        return None


def is_whole(notebook):
    """Whether all outputs of a notebook are present and unchanged."""
    try:
        return all(digest([CHAPTERS / name]) == kept for name, kept in kept_record(notebook)["outputs"].items())
    except (OSError, TypeError, AttributeError):
        return False


def say(line):
    """Print a line at once, so that those of two processes do not mix."""
    print(f"{line}\n", end="", flush=True)


def check_parameters(notebook, parameters):
    """Refuse a parameter that the notebook does not have; papermill itself would ignore it."""
    known = papermill.inspect_notebook(str(notebook))
    for name, value in parameters.items():
        if name not in known:
            raise ValueError(f"a parameter of {notebook.name} must be {', '.join(known)}, but is {name}, {value!r}")


def link_terms(text):
    """Markdown with its links to the glossary turned into Sphinx's references to terms."""
    known = terms()
    # A role's text cannot contain markup, so emphasis goes around it.
    return re.sub(r"\[(\*?)([^]]+?)\1\]\(\.\./book/glossary\.md#([^)]+)\)",
                  lambda link: f"{link[1]}{{term}}`{link[2]} <{known.get(link[3], link[3])}>`{link[1]}", text)


def terms():
    """The terms of the glossary by their names in links, in lower case with hyphens: {name: term}."""
    _, listed = (ROOT / "book" / "glossary.md").read_text(encoding="utf-8").split("```{glossary}\n")
    return {term.lower().replace(" ", "-"): term for term in re.findall(r"^\w.*", listed, re.MULTILINE)}


def write_tables():
    """Write what pages include: claims with the notebooks' results, rules, the strip, errata, contents in pictures."""
    record = report.load(sorted(CHAPTERS.glob("*.claims.json")))
    toc = (ROOT / "book" / "_toc.yml").read_text(encoding="utf-8")
    for name, table in ((CLAIMS, ledger.page(record)), (RULES, rules.page()), (FRONT, ledger.front(record)),
                        (SQUARES, ledger.squares(record)), (ERRATA, report.errata()),
                        (PICTURES, contents.pictures(toc, CHAPTERS))):
        target = CHAPTERS / name
        if not target.exists() or target.read_text(encoding="utf-8") != table:
            write_whole(target, table.encode())


def build():
    """Build the book, warnings as errors, in place of the last one, unless that has the same inputs and is intact."""
    record = BUILT / "inputs.txt"
    settings = [ROOT / name for name in ("_config.yml", "pyproject.toml", "environment.txt")]
    wanted = digest([*settings, *sources(), *files(ROOT / "book")])
    if record.exists() and record.read_text() == wanted + digest(files(HTML.parent)):
        return
    record.unlink(missing_ok=True)
    shutil.rmtree(BUILT / "next", ignore_errors=True)
    if workers.run((__file__, "--pages")):
        free = shutil.disk_usage(BUILT).free
        shutil.rmtree(BUILT / "next", ignore_errors=True)
        sys.exit("the book was not built, see above" if free > ROOM else
                 f"the book was not built, for {BUILT} is on a disk that has no room left; make book resumes from here")
    shutil.rmtree(BUILT / "last", ignore_errors=True)
    if HTML.parent.exists():  # removed page by page, it would be incomplete for readers, or after a kill
        os.replace(HTML.parent, BUILT / "last")
    os.replace(BUILT / "next" / "_build" / "html", HTML.parent)
    for name in ("last", "next"):
        shutil.rmtree(BUILT / name, ignore_errors=True)
    write_whole(record, (wanted + digest(files(HTML.parent))).encode())


def make_pages():
    """Run Jupyter Book, as the worker of `build`; returns its exit code."""
    command = [Path(sys.executable).with_name("jupyter-book"), "build", "book", "--config", "_config.yml",
               "--path-output", BUILT / "next", "--all", "--quiet", "--warningiserror", "--keep-going", "--nitpick"]
    return subprocess.run(command, cwd=ROOT, stdout=subprocess.DEVNULL).returncode  # it names a folder that is moved


def sources():
    return [*files(ROOT / "neorl"), *files(ROOT / "notebooks" / "lib")]


def files(folder):
    return sorted(path for path in folder.rglob("*") if path.is_file() and "__pycache__" not in path.parts)


def digest(paths):
    return hashlib.sha256(b"".join(hashlib.sha256(path.read_bytes()).digest() for path in paths)).hexdigest()


if __name__ == "__main__":
    sys.exit(main())
