"""The Turn runs in a page what Python runs, with learning on or off, and keeps the run before."""

from dataclasses import replace

import numpy as np
import pytest
from companion.chapter_5.turn import Turn
from explorer_page import write_page
from playwright.sync_api import expect

from neorl import Condition, WaterWorld, multimodal, simulate

TANK, AVOIDING, STEPS = WaterWorld(), multimodal([3, 5]), 24_000  # eight minutes
WANTING = replace(AVOIDING, desires=[replace(each, valence=1.0) for each in AVOIDING.desires])
FROZEN = replace(WANTING, learning=replace(WANTING.learning, learning_rate=0.0))
RUNS = {name: Condition(AVOIDING, TANK, STEPS, 1, 3, ((STEPS // 2, later),))
        for name, later in (("on", WANTING), ("off", FROZEN))}


@pytest.fixture
def visit(open_page, tmp_path):
    def visit(**options):
        write_page(tmp_path, [Turn(**RUNS)])
        return open_page(tmp_path, "page.html", **options)
    return visit


def caught(name):
    """The red creeps of each minute, as Python counts them, in the format of the page's."""
    run = RUNS[name]
    result = simulate(run.agent, TANK, steps=STEPS, runs=1, seed=run.seed, changes=run.changes, progress=False)
    return result.hits[0, :, 1].reshape(8, -1).sum(axis=1)


def wait_for_run(page, name):
    page.wait_for_function("""reds => document.querySelector(".neorl-turn").dataset.caught?.split(" ").slice(0, 8)
        .join() === reds""", arg=",".join(map(str, caught(name))))


def test_the_page_catches_what_python_catches_with_learning_on_and_off(visit):
    assert np.array_equal(caught("on")[:4], caught("off")[:4]) and not np.array_equal(caught("on"), caught("off"))
    page = visit()
    turn, legend = page.locator(".neorl-turn"), page.locator(".legend")
    wait_for_run(page, "on")
    expect(turn).to_have_attribute("data-state", "whole")
    expect(page.locator(".minutes")).to_have_text("8 minutes · red is wanted")
    reds = caught("on")
    expect(page.locator(".said")).to_have_text(
        f"Red creeps a minute: {reds[2:4].mean():.1f} before the turn, {reds[4]:.1f} in the minute after it, "
        f"{reds[6:].mean():.1f} in the last 2 minutes.")
    expect(legend).to_have_text("learning on after the turn")
    page.get_by_label("Learning goes on after the turn").uncheck()
    wait_for_run(page, "off")
    expect(legend).to_have_text("learning off after the turn · learning on, the run before")


def test_with_reduced_motion_the_agent_waits_for_play(visit):
    page = visit(reduced_motion="reduce")
    turn = page.locator(".neorl-turn")
    expect(turn).to_have_attribute("data-state", "waiting")
    page.get_by_text("Play").click()
    expect(turn).to_have_attribute("data-state", "whole")
    page.get_by_text("Pause").click()
    before = page.locator(".minutes").inner_text()
    page.wait_for_timeout(300)
    assert page.locator(".minutes").inner_text() == before


def test_a_page_without_webassembly_says_so(visit):
    page = visit(reduced_motion="reduce")
    page.evaluate("delete window.WebAssembly")
    page.get_by_text("Play").click()
    expect(page.get_by_role("alert")).to_contain_text("This browser cannot run the simulation")


def test_the_widget_holds_only_the_module_of_its_world():
    turn = Turn(**RUNS)
    assert [*turn._wasm] == [*turn._layout] == ["plane"]
