"""Names are written by strangers: pages show them as they are, and never read them as markup."""

import re
from pathlib import Path

import pytest
from companion.shared.replay import Replay, record
from explorer_page import drop_by_keyboard, explorer_of, picture, press, wait, write_page
from playwright.sync_api import expect

from neorl import Agent, Desire, Explorer, Node, Run, WaterWorld, modality, place_cells, simulate
from neorl.custom import Modality
from neorl.worlds import Arena

ROOT = Path(__file__).parents[2]


def hostile(name):
    return f"""{name}<img src="x" onerror="window.hit = '{name}'"><b>"&lt;'</b>"""


PLACES, THINGS = hostile("places"), hostile("things")
FOOD, SHOCK = hostile("food"), hostile("shock")
MAZE = Arena(places=[(FOOD, 0.8, 0.2), (SHOCK, 0.3, 0.7), ("constructor", 0.5, 0.5)], pay=[1.0, -1.0, 1.0])
NETWORK = Agent([Node(PLACES, modality.PLACE_CELL, [3]), Node(THINGS, modality.OBJECT_VECTOR_CELL, [3]),
                 Node("__proto__", modality.PLACE_CELL, [5])],
                [Desire("green", PLACES, 1.0), Desire("red", THINGS, -1.0), Desire(PLACES, THINGS, 1.0),
                 Desire(THINGS, "__proto__", 1.0)])
IN_MAZE = Agent([Node(PLACES, Modality(hostile("modality"), modality.PLACE_CELL.axes), [4])],
                [Desire(kind, PLACES, 1.0) for kind in MAZE.kinds])
CONDITIONS = {hostile("network"): simulate(NETWORK, WaterWorld(), steps=4_000, runs=2, progress=False),
              hostile("maze"): simulate(IN_MAZE, MAZE, steps=4_000, runs=2, progress=False)}


@pytest.fixture
def visit(open_page, tmp_path):
    """`visit(widget, address)` opens a page with a widget. By the end, no name has been read as markup."""
    pages = []

    def visit(widget, address=""):
        write_page(tmp_path, [widget])
        pages.append(open_page(tmp_path, f"page.html{address}"))
        return pages[-1]
    yield visit
    for page in pages:
        picture(page, "canvas >> nth=0")
        assert page.evaluate("window.hit") is None
        assert page.locator(".neorl-explorer img, .neorl-explorer script").count() == 0
        assert page.evaluate("[...document.querySelectorAll('b')].every((each) => !each.textContent.startsWith('\"'))")


def explorer(name, **traits):
    return Explorer(CONDITIONS, hostile(name), **{"playing": False, "speed": 0.0} | traits)


def test_names_of_nodes_and_conditions_are_shown_as_they_are(visit):
    page = visit(explorer("network"))
    explorer_of(page)
    press(page, "play")
    wait(page, "ended")
    expect(page.locator('[name="preset"] option:checked')).to_have_text(hostile("network"))
    for n, name in enumerate((PLACES, THINGS, "__proto__")):
        expect(page.locator(f'label:has([name="gain-{n}"]) span')).to_have_text(f"Gain of {name}")
    maps = page.locator('[name="map"] option')
    expect(maps).to_have_text([f"{PLACES}, 3 × 3", f"{THINGS}, 3 × 3", "__proto__, 5 × 5"])
    assert [each.get_attribute("value") for each in maps.all()] == [f"{PLACES} N3", f"{THINGS} N3", "__proto__ N5"]
    key = page.locator(".key li", has_text="Dashed: the desire vectors of nodes: ")
    expect(key.locator("b").first).to_have_text(PLACES)
    expect(page.locator(".legend")).to_contain_text(f"runs of {hostile('network')} lie")
    page.locator('[name="map"]').select_option(f"{THINGS} N3")
    expect(page.locator(".neorl-explorer")).to_have_attribute("data-map", f"{THINGS} N3")
    with page.expect_download() as download:
        press(page, "picture")
    assert re.fullmatch(r"[a-z0-9-]+-run-0\.png", download.value.suggested_filename)


def test_names_in_a_second_tank_and_on_the_tour_are_shown_as_they_are(visit):
    page = visit(explorer("network", control="preset"))
    explorer_of(page)
    press(page, "tour")
    press(page, "end")
    press(page, "compare")
    page.locator('[name="beside"]').select_option("Place cells")
    expect(page.locator(".named").first).to_contain_text(f"{hostile('network')}: ")
    expect(page.locator(".named").nth(1)).to_contain_text("Place cells")


def test_kinds_of_things_are_shown_and_saved_as_they_are(visit):
    page = visit(explorer("maze"))
    explorer_of(page)
    drop_by_keyboard(page)
    expect(page.locator(".wants")).to_have_text(f"Wants: {FOOD} +1, {SHOCK} +1, constructor +1, element +1")
    press(page, "play")
    wait(page, "ended")
    expect(page.locator(".of-catches")).to_contain_text(f"Met a minute: {FOOD} ")
    expect(page.locator(".unseen").first).to_contain_text(f"1 {SHOCK}")
    with page.expect_download() as download:
        press(page, "csv")
    quoted = [f'''"{kind.replace('"', '""')}"''' for kind in (FOOD, SHOCK)]
    assert download.value.path().read_text().splitlines()[0] == ",".join(["second", "reward", *quoted, "constructor"])


def test_an_address_is_never_read_as_markup(visit):
    page = visit(explorer("network"), "#explorer_agent-<img src=x onerror=window.hit=1>_start-<b>")
    expect(page.locator(".refused")).to_contain_text("There is no agent “%3Cimg")


def test_names_of_recordings_are_shown_as_they_are(visit):
    page = visit(Replay([record(hostile("run"), Run(place_cells([3]), WaterWorld()), 10)], playing=False))
    expect(page.locator(".title")).to_have_text(hostile("run"))
    expect(page.get_by_role("img", name=f"The tank: {hostile('run')}", exact=True)).to_be_visible()


# Where our scripts read markup, and what: constants of their own source.
READS = re.compile(r"innerHTML|outerHTML|insertAdjacentHTML|document\.write|createContextualFragment|setHTML|parseFrom"
                   r"|DOMParser|srcdoc|\beval\(|new Function|(?<!function )\belementOf\((.*)$", re.MULTILINE)
CONSTANTS = {
    "neorl/browser/elements.js": ["template.innerHTML = markup;"],
    "neorl/browser/panel.js": ["this.root = elementOf(pageOf("],  # of a random number
    "neorl/browser/shared.js": ["other.replaceChildren(elementOf(ELSEWHERE))"],
    "neorl/browser/waiting.js": ["const root = elementOf(WAITING);"],
    "neorl/browser/legend.js": ["elementOf(PICTURES[kind])"],
    "neorl/browser/controls.js": ['elementOf(slide(`gain-${index}`, "", 0, 5, 0.1))'],
    "book/explorer.md": ["?.insertAdjacentHTML("],
    "notebooks/companion/chapter_4/changes.js": ["this.root = elementOf(MARKUP);"],
    "notebooks/companion/chapter_5/turn.js": ["this.root = elementOf(MARKUP);"],
    "notebooks/companion/recordings/steering.js": ["this.root = elementOf(MARKUP);"],
    "notebooks/companion/shared/replay.js": ["this.root = elementOf(MARKUP);", "const tank = elementOf(TANK);"]}


def test_scripts_read_no_markup_but_constants_of_their_own_source():
    found = {}
    for folder, endings in (("neorl", ".js"), ("book", ".js .md .html"), ("notebooks", ".js")):
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix in endings.split() and not {"_build", "chapters"} & {*path.parts}:
                lines = [line.strip() for line in path.read_text().splitlines() if READS.search(line)]
                found |= {path.relative_to(ROOT).as_posix(): lines} if lines else {}
    assert found.keys() == CONSTANTS.keys()
    for name, lines in found.items():
        assert len(lines) == len(CONSTANTS[name]) and all(map(str.__contains__, lines, CONSTANTS[name])), (name, lines)
