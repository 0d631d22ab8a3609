"""The runs on record are bit-identical however they are executed; `make exact` executes all of them in every way."""

import os

import exactness
import golden
import numpy as np
import pytest

from neorl import simulate
from neorl.experiments.bins import new_bins

SPANNING = ["place N10, calibrated", "every modality", "both, self", "both, per object", "no-op",
            "both, step", "network D, calibrated", "arena, calibrated", "softmax", "with a memory, moved",
            "both, object, resets unnoticed", "every modality, once, resets unnoticed", "both, per object, once"]
LOOPED = ["both, self", "network D, calibrated", "with a memory, moved", "every modality, once, resets unnoticed"]
INTERPRETED = ["place N3", "both, self, centred, bootstrapping", "both, absence", "network D, signed", "every modality",
               "network D, calibrated", "both, per object", "arena", "softmax", "both, per object, resets unnoticed",
               "every modality, once, resets unnoticed", "both, self, once"]


def on_record(names, steps):
    return {name: exactness.RECORD[name][str(steps)] for name in names}


def test_every_run_is_on_record():
    assert list(exactness.RECORD) == [*golden.RUNS, *golden.CHANGES] and len(exactness.RECORD) >= 40


def check_that_it_is_as_on_record(name, way):
    found = exactness.WAYS[way](name, golden.LONG)
    if found is None:
        pytest.skip("does not apply")
    assert found == exactness.RECORD[name][str(golden.LONG)]


@pytest.mark.parametrize("name, way", [
    (name, way) for name in exactness.RECORD for way in exactness.WAYS
    if way == "in one go" or name in (LOOPED if way == "Learner" else SPANNING)])
def test_a_run_is_as_on_record_however_it_is_executed(name, way):
    check_that_it_is_as_on_record(name, way)


@pytest.mark.exact
@pytest.mark.parametrize("way", exactness.WAYS)
@pytest.mark.parametrize("name", exactness.RECORD)
def test_every_run_is_as_on_record_in_every_way(name, way):
    check_that_it_is_as_on_record(name, way)


@pytest.mark.parametrize("names", [INTERPRETED, pytest.param([*exactness.RECORD], marks=pytest.mark.exact)],
                         ids=["some", "all"])
def test_interpreted_runs_are_as_on_record(names):
    assert exactness.interpreted(names) == on_record(names, golden.SHORT)


@pytest.mark.exact
def test_runs_are_as_on_record_in_the_oldest_and_the_newest_python_or_those_named():
    pythons = os.environ.get("PYTHONS", "").split() or exactness.other_pythons()
    if not pythons:
        pytest.skip("no other Python")
    for python in pythons:
        found = exactness.in_a_process(exactness.RECORD, golden.LONG, exactness.environment(python))
        assert found == on_record(exactness.RECORD, golden.LONG), python


@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize("name", ["place N23", "with a memory, moved", "arena"])
def test_the_bins_of_a_run_among_others_are_those_of_it_alone(name, threads):
    run = golden.born(name)
    rewards, hits = new_bins(run.world, 1, golden.LONG)
    for step, later in (*golden.changes_of(name), (golden.LONG, None)):
        run.advance(step - run.step, rewards[0], hits[0])
        if later:
            run.change(later)
    among = simulate(golden.agent_of(name), run.world, steps=golden.LONG, runs=golden.RUN + 3, seed=golden.SEED,
                     changes=golden.changes_of(name), threads=threads, progress=False)
    np.testing.assert_array_equal(among.rewards[golden.RUN], rewards[0])
    np.testing.assert_array_equal(among.hits[golden.RUN], hits[0])
    assert rewards.any() and hits.any()


@pytest.mark.parametrize("way", exactness.WAYS)
def test_a_run_of_another_seed_differs_in_every_way(way, monkeypatch):
    monkeypatch.setattr(golden, "SEED", 8)
    assert exactness.WAYS[way]("place N3", golden.SHORT) not in (None, exactness.RECORD["place N3"][str(golden.SHORT)])
