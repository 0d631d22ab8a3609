"""The script that runs anywidgets in pages without a kernel, tested on hand-made pages."""

import base64
import json
import shutil
from pathlib import Path

import pytest

HOST = Path(__file__).parents[2] / "book" / "vendor" / "widgets.js"
STATE = "application/vnd.jupyter.widget-state+json"
VIEW = "application/vnd.jupyter.widget-view+json"

COUNTER = """
window.imports = (window.imports ?? 0) + 1;
function render({ model, el }) {
  el.className = "counter";
  const write = () => { el.textContent = model.get("count"); };
  model.on("change:count", write);
  el.addEventListener("click", () => { model.set("count", model.get("count") + 1); model.save_changes(); });
  write();
}
export default { render };
"""


def anywidget(esm, buffers=(), **values):
    return {"model_name": "AnyModel", "model_module": "anywidget", "model_module_version": "~0.11.*",
            "state": {"_esm": esm, **values},
            "buffers": [{"encoding": "base64", "path": path, "data": data} for path, data in buffers]}


@pytest.fixture
def show(open_page, tmp_path):
    """`show(records, views, state)` opens a page: records by model, and JSON texts of its views and its whole state."""
    def show(records, views=None, state=None, over="http"):
        state = json.dumps({"version_major": 2, "state": records}) if state is None else state
        views = [json.dumps({"model_id": model}) for model in records] if views is None else views
        scripts = [(STATE, state), *((VIEW, view) for view in views)]
        tags = [f'<script type="{kind}">{text}</script>' for kind, text in scripts]
        shutil.copy(HOST, tmp_path)
        head = '<meta charset="utf-8"><link rel="icon" href="data:,"><script defer src="widgets.js"></script>'
        (tmp_path / "page.html").write_text(f"<!doctype html>{head}<body>{''.join(tags)}")
        return open_page(tmp_path, "page.html", over)
    return show


def sentences(page, number):
    """The messages that the page shows in place of widgets, once there are `number` of them."""
    alerts = page.get_by_role("alert")
    alerts.nth(number - 1).wait_for()
    return alerts.all_inner_texts()


@pytest.mark.parametrize("over", ["http", "file"])
def test_a_widget_starts_and_responds(show, over):
    page = show({"one": anywidget(COUNTER, count=3)}, over=over)
    page.locator(".counter", has_text="3").click()
    page.locator(".counter", has_text="4").wait_for()


def test_bytes_arrive_as_a_view_of_them(show):
    esm = """export default { render({ model, el }) {
        const [bytes, inner] = [model.get("bytes"), model.get("tree").list[1].inner];
        const seen = [bytes, inner].map((view) => `${view.constructor.name} ${view.byteLength} ${view.getUint8(1)}`);
        el.append(seen.join(", "));
        el.className = "seen"; } }"""
    encoded = [base64.b64encode(data).decode() for data in (bytes([0, 255, 128]), bytes([1, 2]))]
    buffers = [(["bytes"], encoded[0]), (["tree", "list", 1, "inner"], encoded[1])]
    page = show({"one": anywidget(esm, buffers, tree={"list": [None, {}]})})
    assert page.locator(".seen").inner_text() == "DataView 3 255, DataView 2 2"


def test_widgets_of_one_class_share_its_module_and_not_their_state(show):
    page = show({"one": anywidget(COUNTER, count=1), "two": anywidget(COUNTER, count=5)})
    page.locator(".counter", has_text="1").click()
    page.locator(".counter", has_text="2").wait_for()
    assert page.locator(".counter").all_inner_texts() == ["2", "5"]
    assert page.evaluate("window.imports") == 1


def test_the_model_reports_changes_and_a_view_removes_only_its_own_listeners(show):
    esm = """export default { async render({ model, el }) {
        const seen = [];
        const react = (_, value) => seen.push(value);
        const other = await model.widget_manager.get_model("IPY_MODEL_one");
        model.on("change:list change:number", react);
        model.on("change", () => seen.push("any"));
        other.on("change:number", () => seen.push("other"));
        model.set("list", [1, { two: 2 }]);          // unchanged: no event
        model.set({ list: [1], number: 5 });
        model.off("change:number", react);
        model.set({ list: [2], number: 6 });
        model.off();
        model.set("number", 7);
        model.save_changes();
        model.send({});
        el.append(JSON.stringify(seen));
        el.className = "seen"; } }"""
    page = show({"one": anywidget(esm, list=[1, {"two": 2}], number=4)})
    assert json.loads(page.locator(".seen").inner_text()) == [[1], 5, "other", "any", [2], "other", "any", "other"]


GOOD = anywidget(COUNTER, count=3)
FAILING = "export default { render({ el }) { el.append('half'); throw new Error('no WebAssembly'); } };"


@pytest.mark.parametrize("record, sentence", [
    (anywidget(FAILING), "This widget could not start (Error: no WebAssembly)."),
    (anywidget("export default"), "This widget could not start (SyntaxError: "),
    (anywidget(None), "This widget cannot be shown: what the page keeps of it is missing or damaged."),
    (anywidget(COUNTER, [(["lost", "bytes"], "AAAA")]), "This widget cannot be shown"),
    ({"model_module": "@jupyter-widgets/controls", "state": {}}, "This widget needs a running kernel."),
    (None, "This widget cannot be shown")])
def test_a_widget_that_does_not_start_says_so_and_the_next_one_runs(show, record, sentence):
    page = show({"bad": record, "good": GOOD})
    (said,) = sentences(page, 1)
    assert said.startswith(sentence)
    assert "half" not in page.inner_text("body")
    page.locator(".counter", has_text="3").click()
    page.locator(".counter", has_text="4").wait_for()


@pytest.mark.parametrize("state", ["{", "null", '{"state": {"two": {}}}'])
def test_without_its_state_a_widget_says_so(show, state):
    said = sentences(show({"one": None, "two": None}, state=state), 2)
    assert said == ["This widget cannot be shown: what the page keeps of it is missing or damaged."] * 2


def test_a_widget_that_never_finishes_starting_delays_no_other(show):
    page = show({"slow": anywidget("export default { render: () => new Promise(() => {}) };"), "good": GOOD})
    assert page.locator(".counter").inner_text() == "3"
