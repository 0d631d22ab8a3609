"""The book's own Sphinx extensions, tested on small books: links to the repository, and the reference pages."""

import html
import re
import shutil
import subprocess
import sys
from pathlib import Path

import nbformat
import pytest

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "book"))
import docstrings  # noqa: E402
import launch  # noqa: E402
PUBLIC = sorted(".".join(path.relative_to(ROOT / "neorl").with_suffix("").parts).removesuffix(".__init__")
                for path in (ROOT / "neorl").rglob("*.py"))


@pytest.fixture
def make_book(tmp_path):
    """`make_book(url, modules)` builds a book of two pages with our settings and returns their HTML."""

    def make(url="", modules=("lib.shared.grid",)):
        shutil.rmtree(tmp_path / "book", ignore_errors=True)
        chapters = tmp_path / "book" / "chapters"
        chapters.mkdir(parents=True)
        for name in ("launch.py", "docstrings.py", "terms.py", "typeset.py", "references.bib", "templates", "vendor"):
            (tmp_path / "book" / name).symlink_to(ROOT / "book" / name)
        shutil.copy(ROOT / "_config.yml", tmp_path)
        (tmp_path / "pyproject.toml").write_text(f'[project.urls]\nRepository = "{url}"' if url else "[project]")
        toc = "format: jb-book\nroot: index\nchapters:\n  - file: chapters/page\n  - file: glossary\n"
        (tmp_path / "book" / "_toc.yml").write_text(toc)
        reference = "\n\n".join(f".. automodule:: {module}" for module in modules)
        glossary = "# Terms\n\n```{glossary}\nN7\nmap\n  Cells of a *space*.\n```\n"
        (tmp_path / "book" / "glossary.md").write_text(glossary)
        (tmp_path / "book" / "index.md").write_text(
            "# Reference\n\nAll of it, and $x$.\n\n{term}`N7`\n\n% The repository is at <URL>.\n\n"
            f"```{{eval-rst}}\n{reference}\n```\n")
        kernel = {"kernelspec": {"name": "python3", "display_name": "Python 3"},
                  "language_info": {"name": "python", "pygments_lexer": "ipython3"}}
        cells = [nbformat.v4.new_markdown_cell("# Page"), nbformat.v4.new_code_cell("1")]
        nbformat.write(nbformat.v4.new_notebook(cells=cells, metadata=kernel), chapters / "page.ipynb")
        (tmp_path / "notebooks").mkdir(exist_ok=True)
        (tmp_path / "notebooks" / "page.ipynb").write_text("as it runs")
        command = [Path(sys.executable).with_name("jupyter-book"), "build", "book", "--config", "_config.yml",
                   "--path-output", ".", "--all", "--quiet", "--warningiserror", "--nitpick"]
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
        assert done.returncode == 0, done.stdout + done.stderr
        html = tmp_path / "_build" / "html"
        return [(html / name).read_text(encoding="utf-8") for name in ("chapters/page.html", "index.html")]

    return make


def test_a_notebook_opens_from_the_repository_that_is_set(make_book, tmp_path):
    page, reference = make_book("https://github.com/somebody/neorl")
    assert "https://mybinder.org/v2/gh/somebody/neorl/main?urlpath=lab/tree/notebooks/page.ipynb" in page
    assert "https://colab.research.google.com/github/somebody/neorl/blob/main/notebooks/page.ipynb" in page
    assert 'href="https://github.com/somebody/neorl"' in page
    assert 'href="../_sources/chapters/page.ipynb"' in page
    assert (tmp_path / "_build" / "html" / "_sources" / "chapters" / "page.ipynb").read_text() == "as it runs"
    assert "mybinder" not in reference  # no notebook
    assert "The repository is at <a" in reference
    assert '<meta name="description" content="All of it, and x." />' in reference
    assert '<meta property="og:image" content="../_static/card.png" />' in page
    assert "tex-chtml.js" not in page and "tex-chtml.js" in reference
    assert 'span class="unbroken"><span class="math notranslate nohighlight">\\(x\\)</span>.</span>' in reference
    icons = tmp_path / "_build" / "html" / "_static" / "scripts" / "fontawesome.js"
    assert icons.stat().st_size < 1000  # the theme's, which is not needed, has 1.5 MB


def test_a_link_to_a_term_shows_its_definition(make_book):
    _, reference = make_book()
    assert re.search('<a [^>]*href="glossary.html#term-N7"[^>]* title="Cells of a space."', reference)


def test_parts_of_a_page_have_names_and_roles(make_book, open_page, tmp_path):
    make_book()
    page = open_page(tmp_path / "_build" / "html", "index.html")
    page.get_by_role("complementary", name="Book").wait_for()
    assert page.locator(".search-button-field").first.get_attribute("aria-label") is None


def test_without_a_repository_there_are_no_buttons_and_docstrings_become_lists_with_links(make_book, open_page,
                                                                                          tmp_path):
    page, reference = make_book(modules=["neorl.agents.individual", "neorl.experiments.run",
                                         "neorl.experiments.simulation", "neorl.experiments.result",
                                         "neorl.experiments.condition"])
    assert "mybinder" not in page and "colab" not in page and "fa-github" not in page
    text = re.sub(r"<[^>]+>", "", reference)
    assert "The repository is at" not in text and "built without the address of its repository" in text
    assert "Raises ValueError" in text
    of_store = reference.split('id="neorl.experiments.simulation.simulate"')[1].split("</article>")[0]
    assert re.search(r'href="#neorl.experiments.result.Result"[^>]*><code[^>]*><span class="pre">Result', of_store)
    assert "float64 (actions,): the value of each action" in text  # a comment beside a field
    assert "Alias for field number" not in text
    search = (tmp_path / "_build" / "html" / "_static" / "language_data.js").read_text(encoding="utf-8")
    assert "var Scorer" in search  # book/vendor/search_order.js
    found = open_page(tmp_path / "_build" / "html", "search.html?q=simulate", "file")
    found.get_by_text("Search finished").wait_for()  # without a console error, as always


def test_a_command_names_the_repository_that_is_set(tmp_path, monkeypatch):
    text = (ROOT / "book" / "running.md").read_text(encoding="utf-8")
    for address, wanted in (("https://example.org/n", 'git+https://example.org/n"`.'), (None, 'git+URL"`, with the')):
        monkeypatch.setattr(launch, "repository", lambda app: address)
        launch.name_repository(None, "running", source := [text])
        assert wanted in source[0] and launch.ASKED not in source[0]


@pytest.mark.parametrize("lines, read", [
    (["Speeds: float64 (steps,). step: seconds.", "", "seed: integer ≥ 0."],
     ["Speeds: float64 (steps,).", "* ``step``: seconds.", "* ``seed``: integer ≥ 0."]),
    (["A walk.", "", "steps: integer ≥ 1. seed:", "integer ≥ 0.", "", "Any other text."],
     ["A walk.", "* ``steps``: integer ≥ 1.", "* ``seed``:", "  integer ≥ 0.", "Any other text."]),
    (["A cell.", "", "1. Neighbours: its own. It may have", "   none: an edge counts."],
     ["A cell.", "1. Neighbours: its own. It may have", "   none: an edge counts."]),  # no items
    (["A map.", "", "size: of the map. Raises ValueError otherwise.", "one, two, three, four, five: numbers."],
     ["A map.", "* ``size``: of the map.", "* Raises ValueError otherwise.",
      "* ``one, two, three, four, five``: numbers."]),
    (["A map.", "", "Returns one. Raises OSError."], ["A map.", "* Returns one.", "* Raises OSError."])])
def test_a_docstring_opens_with_a_sentence_and_lists_what_follows(lines, read):
    docstrings.read_docstring(None, "function", "speed", None, None, lines)
    assert [line for line in lines if line] == read


def test_a_name_links_to_its_room_or_below_and_an_argument_to_nothing(make_book):
    _, reference = make_book(modules=[f"neorl.{name}" for name in (
        "core.kernel", "core.modality", "core.maps", "core.choices", "core.scene", "worlds", "worlds.world",
        "worlds.arena", "worlds.arm", "agents.individual", "agents.learner",
        "experiments.run")] + ["lib.other_spaces.trials"])
    of_arm = reference.split('id="neorl.worlds.arm.Arm"')[1].split("</dl>")[0]
    assert ">lengths<" in of_arm and "#lib.other_spaces.trials.lengths" not in of_arm
    of_axis = reference.split('id="neorl.core.modality.Axis"')[1].split("</dl>")[0]
    assert "#neorl.core.maps.NresMap.intervals" not in of_axis
    assert 'href="#neorl.core.kernel.kernel" title' in of_axis  # neorl.kernel
    of_individual = reference.split('id="neorl.agents.individual.Individual"')[1].split("</dl>")[0]
    assert "#neorl.agents.learner.Learner" in of_individual  # which its module does not import
    assert 'href="#neorl.experiments.run.Run"' in of_individual
    of_room = reference.split('id="module-neorl.worlds"')[1].split('id="module-neorl.worlds.world"')[0]
    assert ">kinds<" in of_room and "Arena.kinds" not in of_room
    of_worlds = reference.split('id="module-neorl.worlds.world"')[1].split('id="neorl.worlds.world.Dynamics"')[0]
    assert "Arena.kinds" not in of_worlds and 'href="#module-neorl.core.scene"' not in of_worlds
    of_choices = reference.split('id="neorl.core.choices.MapState"')[1].split("</dl>")[0]
    assert "object</span></code> 0, " in of_choices and "qualname" not in of_choices


def test_the_reference_has_types_and_defaults_as_in_code(make_book):
    _, reference = make_book(modules=[f"neorl.{name}" for name in (
        "agents.agent", "agents.papers", "agents.rules", "browser.replay", "checks", "core.maps", "core.scene",
        "drawing.curves\n\n.. autodata:: neorl.core.modality.MOST_CELLS\n   :no-value:")] + [
            "lib.study.calibration_table", "lib.study.multiverse"])
    signatures = " ".join(re.findall(r'<dt class="sig[^>]*>(.*?)</dt>', reference, re.DOTALL))
    signatures = " ".join(html.unescape(re.sub(r"<[^>]+>", "", signatures)).split())
    for written in ("learning: Learning = Learning(), policy: Policy = Policy(),", "choose: Callable = greedy)",
                    "statistics: dict = dict())", "read_table(path=SHIPPED)",
                    "draw_curves(xs: ArrayLike, curves: Mapping[str, ArrayLike],", "(name: str, array: NDArray, ",
                    "→ NDArray[np.float64]", "modality: Modality = PLACE_CELL)", "property table: NDArray[np.float64]",
                    "position: array('float64', 'axes')", "Replay(recordings, playing=True, speed=1)",
                    "resolutions: Sequence[int] = (2, 3, 5, 7, 11, 13),", "at_least: float = -1e+30,"):
        assert written in signatures
    assert not re.search(r"[~<]|Path\(|_Buffer|ndarray", signatures)
    assert "−`" not in reference
    of_page = " ".join(re.sub(r"<[^>]+>", "", reference.split('id="module-lib.study.multiverse"')[1]).split())
    assert "estimated from ENOUGH = 32 readings or more" in of_page  # a constant without an entry
    of_constant = reference.split('id="neorl.core.modality.MOST_CELLS"')[1].split("</dl>")[0]
    assert "2 ** 31 - 1 of a map" in " ".join(re.sub(r"<[^>]+>", "", of_constant).split())
    assert 'href="#neorl.core.modality.MOST_CELLS" title' in reference.split('id="neorl.core.maps.NresMap"')[1]


def test_the_reference_has_every_module():
    pages = "".join(path.read_text(encoding="utf-8") for path in (ROOT / "book").glob("api_*.md"))
    listed = re.findall(r"automodule:: neorl\.([\w.]+)", pages)
    assert sorted(listed) == [name for name in PUBLIC if name not in ("__init__", "__main__")]
