"""JupyterLab itself, which renders outputs off screen: the Explorer's colours, links and views, and every page's."""

import json
import os
import re
import subprocess
import sys
import time

import nbformat
import pytest
from conftest import PATIENCE
from explorer_page import COLOURS, coloured
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook
from page_cells import NOTEBOOKS as PAGES
from page_cells import code, notebook, small
from playwright.sync_api import Locator, expect

from neorl import Run, WaterWorld, place_cells
from neorl.common import files

STEPS = 3_000
LINK = '<a href="#explorer_run-2_minute-0p5">run 2</a>'
EXPLORER = f"""import neorl
neorl.Explorer(neorl.Condition(neorl.place_cells([3]), neorl.WaterWorld(n_creeps=8), {STEPS}, 1), speed=0)"""
NOTEBOOKS = ["one.ipynb", "other.ipynb"]
LIVING = {page: cells for page in sorted(path.stem for path in PAGES.glob("*.ipynb"))  # the cells of living figures
          if (cells := [cell for cell, source in code(notebook(page)).items()
                        if re.search(r"\b(Explorer|Turn|Replay|Changes|of_rat)\(", source)])}
TRIED = ("chapter_1", "paper_a", "paper_b", "paper_c")  # the others are tried by `make pages`
BEFORE = ".legend", "before"  # the curve of the last run stays beside the next one's
ANSWERS = [  # a control of a living figure, what a reader does to it, and where the figure then says what
    (".only [data-chip]", Locator.click, *BEFORE),
    ('.only [data-pick][aria-pressed="false"]', Locator.click, *BEFORE),
    (".only [type=range]", lambda slider: slider.fill("0.5"), *BEFORE),
    ("[name=time]", lambda slider: slider.fill("25"), "output", re.compile("^(1.0 s|0:[0-5]?[1-9])")),
    ("[data-more]", Locator.click, "caption", "From column"),
    ("button.interest", lambda goal: goal.press("ArrowLeft"), ".said", "(0.48, 0.50)"),
    ("[name=preset]", lambda menu: menu.select_option("Vessel with a radar"), ".aims", "vessel"),
    ("[type=checkbox]", Locator.uncheck, *BEFORE)]
FAR = ["\n\n".join(["below"] * 40)] * 5
CURRENT = ".jp-NotebookPanel:not(.lm-mod-hidden)"
SCROLLED = f"{CURRENT} .jp-WindowedPanel-outer"
RESTARTED = "Could not restore the debugger state"  # said by JupyterLab of a kernel that has been restarted
READY = """() => { const kernel = jupyterapp.shell.currentWidget?.sessionContext?.session?.kernel;
                   return kernel?.connectionStatus === "connected" && kernel.status === "idle"; }"""
# Whether the current notebook has a new Explorer, which need not be part of the page yet.
RENDERED = """() => jupyterapp.shell.currentWidget.content.widgets.some(
    ({ node }) => node.querySelector(".neorl-explorer[data-state]:not([data-old], [data-state=compiling])"))"""

# The kernel that has run another notebook, and so has compiled most of what the next one needs.
KERNEL = "() => [...jupyterapp.serviceManager.sessions.running()][0]?.kernel"
HAS_RUN = """() => jupyterapp.shell.currentWidget.sessionContext.session.kernel.status === "idle" && jupyterapp.shell
    .currentWidget.content.widgets.every(({ model }) => model.type !== "code" || model.executionCount)"""
FAILED = """() => jupyterapp.shell.currentWidget.content.widgets.flatMap(({ model }) => model.outputs?.toJSON() ?? [])
    .filter((output) => output.output_type === "error").map((output) => output.evalue)"""
PLACE = "id => 1 + jupyterapp.shell.currentWidget.content.widgets.findIndex(({ model }) => model.id === id)"
# Whether a figure stands still at the top of what is seen, when the cells above it have been rendered.
STANDS = """figure => {
    figure.scrollIntoView();
    const [{ top }, before] = [figure.getBoundingClientRect(), window.topBefore];
    window.topBefore = top;
    return figure.offsetHeight > 0 && top === before; }"""
# Whether its run has ended, which goes on in view alone, where cells above it may be rendered later and push it away.
HAS_ENDED = """figure => {
    figure.scrollIntoView();
    return ["ended", "whole"].includes(figure.dataset.state); }"""
# Whether there is something on every canvas of a figure.
IS_DRAWN = """figure => [...figure.querySelectorAll("canvas")].filter((each) => each.offsetHeight).every((canvas) => {
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    return new Set(new Uint32Array(data.buffer)).size > 1; })"""


@pytest.fixture(scope="module")
def address(tmp_path_factory):
    """The address of a JupyterLab on this machine, with notebooks whose Explorer is far below a link to it."""
    root, own = tmp_path_factory.mktemp("notebooks"), tmp_path_factory.mktemp("jupyter")
    for name in NOTEBOOKS:
        cells = [*map(new_markdown_cell, [LINK, *FAR]), new_code_cell(EXPLORER), *map(new_markdown_cell, FAR)]
        kernel = {"kernelspec": {"name": "python3", "display_name": "Python"}}
        nbformat.write(new_notebook(cells=cells, metadata=kernel), root / name)
    for name in LIVING:
        (root / f"{name}.ipynb").write_text(json.dumps(small(name)))
    (own / "labconfig").mkdir()
    (own / "labconfig" / "page_config.json").write_text(json.dumps(
        {"disabledExtensions": {"@jupyterlab/apputils-extension:announcements": True}}))
    folders = {f"JUPYTER{name}": str(own) for name in ("_CONFIG_DIR", "_DATA_DIR", "_RUNTIME_DIR", "LAB_SETTINGS_DIR",
                                                       "LAB_WORKSPACES_DIR")}
    lab = subprocess.Popen(
        [sys.executable, "-m", "jupyterlab", "--no-browser", "--allow-root", "--ServerApp.ip=127.0.0.1",
         "--ServerApp.port=0", f"--ServerApp.root_dir={root}", "--LabApp.expose_app_in_browser=True",
         "--LabApp.extension_manager=readonly", "--LabApp.news_url=None",
         "--LabApp.check_for_updates_class=jupyterlab.NeverCheckForUpdate"],
        env=os.environ | folders | {"IPYTHONDIR": str(own), "NEORL_CACHE": str(files.cache_folder())},
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        server = own / f"jpserver-{lab.pid}.json"
        while not server.exists() or not server.read_text().endswith("}"):
            assert lab.poll() is None
            time.sleep(0.05)
        known = json.loads(server.read_text())
        yield f"{known['url']}lab?token={known['token']}"
    finally:
        lab.terminate()  # which ends its kernels, too
        try:
            lab.wait(60)
        finally:
            lab.kill()


@pytest.fixture(scope="module")
def page(chromium, address):
    context = chromium.new_context(viewport={"width": 1200, "height": 800})
    context.set_default_timeout(PATIENCE)
    complaints, own = [], (address.partition("lab?")[0], "blob:", "data:")
    context.on("request", lambda request: request.url.startswith(own) or complaints.append(request.url))
    context.on("console", lambda message: message.type == "error" and not message.text.startswith(
        RESTARTED) and complaints.append(message.text))
    context.on("weberror", lambda uncaught: complaints.append(uncaught.error))
    page = context.new_page()
    page.goto(address)
    page.wait_for_function("window.jupyterapp?.shell.currentWidget")  # the launcher
    yield page
    context.close()
    assert not complaints


def command(page, name, **choices):
    page.evaluate("([name, choices]) => { jupyterapp.commands.execute(name, choices); }", [name, choices])


def open_notebook(page, name, **choices):
    command(page, "docmanager:open", path=name, **choices)
    page.wait_for_function("name => jupyterapp.shell.currentWidget?.context?.path === name", arg=name)
    page.wait_for_function(READY)


def restart_and_run_all(page):
    """Restart the kernel and run all cells, while the Explorer is far out of view."""
    page.evaluate("document.querySelectorAll('.neorl-explorer').forEach((each) => { each.dataset.old = ''; })")
    command(page, "notebook:restart-run-all")
    page.locator(".jp-Dialog .jp-mod-accept").click()
    page.wait_for_function(RENDERED, timeout=10 * PATIENCE)  # if other tests compile the modules meanwhile


def explorer_of(page):
    return page.locator(f"{CURRENT} .neorl-explorer[data-state]")


def scroll_to_the_tank(page):
    """Scroll down as a reader does, until the tank is in view."""
    page.locator(SCROLLED).hover()
    tank = explorer_of(page).locator(".arena")
    for _ in range(100):
        page.mouse.wheel(0, 200)
        page.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
        box = tank.count() and tank.bounding_box()
        if box and box["height"] and box["y"] < 300:
            return
    pytest.fail("no tank")


def check_colours(page):
    explorer = explorer_of(page)
    expect(explorer).to_have_attribute("data-state", "ended")
    assert min(coloured(explorer.locator(".arena canvas")).values()) > 50
    assert coloured(explorer.locator(".curve"), agent=COLOURS["agent"])["agent"] > 50


def wait_for_walls(page, wanted):
    """Wait until the walls of the tank are white or black; the signs of creeps are always white."""
    for _ in range(600):
        counts = coloured(explorer_of(page).locator(".arena canvas"), black=[0, 0, 0], white=[255, 255, 255])
        if counts[wanted] > 500 and (wanted == "black" or not counts["black"]):
            return
        page.wait_for_timeout(100)
    pytest.fail(f"{counts}")


def test_an_explorer_rendered_out_of_view_has_the_colours_of_the_theme(page):
    open_notebook(page, "one.ipynb")
    restart_and_run_all(page)
    scroll_to_the_tank(page)
    check_colours(page)
    wait_for_walls(page, "black")
    command(page, "apputils:change-theme", theme="JupyterLab Dark")
    page.wait_for_function("document.body.dataset.jpThemeName === 'JupyterLab Dark'")
    wait_for_walls(page, "white")
    page.evaluate("""async () => {
        const { currentWidget } = jupyterapp.shell;
        await currentWidget.context.save();
        currentWidget.close();
    }""")
    open_notebook(page, "one.ipynb")
    page.wait_for_function(RENDERED)
    scroll_to_the_tank(page)
    check_colours(page)
    wait_for_walls(page, "white")


def test_a_link_is_followed_by_the_explorer_of_its_notebook_and_a_further_view_shows_the_same_run(page):
    for name in NOTEBOOKS:
        open_notebook(page, name)
        restart_and_run_all(page)
        scroll_to_the_tank(page)
        expect(explorer_of(page)).to_have_attribute("data-state", "ended")
    explorer, run = explorer_of(page), Run(place_cells([3]), WaterWorld(n_creeps=8), run=2)
    expect(explorer.locator("[data-action=link]")).to_have_js_property("hidden", True)
    page.locator(SCROLLED).evaluate("notebook => { notebook.scrollTop = 0; }")
    page.get_by_role("link", name="run 2").click()
    expect(explorer).to_have_attribute("data-step", "1500")
    assert float(explorer.get_attribute("data-score")) == run.advance(1_500)
    assert "#" not in page.url and page.evaluate("jupyterapp.shell.currentWidget.context.path") == NOTEBOOKS[-1]
    expect(explorer.locator(".arena")).to_be_in_viewport()

    page.evaluate("""() => { const { content } = jupyterapp.shell.currentWidget;
        content.activeCellIndex = content.widgets.findIndex(({ model }) => model.type === "code"); }""")
    command(page, "notebook:create-output-view")
    expect(page.locator(".jp-LinkedOutputView .neorl-explorer[data-state]")).to_have_attribute("data-step", "1500")
    expect(page.get_by_role("button", name="Show it here")).to_be_visible()
    expect(explorer).to_have_count(0)
    page.locator(".jp-LinkedOutputView").evaluate("""view => [...jupyterapp.shell.widgets("main")].find(
        ({ node }) => node.contains(view)).close()""")
    expect(explorer).to_have_attribute("data-step", "1500")
    open_notebook(page, NOTEBOOKS[0])
    expect(explorer).to_have_attribute("data-step", str(STEPS))


def in_the_kernel(page, code):
    """What code prints in the kernel of the current notebook."""
    return page.evaluate("""async code => {
        let printed = "";
        const { kernel } = jupyterapp.shell.currentWidget.sessionContext.session;
        const future = kernel.requestExecute({ code, store_history: false });
        future.onIOPub = ({ header, content }) => { printed += header.msg_type === "stream" ? content.text : ""; };
        await future.done;
        return printed.trim();
    }""", code)


def wait_for_kernel(page, code, wanted):
    """Wait until code prints this in the kernel, which reads what the page sends when it is free."""
    for _ in range(600):
        if (printed := in_the_kernel(page, code)) == wanted:
            return
        page.wait_for_timeout(100)
    pytest.fail(printed)


def expect_agreement(page, menu):
    """Wait until the page shows the agent that Python has, for as long as both exchange messages."""
    for _ in range(600):
        in_python = in_the_kernel(page, "print(explorer.preset)")
        if in_python and in_python == menu.input_value():
            return
        page.wait_for_timeout(100)
    pytest.fail(f"Python has {in_python}, and the page {menu.input_value()}")


def test_python_follows_the_switch_for_learning_and_the_switch_python(page):
    explorer = explorer_of(page)
    rate = place_cells([3]).learning.learning_rate
    explorer.locator("[data-action=red]").click()
    expect(explorer.locator(".counts")).to_contain_text("now")
    expect(explorer).to_have_attribute("data-state", "ended")
    switch = explorer.get_by_role("switch", name="Learning")
    expect(switch).not_to_be_checked()
    wait_for_kernel(page, "print(_.learning_rate, _.valence_red)", "0.0 1.0")
    switch.check()
    page.wait_for_function("document.querySelector('.neorl-explorer [name=learning_rate]').value !== '-3'")
    wait_for_kernel(page, "print(_.learning_rate)", str(rate))
    in_the_kernel(page, "_.learning_rate = 0.0")
    expect(switch).not_to_be_checked()


def test_results_can_be_chosen_where_the_reader_has_chosen_another_agent_while_python_was_busy(page, tmp_path):
    explorer, name = explorer_of(page), "PC N3, OVC N3"
    menu, begin = explorer.locator("[name=preset]"), tmp_path / "begin"
    page.evaluate("""code => {
        jupyterapp.shell.currentWidget.sessionContext.session.kernel.requestExecute({ code });
    }""", f"""import os, time
explorer, result = _, neorl.simulate(neorl.network_d([3]), neorl.WaterWorld(), steps=100, runs=2, progress=False)
while not os.path.exists({str(begin)!r}):
    time.sleep(0.01)
explorer.show(result, speed=0)""")
    menu.select_option("Place cells")
    expect(explorer).to_have_attribute("data-condition", "")
    begin.touch()
    expect(menu.locator("option", has_text=name)).to_have_count(1)
    expect_agreement(page, menu)  # on either: what the page sends is read while Python is busy, or after it
    menu.select_option(name)
    expect(explorer.locator(".legend")).to_contain_text("2 runs of")
    wait_for_kernel(page, "print(explorer.preset, explorer.gains)", f"{name} [1.0, 1.0]")


@pytest.mark.parametrize("name", [pytest.param(name, marks=() if name in TRIED else pytest.mark.pages)
                                  for name in LIVING])
def test_the_living_figures_of_a_page_that_has_run_are_there_and_answer(page, name):
    open_notebook(page, f"{name}.ipynb", kernel=page.evaluate(KERNEL))
    command(page, "notebook:run-all-cells")
    page.wait_for_function(HAS_RUN, timeout=10 * PATIENCE)  # which compiles what no page has run before
    assert page.evaluate(FAILED) == []
    for cell in LIVING[name]:
        output = page.locator(CURRENT).locator(f".jp-Cell:nth-child({page.evaluate(PLACE, cell)})")
        figure = output.locator(".neorl-explorer")
        page.wait_for_function(STANDS, arg=figure.element_handle())
        if figure.locator(".only [data-pick]").count():
            expect(figure.locator('.only [aria-pressed="true"]')).to_be_visible()
        control, act, part, answer = next(each for each in ANSWERS if figure.locator(each[0]).count())
        if control.startswith(".only"):
            expect(figure.locator(".legend")).to_contain_text(re.compile("2 runs of|the record, [0-9,]+ runs"))
        if part == ".legend":
            page.wait_for_function(HAS_ENDED, arg=figure.element_handle())
        page.wait_for_function(IS_DRAWN, arg=figure.element_handle())
        assert figure.bounding_box()["height"] > 200
        expect(output.locator(".neorl-still")).to_have_count(1)
        expect(output.locator(".neorl-still")).to_be_hidden()
        act(figure.locator(control).first)
        expect(figure.locator(part)).to_contain_text(answer)
