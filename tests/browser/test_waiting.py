"""Living figures go on while their kernels are being compiled, and say so in the page."""

import base64
import threading

import numpy as np
import pytest
from explorer_page import wait, write_page
from playwright.sync_api import expect

from companion.chapter_5.turn import Turn
from neorl import Condition, Explorer, WaterWorld, place_cells
from neorl.browser import wasm

TANK = WaterWorld()
PLACES = Condition(place_cells([3]), TANK, 6_000, 1)
TURNING = Condition(PLACES.agent, TANK, 6_000, 1, 0, ((3_000, PLACES.agent),))


@pytest.fixture
def build(monkeypatch):
    """No module on disk, in a session of JupyterLab: `build(contents)` ends the build, which may fail."""
    built, contents, before = threading.Event(), {}, wasm.modules()

    def modules():
        assert built.wait(60)
        if not contents:
            raise RuntimeError("no linker")
        return contents

    def build(found=before):
        contents.update(found)
        built.set()
        return contents

    monkeypatch.setenv("JPY_SESSION_NAME", "paper_a.ipynb")
    monkeypatch.setattr(wasm, "found", dict)
    monkeypatch.setattr(wasm, "modules", modules)
    yield build
    built.set()


def awaited(figure, trait):
    """Let a figure change a trait, after what is to be done."""
    changed = threading.Event()
    figure.observe(lambda _: changed.set(), trait)
    return lambda: changed.wait(60)


@pytest.mark.parametrize("make, names", [(lambda: Explorer(PLACES), ["plane", "helm"]),
                                         (lambda: Turn(TURNING, TURNING), ["plane"])])
def test_a_figure_has_its_kernels_once_they_are_compiled(build, make, names):
    figure = make()
    assert figure._wasm == {} and figure._compiling["since"] > 0
    has_kernels = awaited(figure, "_wasm")
    contents = build()
    assert has_kernels() and figure._wasm == {name: contents[name] for name in names}


def test_a_notebook_without_a_reader_waits_for_them(build, monkeypatch):
    monkeypatch.delenv("JPY_SESSION_NAME")
    contents = build()
    explorer = Explorer(PLACES)
    assert (explorer._wasm, explorer._compiling) == (contents, {})


def test_the_page_says_why_they_could_not_be_compiled(build, open_page, tmp_path):
    explorer = Explorer(PLACES)
    has_failed = awaited(explorer, "_compiling")
    build({})
    assert has_failed()
    write_page(tmp_path, [explorer])
    expect(open_page(tmp_path, "page.html").locator("[role=alert]")).to_have_text(
        "The kernels for the browser were not compiled: no linker")


def test_until_they_are_ready_the_page_says_so_over_the_recorded_curve_and_then_begins(build, open_page, tmp_path):
    rising = np.linspace(0, 1, 50)
    explorer = Explorer({"places": PLACES}, behind={"places": (2, rising, rising, rising, "the record, 7 runs")})

    def change(record):
        kept = "model = host.model;"
        assert record["state"]["_esm"].count(kept) == 1
        record["state"]["_esm"] = record["state"]["_esm"].replace(kept, f"{kept} window.kept = model;")

    write_page(tmp_path, [explorer], change)
    page = open_page(tmp_path, "page.html")
    wait(page, "compiling")
    said = page.locator("[role=timer]")
    expect(said).to_contain_text("Compiling the kernels for the browser, once: ")
    seconds = said.inner_text()
    expect(said).not_to_have_text(seconds)  # it counts
    expect(page.locator(".legend")).to_have_text("the record, 7 runs")
    assert page.locator("canvas").evaluate("canvas => canvas.getContext('2d').getImageData(0, 0, canvas.width, "
                                           "canvas.height).data.some((value) => value > 0)")
    modules = {name: base64.b64encode(content).decode() for name, content in build().items()}
    page.evaluate("""modules => window.kept.set("_wasm", Object.fromEntries(Object.entries(modules).map(
        ([name, text]) => [name, Uint8Array.from(atob(text), (byte) => byte.charCodeAt(0))])))""", modules)
    wait(page, "running|ended")
    expect(said).to_have_count(0)


def test_a_page_saved_before_they_were_ready_does_not_wait_for_ever(build, open_page, tmp_path):
    explorer = Explorer(PLACES)
    write_page(tmp_path, [explorer], lambda record: record["state"]["_compiling"].update(since=1e9))
    expect(open_page(tmp_path, "page.html").locator("[role=alert]")).to_contain_text("does not hold its _wasm")
