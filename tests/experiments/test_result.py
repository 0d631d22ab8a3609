"""Results add up, and are the same as data frames, datasets and files, of which only whole ones are read."""

import json
import pickle
from dataclasses import replace

import numpy as np
import pytest
from saved_files import rewrite

from neorl import Agent, Condition, Desire, Node, Result, WaterWorld, brownian, network_d, place_cells, simulate
from neorl.worlds import Arena
from neorl.core.modality import PLACE_CELL
from neorl.experiments.bins import new_bins

ARENA = Arena(places=[("run", 0.3, 0.3), ("time", 0.6, 0.6), ("reward", 0.5, 0.5)])


def made_up(agent, world, steps=503, runs=3, **more):
    """A made-up result in which every number is different."""
    rewards, hits = new_bins(world, runs, steps)
    rewards.flat = np.arange(rewards.size) / 7
    hits.flat = np.arange(hits.size)
    return Result(Condition(agent, world, steps, runs, 2**70, **more), rewards, hits)


RESULTS = [made_up(network_d(), WaterWorld(n_creeps=4), changes=((100, place_cells([2])),)),
           made_up(Agent([Node("PC", PLACE_CELL, [3])], [Desire("run", "PC", 1.0)]), ARENA)]


def test_the_bins_add_up():
    world = WaterWorld(n_creeps=8, win_reward=5.0, fps=30)
    result = simulate(brownian(), world, steps=40_003, runs=2, progress=False)
    green, red = result.hits.sum(axis=(0, 1))
    wins = (result.totals.sum() - (green - red)) / 5.0
    assert result.rewards.shape == (2, 6_668)
    assert wins == int(wins) > 0
    assert result.time[-1] == result.seconds == pytest.approx(40_003 / 30)
    np.testing.assert_allclose(result.rate() * result.seconds, result.totals)
    np.testing.assert_allclose(result.hit_rate() * result.seconds, result.hits.sum(axis=1))
    assert result.edges[0] == 0
    first, rest = result.rate(0, 0.25), result.rate(0.25, 1)
    np.testing.assert_allclose((first * result.time[1666] + rest * (result.seconds - result.time[1666])),
                               result.totals)


def test_results_are_equal_if_their_conditions_and_numbers_are():
    one = RESULTS[0]
    assert one == replace(one, rewards=one.rewards.copy()) != "result"
    assert all(one != replace(one, **change) for change in (
        {"condition": replace(one.condition, seed=1)}, {"rewards": one.rewards + 1}))


@pytest.mark.parametrize("result", RESULTS)
def test_a_frame_has_a_row_for_each_run_and_bin(result):
    frame = result.to_frame()
    assert list(frame) == ["run", "time", "reward", *(f"hits_{kind}" for kind in result.world.kinds)]
    assert len(frame) == result.rewards.size
    row = frame[(frame["run"] == 2) & (frame["time"] == result.time[5])]
    assert row["reward"].tolist() == [result.rewards[2, 5]]
    assert [row[f"hits_{kind}"].item() for kind in result.world.kinds] == result.hits[2, 5].tolist()
    np.testing.assert_allclose(frame.groupby("run")["reward"].sum(), result.totals, rtol=1e-6)
    frame.loc[0, "reward"] = -1.0
    assert result.rewards[0, 0] != -1.0


@pytest.mark.parametrize("result", RESULTS)
def test_a_saved_result_is_read_again(tmp_path, result):
    result.save(tmp_path / "result.npz")
    assert Result.load(tmp_path / "result.npz") == result == pickle.loads(pickle.dumps(result))
    with np.load(tmp_path / "result.npz") as file:  # without neorl
        about = json.loads(str(file["about"]))
        assert about["steps"] == 503 and about["world"]["is"] == type(result.world).__name__
        assert file["rewards"].shape == result.rewards.shape


@pytest.fixture
def saved(tmp_path):
    RESULTS[0].save(tmp_path / "result.npz")
    return tmp_path / "result.npz"


@pytest.mark.parametrize("damage", [
    lambda content: content[:-20], lambda content: content[:900] + bytes([content[900] ^ 1]) + content[901:]])
def test_a_truncated_or_foreign_file_is_refused_by_name(saved, damage):
    saved.write_bytes(damage(saved.read_bytes()))
    with pytest.raises(ValueError, match=f"{saved} must be a file of neorl's, but is damaged"):
        Result.load(saved)


@pytest.mark.parametrize("forge, message", [
    (lambda about, kept: about.update(format=3), "must be of format 2, but is of 3; a newer neorl"),
    (lambda about, kept: about.update({"is": "Run"}), "must hold a Result of format 2, but holds a Run"),
    (lambda about, kept: about.update(steps=-5), ": steps must be .*, but is -5"),
    (lambda about, kept: about.update(runs=10**12), r"hits must be int16 \(10{12}, 51, 2\), but is int16 \(3, 51, 2\)"),
    (lambda about, kept: about.update(steps=600), r": hits must be int16 \(3, 60, 2\), but is int16 \(3, 51, 2\)"),
    (lambda about, kept: kept.pop("rewards"), r": rewards must be float32 \(3, 51\), but is absent")])
def test_a_forged_file_is_refused_by_name(saved, forge, message):
    rewrite(saved, forge)
    with pytest.raises(ValueError, match=f"{saved}.*{message}"):
        Result.load(saved)
