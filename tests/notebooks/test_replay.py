"""Recordings equal their runs, and the Replay shows them in a page without Python."""

import numpy as np
import pytest
from explorer_page import keep_states, wait_for_states, write_page
from companion.shared.replay import Replay, record
from playwright.sync_api import expect

from neorl import Run, WaterWorld, place_cells
from neorl.worlds.waterworld import GREEN

AGENT, TANK = place_cells([3]), WaterWorld(n_creeps=12)


@pytest.fixture(scope="module")
def recordings():
    return [record(name, Run(AGENT, TANK, seed=2, run=run), 100) for run, name in enumerate(["first", "second"])]


def test_a_recording_holds_every_step_of_its_run(recordings):
    run = Run(AGENT, TANK, seed=2, run=1)
    hits = np.zeros((100, 2), np.int16)
    for step in range(101):
        if step:
            run.advance(1, np.zeros(100, np.float32), hits)
        agent, creeps = recordings[1].agent[step], recordings[1].creeps[step]
        scene = run.world_state.scene
        assert np.allclose(agent, np.concatenate([scene.position, scene.velocity]) / 250, atol=1e-6)
        assert np.allclose(creeps[:, :2], scene.things / 250, atol=1e-6)
        assert np.allclose(np.hypot(*creeps[:, 2:].T), run.world_state.speed / 250, atol=1e-6)
        assert recordings[1].green[step].tolist() == (scene.kinds == GREEN).tolist()
        assert recordings[1].hits[step].tolist() == hits.sum(axis=0).tolist()
    assert hits.sum() > 0


def scored(green, red):
    return f"Score {green - red}: {green} green, {red} red".replace("-", "−")


def test_a_fast_replay_has_fewer_frames_and_ends_with_the_same_score(open_page, tmp_path, recordings):
    write_page(tmp_path, [Replay(recordings, speed=10)])
    replay = open_page(tmp_path, "page.html").locator(".neorl-replay")
    expect(replay).to_have_attribute("data-state", "paused", timeout=60_000)
    assert replay.get_attribute("data-frame") == "5"
    for index, recording in enumerate(recordings):
        expect(replay.locator(".legend").nth(index)).to_have_text(scored(*recording.hits[100]))
    expect(replay.locator("output")).to_have_text("0:02, 10×")


def test_a_replay_plays_to_its_end_in_real_time_and_can_be_moved(open_page, tmp_path, recordings):
    write_page(tmp_path, [Replay(recordings)])
    page = open_page(tmp_path, "page.html")
    replay = page.locator(".neorl-replay")
    expect(replay).to_have_attribute("data-state", "paused")  # two seconds after it began
    assert replay.get_attribute("data-frame") == "50"
    for index, recording in enumerate(recordings):
        green, red = recording.hits[-1]
        expect(replay.locator(".legend").nth(index)).to_have_text(scored(green, red))
        expect(replay.locator(".title").nth(index)).to_have_text(recording.name)
    keep_states(page)
    replay.get_by_text("Play again").click()
    wait_for_states(page, "playing", "paused")
    replay.locator("[name=time]").fill("10")
    green, red = recordings[0].hits[20]
    expect(replay.locator(".legend").first).to_have_text(scored(green, red))
    expect(replay.locator("output")).to_have_text("0.4 s")
    keep_states(page)
    replay.locator("button").click()
    wait_for_states(page, "playing", "paused")
    expect(replay).to_have_attribute("data-frame", "50")


def test_with_reduced_motion_a_replay_waits_for_play(open_page, tmp_path, recordings):
    write_page(tmp_path, [Replay(recordings)])
    page = open_page(tmp_path, "page.html", reduced_motion="reduce")
    page.wait_for_timeout(300)
    assert page.locator(".neorl-replay").get_attribute("data-frame") == "0"
    page.locator(".neorl-replay button").click()
    expect(page.locator(".neorl-replay")).to_have_attribute("data-frame", "50")
