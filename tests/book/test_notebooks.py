"""The notebooks as committed, and the parameters that they refuse. Building the book tests that they run."""

import ast
import re

import compute
import nbformat
import pytest
from cells import tags
from page_cells import NOTEBOOKS as FOLDER
from programs import figure_of

from lib.shared import notebook
from neorl.evidence.statements import STATEMENTS

NOTEBOOKS = {path.stem: nbformat.read(path, 4) for path in sorted(FOLDER.glob("*.ipynb"))}
HIDDEN = {"remove-input", "hide-input", "hide-cell"}
DRAWS = r"(figures|drawing)\.(draw|new)_|plt\.(figure\(|subplots)|draw_means\("


@pytest.fixture(params=NOTEBOOKS)
def cells(request):
    return NOTEBOOKS[request.param].cells


def test_a_page_shows_its_experiment_in_one_cell(cells):
    (experiment,) = [cell for cell in cells if "experiment" in tags(cell)]
    assert not HIDDEN & tags(experiment) and 8 <= len(experiment.source.splitlines()) <= 20
    assert re.search(r"\b(sweep|simulate)\(|\bLearner\(", experiment.source)
    drawn = [cells.index(cell) for cell in cells if figure_of(cell)]
    boxes = [cells.index(cell) for cell in cells if "opening.found(" in cell.source]
    assert max([cells.index(experiment), *boxes]) < min(drawn), "the box and the experiment come before figures"
    assert any("## Variations to try\n" in cell.source for cell in cells)


def test_the_lines_of_open_cells_fit_on_a_page(cells):
    shown = [cell.source for cell in cells if cell.cell_type == "code" and not HIDDEN & tags(cell)]
    assert [line for source in shown for line in source.splitlines() if len(line) > 82] == []


def test_a_notebook_is_without_outputs(cells):
    assert all(not cell.outputs and cell.execution_count is None for cell in cells if cell.cell_type == "code")


def test_every_figure_has_alt_text_and_a_caption(cells):
    for cell in cells:
        if cell.cell_type == "code" and re.search(DRAWS, cell.source):
            assert len(cell.metadata["mystnb"]["image"]["alt"]) > 40
            assert len(cell.metadata["mystnb"]["figure"]["caption"]) > 40


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


def test_each_specification_curve_has_the_label_of_its_claim():
    page = NOTEBOOKS["assumptions"]
    drawn = re.findall(r'draw_specification\(.*"(\w+)"\)', "\n".join(cell.source for cell in page.cells))
    found = [name for name in map(figure_of, page.cells) if name and "spec" in name]
    assert found == [f"fig-spec-{name.lower()}" for name in drawn]
    assert drawn == [name for name in STATEMENTS if name in drawn] and len(drawn) == 19
    folded = [cell.metadata.mystnb.code_prompt_show for cell in page.cells if "draw_specification(" in cell.source]
    assert folded == [f"{name}: {STATEMENTS[name].text}" for name in drawn]


def test_links_lead_somewhere(cells):
    for cell in cells:
        if cell.cell_type == "markdown":
            for target, place in re.findall(r"\]\(([^)#:]+)(?:#([^)]*))?\)", cell.source):
                assert (FOLDER / target).exists(), target
                assert not place or target == "../book/glossary.md" and place in compute.terms(), place
        else:  # the build rewrites the links of Markdown cells only
            assert "](../book/" not in cell.source


@pytest.mark.parametrize("change, message", [
    ({"runs": 0}, "runs must be an integer of at least 1, but is 0"), ({"runs": "4"}, "runs must be .*, but is '4'"),
    ({"steps": -1}, "steps must be .*, but is -1"), ({"seed": 0.5}, "seed must be .*, but is 0.5"),
])
def test_a_bad_parameter_is_refused(change, message):
    with pytest.raises(ValueError, match=message):
        notebook.begin(**{"runs": 20, "steps": 1_000, "seed": 0, **change})


def test_too_short_a_run_is_refused_where_there_would_be_nothing_to_draw():
    with pytest.raises(ValueError, match="steps must be an integer of at least 1000, but is 999"):
        notebook.begin(runs=20, steps=999, seed=0, fewest_steps=1_000)


@pytest.mark.parametrize("given, fewest, wanted", [
    ([5, 11], 1, (5, 11)), ("[11, 5]", 1, (11, 5)), ("5, 11", 1, (5, 11)), ([], 0, ()), ("[]", 0, ())])
def test_resolutions_are_a_list_or_its_text(given, fewest, wanted):
    assert notebook.resolutions("layers", given, fewest) == wanted


@pytest.mark.parametrize("given, message", [
    ("five", r"layers must be a list of resolutions, but is 'five'; write it as \[5, 11\]"),
    ([3, 91], "layers must be an integer from 1 to 90, but is 91"),
    ([], "layers must be a list of 1 or more resolutions, all different, but is"), ([3, 3], "but is .3, 3."),
    (7, "layers must be a list or a tuple, but is 7")])
def test_other_resolutions_are_refused(given, message):
    with pytest.raises(ValueError, match=message):
        notebook.resolutions("layers", given)


def test_a_parameter_that_the_notebook_does_not_have_is_refused(monkeypatch):
    class Shell:
        user_ns = {"In": ["", "runs: int = 20", "# Parameters\nruns = 4\nrunz = 3\n", "notebook.begin(runs, 1, 0)"]}

    monkeypatch.setattr(notebook, "get_ipython", Shell)
    with pytest.raises(ValueError, match="a parameter must be one of runs, steps, seed.*, but is runz"):
        notebook.begin(runs=4, steps=1, seed=0)


def test_a_notebook_begins_with_typed_parameters_and_hidden_imports(cells):
    parameters, imports = [cell for cell in cells if cell.cell_type == "code"][:2]
    assert [cell for cell in cells if "parameters" in tags(cell)] == [parameters]
    statements = ast.parse(parameters.source).body
    assert all(isinstance(statement, ast.AnnAssign) for statement in statements)
    assert {"runs", "steps", "seed"} <= {statement.target.id for statement in statements}
    assert re.match(r"# .*\b(seconds|minutes?)\b", parameters.source)
    assert HIDDEN & tags(imports)
    *imported, begun = ast.parse(imports.source).body
    assert all(isinstance(each, (ast.Import, ast.ImportFrom)) for each in imported)
    assert ast.unparse(begun).startswith("notebook.begin(")
