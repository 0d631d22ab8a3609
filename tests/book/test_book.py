"""The book's own Sphinx extensions, tested on small books: links to the repository, and the reference pages."""

import re
import shutil
import subprocess
import sys
from html import unescape
from pathlib import Path

from extensions import docstrings
from extensions import launch
import nbformat
import pytest

ROOT = Path(__file__).parents[2]
PUBLIC = sorted(".".join(path.relative_to(ROOT / "neorl").with_suffix("").parts).removesuffix(".__init__")
                for path in (ROOT / "neorl").rglob("*.py"))


# Whose pages have what the tests look for: types, defaults, fields, properties, and names of other modules.
MODULES = [f"neorl.{name}" for name in (
    "agents.agent", "agents.individual", "agents.learner", "agents.rules", "core.choices", "core.maps",
    "core.modality", "core.scene", "experiments.condition", "experiments.result", "experiments.run",
    "experiments.simulation", "kernels.kernel", "worlds", "worlds.world", "worlds.arena", "worlds.arm")] + [
        "companion.other_spaces.trials", "companion.study.sensitivity"]


def make_book(folder, url="", modules=("companion.shared.grid",)):
    """Build a book of two pages with our settings; returns the folder of its HTML."""
    chapters = folder / "book" / "chapters"
    chapters.mkdir(parents=True)
    for name in ("extensions", "references.bib", "templates", "vendor"):
        (folder / "book" / name).symlink_to(ROOT / "book" / name)
    shutil.copy(ROOT / "_config.yml", folder)
    (folder / "pyproject.toml").write_text(f'[project.urls]\nRepository = "{url}"' if url else "[project]")
    toc = "format: jb-book\nroot: index\nchapters:\n  - file: chapters/page\n  - file: glossary\n"
    (folder / "book" / "_toc.yml").write_text(toc)
    reference = "\n\n".join(f".. automodule:: {module}" for module in modules)
    glossary = "# Terms\n\n```{glossary}\nN7\nmap\n  Cells of a *space*.\n```\n"
    (folder / "book" / "glossary.md").write_text(glossary)
    (folder / "book" / "index.md").write_text(
        "# Reference\n\nAll of it, and $x$.\n\n{term}`N7`\n\n% The repository is at <URL>.\n\n"
        f"```{{eval-rst}}\n{reference}\n```\n")
    kernel = {"kernelspec": {"name": "python3", "display_name": "Python 3"},
              "language_info": {"name": "python", "pygments_lexer": "ipython3"}}
    cells = [nbformat.v4.new_markdown_cell("# Page"), nbformat.v4.new_code_cell("1")]
    nbformat.write(nbformat.v4.new_notebook(cells=cells, metadata=kernel), chapters / "page.ipynb")
    (folder / "notebooks").mkdir()
    (folder / "notebooks" / "page.ipynb").write_text("as it runs")
    command = [Path(sys.executable).with_name("jupyter-book"), "build", "book", "--config", "_config.yml",
               "--path-output", ".", "--all", "--quiet", "--warningiserror", "--nitpick"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    return folder / "_build" / "html"


def test_a_notebook_opens_from_the_repository_that_is_set(tmp_path):
    html = make_book(tmp_path, "https://github.com/somebody/neorl")
    page, reference = ((html / name).read_text(encoding="utf-8") for name in ("chapters/page.html", "index.html"))
    assert "https://mybinder.org/v2/gh/somebody/neorl/main?urlpath=lab/tree/notebooks/page.ipynb" in page
    assert "https://colab.research.google.com/github/somebody/neorl/blob/main/notebooks/page.ipynb" in page
    assert 'href="https://github.com/somebody/neorl"' in page
    assert 'href="../_sources/chapters/page.ipynb"' in page
    assert (html / "_sources" / "chapters" / "page.ipynb").read_text() == "as it runs"
    assert "mybinder" not in reference  # no notebook
    assert "The repository is at <a" in reference
    assert '<meta name="description" content="All of it, and x." />' in reference
    assert '<meta property="og:image" content="../_static/card.png" />' in page


@pytest.fixture(scope="module")
def html(tmp_path_factory):
    """A book without the address of a repository."""
    return make_book(tmp_path_factory.mktemp("book"), modules=MODULES)


@pytest.fixture(scope="module")
def reference(html):
    return (html / "index.html").read_text(encoding="utf-8")


def test_a_link_to_a_term_shows_its_definition(reference):
    assert re.search('<a [^>]*href="glossary.html#term-N7"[^>]* title="Cells of a space."', reference)


def test_parts_of_a_page_have_names_and_roles(html, open_page):
    page = open_page(html, "index.html")
    page.get_by_role("complementary", name="Book").wait_for()
    assert page.locator(".search-button-field").first.get_attribute("aria-label") is None


def test_without_a_repository_there_are_no_buttons_and_docstrings_become_lists_with_links(html, reference, open_page):
    page = (html / "chapters" / "page.html").read_text(encoding="utf-8")
    assert "mybinder" not in page and "colab" not in page and "fa-github" not in page
    text = re.sub(r"<[^>]+>", "", reference)
    assert "The repository is at" not in text and "built without the address of its repository" in text
    assert "Raises ValueError" in text
    of_store = reference.split('id="neorl.experiments.simulation.simulate"')[1].split("</article>")[0]
    assert re.search(r'href="#neorl.experiments.result.Result"[^>]*><code[^>]*><span class="pre">Result', of_store)
    assert "float64 (actions,): the value of each action" in text  # a comment beside a field
    assert "Alias for field number" not in text
    found = open_page(html, "search.html?q=simulate", "file")
    found.get_by_text("Search finished").wait_for()  # without a console error, as always


def test_a_command_names_the_repository_that_is_set(tmp_path, monkeypatch):
    text = (ROOT / "book" / "running.md").read_text(encoding="utf-8")
    for address, wanted in (("https://example.org/n", "git clone --depth 1 https://example.org/n neorl"),
                            (None, "git clone --depth 1 URL neorl")):
        monkeypatch.setattr(launch, "repository", lambda app: address)
        launch.name_repository(None, "running", source := [text])
        assert wanted in source[0] and launch.ASKED not in source[0]
        assert (launch.FOR_URL in source[0]) == (address is None)


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


def test_a_name_links_to_its_room_or_below_and_an_argument_to_nothing(reference):
    of_arm = reference.split('id="neorl.worlds.arm.Arm"')[1].split("</dl>")[0]
    assert ">lengths<" in of_arm and "#companion.other_spaces.trials.lengths" not in of_arm
    of_axis = reference.split('id="neorl.core.modality.Axis"')[1].split("</dl>")[0]
    assert "#neorl.core.maps.NresMap.intervals" not in of_axis
    assert 'href="#neorl.kernels.kernel.kernel" title' in of_axis  # neorl.kernel
    of_individual = reference.split('id="neorl.agents.individual.Individual"')[1].split("</dl>")[0]
    assert "#neorl.agents.learner.Learner" in of_individual  # which its module does not import
    assert 'href="#neorl.experiments.run.Run"' in of_individual
    of_room = reference.split('id="module-neorl.worlds"')[1].split('id="module-neorl.worlds.world"')[0]
    assert ">kinds<" in of_room and "Arena.kinds" not in of_room
    of_worlds = reference.split('id="module-neorl.worlds.world"')[1].split('id="neorl.worlds.world.Dynamics"')[0]
    assert "Arena.kinds" not in of_worlds and 'href="#module-neorl.core.scene"' not in of_worlds
    of_choices = reference.split('id="neorl.core.choices.MapState"')[1].split("</dl>")[0]
    assert "object</span></code> 0, " in of_choices and "qualname" not in of_choices


def test_the_reference_has_types_and_defaults_as_in_code(reference):
    signatures = " ".join(re.findall(r'<dt class="sig[^>]*>(.*?)</dt>', reference, re.DOTALL))
    signatures = " ".join(unescape(re.sub(r"<[^>]+>", "", signatures)).split())
    for written in ("learning: Learning = Learning(), policy: Policy = Policy(),", "choose: Callable = greedy)",
                    "modality: Modality = PLACE_CELL)", "property table: NDArray[np.float64]",
                    "position: array('float64', 'axes')"):
        assert written in signatures
    assert not re.search(r"[~<]|Path\(|_Buffer|numpy", signatures)


def test_the_reference_has_every_module():
    pages = "".join(path.read_text(encoding="utf-8") for path in (ROOT / "book").glob("api_*.md"))
    listed = re.findall(r"automodule:: neorl\.([\w.]+)", pages)
    assert sorted(listed) == [name for name in PUBLIC if name not in ("__init__", "__main__")]
