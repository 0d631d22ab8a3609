"""The cache described in words, and cleared: only files of neorl are removed, and only those asked for."""

import json
import os
from dataclasses import replace

import numpy as np
import pytest

from neorl import CALIBRATED, Condition, Policy, Result, WaterWorld, files, kernel, network_d, place_cells, softmax
from neorl.evidence import report
from neorl.experiments import cache, exchange, kept
from neorl.experiments.run import new_bins
from neorl.worlds.arena import Arena

DIGEST = "0f" * 32


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    """An empty cache folder, for compiled kernels too, since the tests remove them."""
    monkeypatch.setenv("NEORL_CACHE", str(tmp_path / "kept"))
    return tmp_path / "kept"


def keep(condition):
    rewards, hits = new_bins(condition.world, condition.runs, condition.steps)
    cache.save(condition, Result(**condition.choices, rewards=rewards, hits=hits))
    return condition.path


CONDITION = Condition(place_cells([3, 7]), WaterWorld(), 500, 2)


@pytest.fixture
def full(folder):
    """A cache with a file of each kind, current and older, among foreign files: {name: path}."""
    paths = {"condition": keep(CONDITION), "older condition": folder / "conditions" / DIGEST}
    np.savez(folder / "a.npz", rewards=np.zeros(3))
    (folder / "a.npz").rename(paths["older condition"])
    for kind, name in (("compiled", DIGEST), ("wasm", DIGEST), ("runs", f"{DIGEST}-3")):
        for age in ("", "older "):
            path = folder / kind / (name if age else name.replace("0f", "f0"))
            files.write_checked(path, b"content")
            if age:
                os.utime(path, (0, 0))
            paths[f"{age}{kind}"] = path
    report.save("chapter_1")
    paths["claims"] = folder / "claims" / "chapter_1.json"
    for name in ("letter.txt", "conditions/letter.txt", "claims/letter.json", "claims/list.json", "compiled/letter",
                 f"letters/{DIGEST}", f"wasm/{DIGEST}.wasm"):
        path = paths[f"other {name}"] = folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_text("[]" if name.endswith("list.json") else "dear friend")
    (folder / "conditions" / "ab".ljust(64, "0")).mkdir()
    paths["other folder"] = folder / "conditions" / "ab".ljust(64, "0")
    return paths


def left(full):
    return {name for name, path in full.items() if path.exists() and not name.startswith("other")}


OURS = {"condition", "older condition", "compiled", "older compiled", "wasm", "older wasm", "runs", "older runs",
        "claims"}


@pytest.mark.parametrize("which, remain", [
    ("all", set()), ("compiled", OURS - {"compiled", "older compiled", "wasm", "older wasm"}),
    ("older", {"condition", "compiled", "wasm", "runs", "claims"}),
])
def test_what_is_asked_for_is_removed_and_nothing_of_others(full, which, remain):
    others = {path: path.read_bytes() for path in full.values() if path.is_file()}
    removed = kept.clear(which)
    assert left(full) == remain
    assert {full[name] for name in OURS - remain} == {each.path for each in removed}
    assert all(full[name].exists() for name in full if name.startswith("other"))
    assert all(path.read_bytes() == content for path, content in others.items() if path.exists())
    assert kept.clear(which) == []


def test_conditions_and_claims_of_other_sources_are_older(full, monkeypatch):
    monkeypatch.setattr(kept, "source_digest", lambda: "another")
    assert {each.path for each in kept.kept() if each.is_older} >= {full["condition"], full["claims"]}


def test_a_condition_notes_what_it_is(folder):
    keep(CONDITION)
    (found,) = kept.kept()
    assert Condition.from_dict({name: found.about[name] for name in exchange.OF_A_CONDITION}) == CONDITION
    assert found.about["source"] == cache.source_digest() and not found.is_older
    assert cache.load(CONDITION).agent == CONDITION.agent


@kernel
def of_a_module(count, steps, last, activity):
    return 1.0


@pytest.mark.parametrize("change, words", [
    ({}, "PC N3+N7 in WaterWorld, 500 steps, 2 runs, seed 0"),
    ({"steps": 1_500_000, "runs": 1, "seed": 2**70}, f"PC N3+N7 in WaterWorld, 1,500,000 steps, 1 run, seed {2**70}"),
    ({"agent": network_d([2])}, "PC N2 and OVC N2 in WaterWorld, "),
    ({"agent": place_cells([2], learning=replace(CALIBRATED, memory=10), policy=Policy(0.0, choose=softmax(0.5)),
                           own_cell="silent")},
     "PC N2 (memory 10.0, choose softmax(0.5), own_cell silent) in"),
    ({"agent": place_cells([2], learning=replace(CALIBRATED, credit=of_a_module))}, "PC N2 (credit of_a_module) in"),
    ({"world": WaterWorld(n_creeps=8, win_reward=5)}, " in WaterWorld (n_creeps 8, win_reward 5.0), "),
    ({"world": Arena(radius=0.1)}, " in Arena (radius 0.1), "),
    ({"changes": [(100, place_cells([9]))]}, " in WaterWorld, from step 100 on PC N9, 500 steps"),
])
def test_conditions_are_described_in_words(folder, change, words):
    keep(replace(CONDITION, **change))
    (found,) = kept.kept()
    assert words in kept.in_words(found.about)


def test_a_condition_with_a_local_kernel_is_kept_and_described(folder):
    @kernel
    def of_no_module(value, stream):
        return 0

    condition = replace(CONDITION, agent=place_cells([2], policy=Policy(choose=of_no_module)))
    keep(condition)
    (found,) = kept.kept()
    assert "of_no_module" in kept.in_words(found.about) and cache.load(condition).agent == condition.agent


@pytest.mark.parametrize("about", ["[]", "{}", json.dumps({"agent": {}, "world": {}, "steps": "x"}), "{"])
def test_an_invalid_note_is_ignored(folder, about):
    path = folder / "conditions" / DIGEST
    path.parent.mkdir(parents=True)
    with path.open("wb") as file:
        np.savez(file, about=np.array(about))
    (found,) = kept.kept()
    assert found.about is None and found.is_older


def test_another_choice_is_refused():
    with pytest.raises(ValueError, match="which must be 'all', 'compiled' or 'older', but is 'some'"):
        kept.clear("some")
    assert kept.kept() == []
