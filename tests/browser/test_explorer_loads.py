"""While the Explorer loads, neither the reader's actions nor errors leave a trace in the next run."""

import re

import pytest
from explorer_page import press, wait, write_page
from playwright.sync_api import expect

from neorl import Explorer
from neorl.browser.explorer import AGENTS

SEED, LOADS, ACTIONS = 13, 200, 60

# Clicks wherever a reader can click, from before an agent is chosen in the menu until it has loaded. A click on the
# tank goes to the topmost element at that point, as in a browser.
RANDOM = """
  Element.prototype.requestFullscreen = async () => undefined; // only a reader may do that
  const random = () => { // mulberry32
    seed = (seed + 0x6d2b79f5) | 0;
    let mixed = Math.imul(seed ^ (seed >>> 15), 1 | seed);
    mixed = (mixed + Math.imul(mixed ^ (mixed >>> 7), 61 | mixed)) ^ mixed;
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
  const one = (list) => list[Math.floor(random() * list.length)];
  const pause = (longest) => new Promise((resolve) => setTimeout(resolve, random() * longest));
  const root = document.querySelector(".neorl-explorer");
  const check = (said) => {
    const alert = root.querySelector("[role=alert]");
    if (!alert.hidden || root.dataset.state === "failed") throw new Error(`${said}: ${alert.textContent}`);
  };
"""
CLICKS = "async ({ loads, seed }) => {" + RANDOM + """
  const control = (name) => root.querySelector(`[name="${name}"]`);
  const turn = (target) => target.dispatchEvent(new Event("input", { bubbles: true }));
  const clickTank = () => {
    const { left, top, width } = root.querySelector(".arena").getBoundingClientRect();
    const [clientX, clientY] = [left + random() * width, top + random() * width];
    document.elementFromPoint(clientX, clientY).dispatchEvent(
      new MouseEvent("click", { bubbles: true, clientX, clientY }));
  };
  const acts = [...Array(6).fill(clickTank), () => control("field").click(),
    () => one([...root.querySelectorAll(".bar button, .board button")]).click(),
    () => turn(Object.assign(control("map"), { value: one(control("map").options).value }))];
  let clicks = 0;
  for (let load = 1; load <= loads; load += 1) {
    for (let i = Math.floor(random() * 3); i > 0; i -= 1, clicks += 1) one(acts)();
    const menu = control("preset");
    menu.value = one([...menu.options].filter((each) => !each.selected)).value;
    turn(menu);
    do {
      one(acts)();
      clicks += 1;
      await pause(5);
      check(`Load ${load}, ${menu.value}, click ${clicks}`);
    } while (root.dataset.state === "loading");
  }
  return clicks;
}"""

# Anything that a reader can do, one after the other: menus, sliders, fields, buttons, keys, and the tank.
ACTS = "async ({ actions, seed }) => {" + RANDOM + """
  const done = [];
  root.querySelector("summary").click();
  const act = (target) => {
    const turn = (value, type) => target.dispatchEvent(new Event(type, { bubbles: true }, target.value = value));
    if (target.matches("select")) return turn(one([...target.options]).value, "input");
    if (target.type === "range") return turn(Number(target.min) + random() * (target.max - target.min), "input");
    if (target.type === "number") return turn(one(["3", "0", "-1", "5000000000"]), "change");
    if (target.type === "text") return turn(one(["3", "2, 5", "0", "x", "12 4"]), "change");
    if (!target.matches("canvas, .grip")) return target.click();
    const { left, top, width, height } = target.getBoundingClientRect();
    const at = { bubbles: true, clientX: left + random() * width, clientY: top + random() * height };
    const key = one(["Enter", " ", "Escape", "ArrowLeft", "ArrowUp"]);
    const events = [new MouseEvent("click", at), new KeyboardEvent("keydown", { ...at, key })];
    return target.dispatchEvent(one(events));
  };
  for (let action = 1; action <= actions; action += 1) {
    const targets = [...root.querySelectorAll("select, input, button, canvas[tabindex], .grip")];
    const target = one(targets.filter((each) => !each.disabled && each.checkVisibility()));
    done.push(target.name || target.dataset.action || target.className || target.localName);
    act(target);
    await pause(200);
    check(`${done.join(", ")} (action ${action})`);
  }
  return done.length;
}"""


@pytest.fixture
def explorer(open_page, tmp_path):
    """A page with an Explorer whose first run has begun."""
    write_page(tmp_path, [Explorer(playing=False, speed=0.0)])
    page = open_page(tmp_path, "page.html", viewport={"width": 800, "height": 1200})
    wait(page, "paused")
    return page


def test_clicks_at_random_while_agents_are_loaded_do_no_harm(explorer):
    assert explorer.evaluate(CLICKS, {"loads": LOADS, "seed": SEED}) > LOADS


@pytest.mark.parametrize("seed", [1, 2])
def test_actions_at_random_do_no_harm(explorer, seed):
    assert explorer.evaluate(ACTS, {"actions": ACTIONS, "seed": seed}) == ACTIONS


def test_requests_to_the_previous_run_are_not_answered(explorer):
    """Steps and goals requested just before and just after another agent is chosen do not reach its run."""
    step, menu = '[data-action="step"]', '[name="preset"]'
    for first, second in [("Place cells", "Network D"), ("Network D", "Object-vector cells")]:
        explorer.locator(menu).select_option(first)
        wait(explorer, "paused")
        explorer.evaluate("""([step, menu, key]) => {
            const tank = document.querySelector(".arena canvas");
            const { left, top, width } = tank.getBoundingClientRect();
            const act = (share) => {
              document.querySelector(step).click();
              const at = { clientX: left + share * width, clientY: top + share * width };
              tank.dispatchEvent(new MouseEvent("click", { bubbles: true, ...at }));
            };
            act(0.3);
            Object.assign(document.querySelector(menu), { value: key }).dispatchEvent(
              new Event("input", { bubbles: true }));
            return Promise.resolve().then(() => act(0.7));
        }""", [step, menu, second])
        wait(explorer, "paused")
        press(explorer, "step")  # which the worker answers last
        explorer.wait_for_function("document.querySelector('.neorl-explorer').dataset.step > 0")
        root = explorer.locator(".neorl-explorer")
        assert [root.get_attribute(f"data-{name}") for name in ("step", "goal")] == ["1", ""]
        expect(explorer.locator('[name="map"]')).to_have_value(re.compile("^" + AGENTS[second].nodes[0].name))


def test_reset_recovers_from_maps_that_are_too_large(explorer):
    explorer.locator('[name="preset"]').select_option("Network D")
    explorer.locator('[name="resolutions"]').fill("86, 87, 88, 89, 90")
    explorer.locator('[name="resolutions"]').press("Enter")
    alert = explorer.locator("[role=alert]")
    expect(alert).to_have_text(re.compile(r"^These maps need \d\.\d GB of memory, and a page can have 3\."))
    explorer.locator('[data-action="reset"]').click()
    wait(explorer, "paused")
    expect(alert).to_be_hidden()
    preset = ", ".join(map(str, AGENTS["Network D"].nodes[0].resolutions))
    assert explorer.locator('[name="resolutions"]').input_value() == preset


@pytest.mark.parametrize("state", [{"preset": "Network E"}, {"resolutions": [0]}, {"speed": -1}, {"seed": 0.5}])
def test_reset_recovers_from_an_invalid_state(open_page, tmp_path, state):
    write_page(tmp_path, [Explorer(playing=False)], lambda record: record["state"].update(state))
    page = open_page(tmp_path, "page.html")
    wait(page, "failed")
    page.locator('[data-action="reset"]').click()
    wait(page, "paused")
    expect(page.locator("[role=alert]")).to_be_hidden()


# Faults in the worker, in its answer and in drawing, each in force until it is undone.
FAULTS = [
    ("Worker.prototype.postMessage", "function () { this.onerror(new ErrorEvent('error', { message: 'Uncaught' })); }"),
    ("Worker.prototype.postMessage", "function () { queueMicrotask(() => this.onmessage({ data: {} })); }"),
    ("CanvasRenderingContext2D.prototype.clearRect", "() => undefined.there"),
]


@pytest.mark.parametrize("what, fault", FAULTS)
def test_a_fault_is_reported_and_reset_recovers_from_it(explorer, what, fault):
    explorer.evaluate(f"""() => {{  // at once, or the tank may be drawn in between
        window.sound = {what};
        {what} = {fault};
        document.querySelector('[data-action="step"]').click();
    }}""")
    alert = explorer.locator("[role=alert]")
    expect(alert).to_have_text("The simulation has stopped. Reset restarts it.")
    explorer.evaluate(f"() => {{ {what} = window.sound; }}")
    explorer.locator('[data-action="reset"]').click()
    wait(explorer, "paused")
    expect(alert).to_be_hidden()
    press(explorer, "step")
    explorer.wait_for_function("document.querySelector('.neorl-explorer').dataset.step === '1'")


def test_an_element_that_is_deleted_while_it_is_dragged_is_gone(explorer):
    explorer.locator('[data-action="drop"]').press("Enter")
    mark = explorer.locator(".interest")
    mark.hover()
    explorer.mouse.down()
    explorer.mouse.move(300, 400, steps=3)
    explorer.keyboard.press("Delete")
    explorer.mouse.move(350, 450, steps=3)
    explorer.mouse.up()
    expect(mark).to_have_count(0)
    expect(explorer.locator("[role=alert]")).to_be_hidden()
