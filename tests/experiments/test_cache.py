"""Conditions on disk: found again, keyed by everything that determines them, and never incomplete."""

import os
import signal
import subprocess
import sys
import time
from dataclasses import replace

import grimp
import numpy as np
import pytest

from neorl import Condition, Learning, Policy, WaterWorld, files, place_cells, simulate_once, softmax
from neorl.experiments import cache, sweeping

AGENT, WORLD = place_cells([3]), WaterWorld()
SIZE = {"steps": 500, "runs": 2, "progress": False}
pytestmark = pytest.mark.usefixtures("cache_folder")


@pytest.fixture
def computed(monkeypatch):
    """The calls that compute runs."""
    calls = []
    original = sweeping._live
    monkeypatch.setattr(sweeping, "_live", lambda *args: calls.append(args) or original(*args))
    return calls


def test_a_condition_is_computed_once(computed):
    first, second = (simulate_once(AGENT, WORLD, **SIZE) for _ in range(2))
    assert len(computed) == 1
    np.testing.assert_array_equal(first.rewards, second.rewards)
    np.testing.assert_array_equal(first.hits, second.hits)
    assert (second.agent, second.world, second.steps) == (AGENT, WORLD, 500)


def test_the_key_depends_on_everything_that_determines_a_result(monkeypatch):
    condition = Condition(AGENT, WORLD, 500, 2, 0)
    keys = [condition.key]
    keys.append(replace(condition, agent=place_cells([3], learning=Learning(discount=0.81))).key)
    keys += [replace(condition, agent=place_cells([3], policy=Policy(choose=choose))).key
             for choose in (softmax(0.1), softmax(1.0))]
    keys += [replace(condition, world=world).key for world in (WaterWorld(fps=30), WaterWorld(contact="truncated"))]
    keys += [replace(condition, **size).key for size in ({"steps": 501}, {"runs": 3}, {"seed": 1})]
    keys.append(replace(condition, changes=[(100, AGENT)]).key)
    monkeypatch.setattr(cache, "source_digest", lambda: "another source")
    keys.append(condition.key)
    assert len(set(keys)) == len(keys)


def test_the_source_digest_covers_every_module_that_a_run_imports():
    imported = grimp.build_graph("neorl", cache_dir=None).find_upstream_modules("neorl.experiments.sweeping")
    assert {"neorl.core.horde", "neorl.worlds.world"} < imported
    assert {name.split(".")[1] for name in imported} == set(cache.PARTS)


@pytest.mark.parametrize("damage", [
    lambda content: content[:-1], lambda content: b"", lambda content: content[:40], lambda content: b"x" * 100,
    lambda content: content[:200] + bytes([content[200] ^ 1]) + content[201:],
])
def test_a_damaged_file_is_noticed_and_computed_again(cache_folder, computed, damage):
    whole = simulate_once(AGENT, WORLD, **SIZE)
    (path,) = (cache_folder / "conditions").iterdir()
    path.write_bytes(damage(path.read_bytes()))
    again = simulate_once(AGENT, WORLD, **SIZE)
    assert len(computed) == 2
    np.testing.assert_array_equal(whole.rewards, again.rewards)
    simulate_once(AGENT, WORLD, **SIZE)
    assert len(computed) == 2


def test_a_killed_process_leaves_whole_conditions_behind(cache_folder):
    """A process killed at any moment leaves files that the next one uses, and the next one completes the work."""
    work = ("from neorl import *\nfor seed in range(12):\n    simulate_once(place_cells([3]), WaterWorld(), "
            "steps=20_000, runs=2, seed=seed, progress=False)\n")
    process = subprocess.Popen([sys.executable, "-c", work])
    deadline = time.monotonic() + 120
    while len(finished(cache_folder)) < 3 and time.monotonic() < deadline:
        time.sleep(0.002)
    process.send_signal(signal.SIGKILL)
    process.wait()
    left = finished(cache_folder)
    assert len(left) >= 3
    assert all(files.read_checked(path) is not None for path in left)
    written = {path: path.stat().st_mtime_ns for path in left}
    subprocess.run([sys.executable, "-c", work], check=True)
    assert len(finished(cache_folder)) == 12
    assert all(path.stat().st_mtime_ns == written[path] for path in left)


def finished(cache_folder):
    return [path for path in cache_folder.glob("conditions/*") if not path.name.startswith(".")]


def test_without_the_variable_the_cache_is_the_users(monkeypatch):
    monkeypatch.delenv("NEORL_CACHE")
    assert files.cache_folder().name == "neorl-companion"
    assert os.fspath(files.cache_folder()).startswith(os.path.expanduser("~"))


@pytest.mark.parametrize("change, message", [
    ({"agent": "PC"}, "agent must be .*, but is 'PC'"), ({"world": 3}, "world must be .*, but is 3"),
    ({"steps": 0}, "steps must be .*, but is 0"),
    ({"runs": -1}, "runs must be .*, but is -1"), ({"seed": 0.5}, "seed must be .*, but is 0.5"),
    ({"changes": [(600, AGENT)]}, "step of a change"),
])
def test_a_condition_that_could_not_run_is_refused(change, message):
    with pytest.raises(ValueError, match=message):
        Condition(**{"agent": AGENT, "world": WORLD, "steps": 500, "runs": 2, **change})
