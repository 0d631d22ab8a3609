"""Runs stay the same after what must not change them, change as planned, and refuse what they cannot do."""

import threading

import numpy as np
import pytest
from golden import plain_rule
from same import assert_same

from neorl import Agent, Node, Policy, Run, WaterWorld, multimodal, network_c, place_cells, simulate
from neorl.core.modality import (BORDER_CELL, BOUNDARY_VECTOR_CELL, CARTESIAN_OBJECT_VECTOR_CELL, HEAD_DIRECTION_CELL,
                                 LANDMARK_VECTOR_CELL, OBJECT_VECTOR_CELL, PLACE_CELL)

TANK = WaterWorld(n_creeps=8, win_reward=5.0)


def test_becoming_the_same_agent_changes_nothing():
    agent = multimodal([4, 7], learning=plain_rule(memory=7.0, bootstrap=False))
    whole, changed = (Run(agent, TANK, seed=4) for _ in range(2))
    whole.advance(3_000)
    changed.advance(1_234)
    changed.change(agent)
    changed.advance(1_766)
    assert_same(whole, changed)


def test_an_agent_that_gets_a_second_modality_keeps_what_it_knows():
    run = Run(place_cells([3, 7]), TANK, seed=2)
    run.advance(5_000)
    knows = np.concatenate([run.q(0).ravel(), run.q(1).ravel()])
    run.change(multimodal([3, 5, 7]))
    np.testing.assert_array_equal(np.concatenate([run.q(0).ravel(), run.q(2).ravel()]), knows)
    assert knows.any() and not run.q(1).any() and not run.q(4).any()
    run.advance(5_000)
    assert run.q(1).any() and run.q(4).any()
    run.change(place_cells([7]))
    assert run.state.values.q.size == 4 * 7**4 and run.q().any()


def test_the_output_of_a_node():
    run = Run(network_c([2, 5], object_gain=0.5, scale=2.0, signed=False), TANK, seed=0)
    run.advance(20_000)
    while not (run.output("PC").q.any() and run.output("OVC").q.any()):
        run.advance(100)  # an object may be beyond the range of the map
    place, relative = run.output("PC"), run.output("OVC")
    np.testing.assert_allclose(run.state.action_value, place.q + 0.5 * relative.q, atol=1e-15)
    greens, reds = (sum(run.agent.desires[e].source == colour and run.state.desires.valence[e] for e in range(2))
                    for colour in ("green", "red"))
    assert place.valence == greens + reds == relative.valence
    landing = run.state.desires.target[2:4, :2] / 2.0
    np.testing.assert_allclose(landing.sum(axis=0), place.desire)
    with pytest.raises(ValueError, match="name must be 'PC' or 'OVC', but is 'HD'"):
        run.output("HD")


@pytest.mark.parametrize("modality, resolution, here, goal, action", [
    (PLACE_CELL, 5, (0.5, 0.5), (0.7, 0.5), "E"), (BORDER_CELL, 3, (0.0, 0.0), (0.0, -0.25), "N"),
    (OBJECT_VECTOR_CELL, 8, (0.4, 0.0), (0.0, 0.0), "E"), (OBJECT_VECTOR_CELL, 8, (0.4, np.pi), (0.0, np.pi), "W"),
    (CARTESIAN_OBJECT_VECTOR_CELL, 7, (0.0, 0.3), (0.0, 0.0), "S"),
    (BOUNDARY_VECTOR_CELL, 8, (0.4, 1.5 * np.pi), (0.1, 1.5 * np.pi), "N"),
    (LANDMARK_VECTOR_CELL, 8, (0.4, np.pi), (0.1, np.pi), "W"), (HEAD_DIRECTION_CELL, 8, (0.0,), (1.5 * np.pi,), "N"),
])
def test_an_agent_of_any_modality_learns_which_way_to_go(modality, resolution, here, goal, action):
    node = Node("X", modality, [resolution])
    run = Run(Agent((node,), learning=plain_rule(), policy=Policy(exploration=1.0)), TANK, seed=1)
    run.advance(200_000)
    nres_map = run.agent.maps[0]
    values = run.q()[nres_map.encode(here), :, nres_map.encode(goal)]
    assert TANK.actions.names[values.argmax()] == action and values.max() > 1.05 * np.sort(values)[-2]


def test_a_run_that_fails_ends_the_others(monkeypatch):
    def fail(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("neorl.experiments.run.Run.advance", fail)
    with pytest.raises(KeyboardInterrupt):
        simulate(place_cells([3]), TANK, steps=10**9, runs=4, progress=False)


BEFORE = [multimodal([3, 12]), multimodal([3, 4], learning=plain_rule(), object_state="self"),
          place_cells([14], learning=plain_rule(memory=5.0, absent_decay=0.2))]


@pytest.mark.parametrize("first, second", [
    *zip(BEFORE, BEFORE), (multimodal([3, 14]), place_cells([13], learning=plain_rule(memory=5.0)))])
def test_a_run_in_the_memory_of_another_begins_with_nothing_and_is_the_same(first, second):
    before = Run(first, WaterWorld(), seed=0, run=3)
    before.advance(20_000)
    room = before.state.values.q
    after, fresh = Run(second, WaterWorld(), seed=0, run=4, after=before), Run(second, WaterWorld(), seed=0, run=4)
    assert np.shares_memory(after.state.values.q, room) and not after.state.values.q.any()
    assert after.advance(20_000) == fresh.advance(20_000)
    assert_same(after, fresh)


@pytest.mark.parametrize("cache", [False, True])
def test_a_function_follows_the_progress_of_all_runs_together_and_changes_nothing(cache_folder, cache):
    reports, lock = [], threading.Lock()

    def report(done, total):
        assert lock.acquire(blocking=False)  # never called twice at once
        reports.append((done, total))
        lock.release()

    followed = simulate(place_cells([3]), TANK, steps=25_000, runs=3, cache=cache, progress=report)
    assert [total for _, total in reports] == [75_000] * 9
    assert [done for done, _ in reports] == sorted(done for done, _ in reports) and reports[-1][0] == 75_000
    assert followed == simulate(place_cells([3]), TANK, steps=25_000, runs=3, progress=False)
