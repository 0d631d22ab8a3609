"""Runs change as planned, have outputs, and report their progress."""

import threading

import numpy as np
import pytest

from neorl import Run, WaterWorld, multimodal, network_c, place_cells, simulate

TANK = WaterWorld(n_creeps=8, win_reward=5.0)


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
    assert run.memory.q.size == 4 * 7**4 and run.q().any()


def test_the_output_of_a_node():
    run = Run(network_c([2, 5], object_gain=0.5, scale=2.0, signed=False), TANK, seed=0)
    run.advance(20_000)
    while not (run.output("PC").q.any() and run.output("OVC").q.any()):
        run.advance(100)  # an object may be beyond the range of the map
    place, relative = run.output("PC"), run.output("OVC")
    np.testing.assert_allclose(run.state.action_value, place.q + 0.5 * relative.q, atol=1e-15)
    greens, reds = (sum(run.agent.desires[e].source == colour and run.state.desires.total_valence[e] for e in range(2))
                    for colour in ("green", "red"))
    assert place.valence == greens + reds == relative.valence
    landing = run.state.desires.target_at[2:4] / 2.0
    np.testing.assert_allclose(landing.sum(axis=0), place.desire)
    with pytest.raises(ValueError, match="name must be 'PC' or 'OVC', but is 'HD'"):
        run.output("HD")


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


def test_a_run_that_fails_ends_the_others(monkeypatch):
    def fail(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("neorl.experiments.run.Run.advance", fail)
    with pytest.raises(KeyboardInterrupt):
        simulate(place_cells([3]), TANK, steps=10**9, runs=4, progress=False)
