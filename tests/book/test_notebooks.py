"""The notebooks as committed, and the parameters that they refuse. Building the book tests that they run."""

import ast
import re
from contextlib import nullcontext

from computing import compute
import nbformat
import pytest
from computing.cells import LABEL, caption_of, tags
from page_cells import HIDDEN, PART
from page_cells import NOTEBOOKS as FOLDER
from computing.programs import figure_of

from companion import page as toolkit
from companion.page import beginning
from companion.page.recorded import SHOWN
from companion.thesis.statements import STATEMENTS

NOTEBOOKS = {path.stem: nbformat.read(path, 4) for path in sorted(FOLDER.glob("*.ipynb"))}
DRAWS = r"(figures|drawing)\.(draw|new)_|plt\.(figure\(|subplots)|draw_means\("


@pytest.fixture(params=NOTEBOOKS)
def cells(request):
    return NOTEBOOKS[request.param].cells


def test_a_page_shows_its_experiment_in_one_cell(cells):
    (experiment,) = [cell for cell in cells if "experiment" in tags(cell)]
    assert not HIDDEN & tags(experiment) and 8 <= len(experiment.source.splitlines()) <= 20
    assert re.search(r"\b(sweep|simulate|Learner|Run)\(", experiment.source)
    drawn = [cells.index(cell) for cell in cells if figure_of(cell)]
    assert cells.index(experiment) < min(drawn), "the experiment comes before figures"
    assert any("## Variations to try\n" in cell.source for cell in cells)


def test_the_recorded_answer_is_below_the_question_of_a_page_that_has_claims():
    for name in SHOWN:
        below = NOTEBOOKS[name].cells[1]
        assert below.id == "answer" and re.search(r"\banswer\(", below.source) and "remove-input" in tags(below)


def test_the_lines_of_open_cells_fit_on_a_page(cells):
    shown = [cell.source for cell in cells if cell.cell_type == "code" and not HIDDEN & tags(cell)]
    assert [line for source in shown for line in source.splitlines() if len(line) > 82] == []


def test_a_notebook_is_without_outputs(cells):
    assert all(not cell.outputs and cell.execution_count is None for cell in cells if cell.cell_type == "code")


def test_every_figure_has_alt_text_and_a_caption_below_it(cells):
    for cell, below in zip(cells, [*cells[1:], None]):
        if figure_of(cell) or cell.cell_type == "code" and re.search(DRAWS, cell.source):
            assert len(cell.metadata["mystnb"]["image"]["alt"]) > 40
            assert below.source.startswith(LABEL) and len(caption_of(below)) > 40 and tags(below) == {"caption"}
        else:
            assert below is None or "caption" not in tags(below)


def test_what_the_book_folds_is_folded_in_jupyterlab(cells):
    for cell in cells:
        folds = {"source_hidden": HIDDEN & tags(cell), "outputs_hidden": {"hide-cell", "hide-output"} & tags(cell)}
        assert cell.metadata.get("jupyter", {}) == {fold: True for fold, tagged in folds.items() if tagged}


def test_what_a_page_says_of_its_experiment_comes_from_the_results(cells):
    """Below the experiment, cells that draw or write read no parameter but the seed: it may have changed since."""
    code = [cell for cell in cells if cell.cell_type == "code"]
    (chosen,) = [cell for cell in code if "parameters" in tags(cell)]
    parameters = {statement.target.id for statement in ast.parse(chosen.source).body} - {"seed"}
    (experiment,) = [place for place, cell in enumerate(code) if "experiment" in tags(cell)]
    for cell in code[experiment + 1:]:
        if PART not in tags(cell) and (HIDDEN & tags(cell) or figure_of(cell) or "Markdown(" in cell.source):
            read = {node.id for node in ast.walk(ast.parse(cell.source))
                    if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load)}
            assert not read & parameters, (cell.id, read & parameters)


def test_a_cell_that_ends_with_a_drawing_puts_out_nothing_but_the_figure(cells):
    for cell in cells:
        if cell.cell_type == "code" and cell.source:
            last = ast.get_source_segment(cell.source, ast.parse(cell.source).body[-1])
            if re.match(r"(drawing|figures|multiverse_figures|axes)\.(draw|mark|set)|name_ends", last):
                assert cell.source.endswith(";"), "the returned axes would be part of the output"


def test_every_claim_that_a_rule_judges_has_its_figure_on_one_page():
    found = [label for page in NOTEBOOKS.values() for label in map(figure_of, page.cells) if label]
    assert len(found) == len(set(found))
    assert {statement.figure for statement in STATEMENTS.values()} <= set(found)


def test_links_lead_somewhere(cells):
    for cell in cells:
        if cell.cell_type == "markdown":
            for target, place in re.findall(r"\]\(([^)#:]+)(?:#([^)]*))?\)", cell.source):
                assert (FOLDER / target).exists(), target
                assert not place or target == "../book/glossary.md" and place in compute.terms(), place
        else:  # the build rewrites the links of Markdown cells only
            assert "](../book/" not in cell.source


# Values that are right for some parameters; each of the others must be refused by a sentence that names it.
TRIED = [0, -1, "x", [], [1], [3, 3], None, 0.5, 10**9]
RIGHT = {"seed": [0, 10**9], "runs": [10**9], "steps": [10**9], "decisions": [10**9], "traffic": [0],
         "sample": [0], "recursion": [0, -1, 0.5], "place_gain": [0, 0.5], "bonus": [0, 0.5], "begin": [0.5],
         "learning_rate": [0.5], "exploration": [0, 0.5], "keep": ["x"], "layers": [[1]], "counts": [[1]],
         "stays": [[1]], "episodes": [0, 10**9]}
RIGHT_ON = {("paper_c", "resolutions"): [[], [1]], **{(page, "resolutions"): [[1]] for page in (
    "beyond_agents", "chapter_4", "paper_a", "paper_b", "recordings", "your_research")}}


@pytest.mark.parametrize("page", NOTEBOOKS)
def test_a_page_refuses_bad_parameters_before_it_runs(page):
    given, begun = (ast.parse(cell.source) for cell in NOTEBOOKS[page].cells[:8] if re.search(
        r"^runs: int|page\.begin\(", cell.source, re.MULTILINE))
    begun.body = [part for part in begun.body if not isinstance(part, ast.Import | ast.ImportFrom)]
    names = {"page": toolkit}
    exec(compile(given, page, "exec"), names)
    exec(compile(begun, page, "exec"), names)
    for name in [statement.target.id for statement in given.body]:
        for value in TRIED:
            if value in RIGHT_ON.get((page, name), RIGHT.get(name, ())):
                exec(compile(begun, page, "exec"), names | {name: value})
            else:
                with pytest.raises(ValueError, match=rf"^{name} must be .*, but is "):
                    exec(compile(begun, page, "exec"), names | {name: value})


def test_too_short_a_run_is_refused_where_there_would_be_nothing_to_draw():
    with pytest.raises(ValueError, match="steps must be an integer of at least 1000, but is 999"):
        beginning.begin({"steps": 1_000}, runs=20, steps=999, seed=0)


def test_the_values_of_the_finest_single_map_fit_into_memory():
    beginning.begin(resolution=50)
    with pytest.raises(ValueError, match="resolution must be an integer from 1 to 50, but is 51"):
        beginning.begin(resolution=51)


@pytest.mark.parametrize("given, wanted", [
    ([11, 5], (5, 11)), ("[11, 5]", (5, 11)), ("5, 11", (5, 11)), ("[]", ())])
def test_a_list_may_be_a_text_and_is_sorted(given, wanted):
    beginning.begin({"resolutions": 0}, resolutions=given)
    assert beginning.listed(given) == wanted


@pytest.mark.parametrize("given, message", [
    ("five", r"layers must be a list of numbers, but is 'five'; write it as \[5, 11\]"),
    ([3, 91], "layers must be an integer from 1 to 90, but is 91"),
    ([], "layers must be a list of 1 or more numbers, all different, but is"), ([3, 3], "but is .3, 3."),
    (7, "layers must be a list of numbers, but is 7")])
def test_other_lists_are_refused(given, message):
    with pytest.raises(ValueError, match=message):
        beginning.begin(layers=given)


@pytest.mark.parametrize("injected, refused", [("runz = 3", "runz"), ("PAPERMILL_OUTPUT_PATH = 'out.ipynb'", None)])
def test_a_parameter_that_a_notebook_does_not_have_is_refused_unless_it_is_papermill_s(injected, refused, monkeypatch):
    class Shell:
        user_ns = {"In": ["", "runs: int = 20", f"# Parameters\nruns = 4\n{injected}\n"]}

    monkeypatch.setattr(beginning, "get_ipython", Shell)
    with pytest.raises(ValueError, match="a parameter must be one of runs, but is runz") if refused else nullcontext():
        beginning.begin(runs=4)


def test_a_notebook_begins_with_typed_parameters_and_hidden_imports(cells):
    code = [cell for cell in cells if cell.cell_type == "code"]
    (place,) = [place for place, cell in enumerate(code) if "parameters" in tags(cell)]
    *before, parameters, imports = code[:place + 2]
    assert all(cell.id == "answer" or "widget" in cell.metadata for cell in before)
    statements = ast.parse(parameters.source).body
    assert all(isinstance(statement, ast.AnnAssign) for statement in statements)
    assert {"runs", "steps", "seed"} <= {statement.target.id for statement in statements}
    assert re.match(r"# .*\b(seconds|minutes?)\b", parameters.source)
    assert HIDDEN & tags(imports)
    *imported, begun = [part for part in ast.parse(imports.source).body if "page.listed" not in ast.unparse(part)]
    assert all(isinstance(part, ast.Import | ast.ImportFrom) for part in imported)
    checked = re.fullmatch(r"page\.begin\((?:{.*}, )?(.*)\)", ast.unparse(begun))[1]
    assert {*checked.split(", ")} == {f"{name}={name}" for name in (part.target.id for part in statements)}
