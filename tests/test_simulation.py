"""Runs: the same to the last bit however they are made, and equal to a slow second telling of the rules."""

import itertools
import os
import subprocess
import sys

import numpy as np
import pytest

import neorl
from neorl import Learning, Policy, Run, WaterWorld, place_cells, simulate
from neorl.stream import new_stream, uniform
from neorl.waterworld import reset_board

TANK = WaterWorld(n_creeps=8, win_reward=5.0)
READINGS = {
    "default": place_cells([3, 7]),
    "several": place_cells([2, 5, 9], weighting="cells", policy=Policy(exploration=0.3, idle="no-op")),
    "happened": place_cells([5], learning=Learning(credit="happened", absence=0.1)),
    "last": place_cells([5], learning=Learning(credit="last", terminal=False), own_cell="counts"),
    "step": place_cells([5], learning=Learning(driver="step")),
    "trace": place_cells([4, 7], extent=(0.25, 0.75), learning=Learning(trace=7)),
    "leaky": place_cells([6], learning=Learning(trace=5, bootstrap=False)),
}


def told_again(agent, world, steps, seed, run):
    """A run by the public functions alone, in plain Python: (rewards, q of each map)."""
    sequence = np.random.SeedSequence(seed).spawn(run + 1)[run]
    stream = new_stream(sequence.spawn(1)[0])
    state = world.reset(sequence)
    rule, policy = agent.learning, agent.policy
    alpha, decay = np.float32(rule.learning_rate), np.float32(rule.learning_rate) * np.float32(rule.absence)
    q = [np.zeros((each.cells, 4, each.cells), np.float32) for each in agent.maps]
    weights = np.array([float(each.resolution) ** ["equal", "resolution", "cells"].index(agent.weighting)
                        for each in agent.maps])
    weights /= weights.sum()
    cells = [int(each.encode(state.agent_position / world.width)) for each in agent.maps]
    events, traces = [[] for _ in q], [[] for _ in q]
    rewards = []
    for _ in range(steps):
        if policy.exploration > 0 and uniform(stream) < policy.exploration:
            action = int(uniform(stream) * 4)
        else:
            valences = np.where(state.creep_is_green, agent.valence_green, agent.valence_red)
            value = np.zeros(4)
            for m, each in enumerate(agent.maps):
                goals = each.encode(state.creep_position / world.width)
                for goal, valence in zip(goals, valences):
                    if goal != cells[m] or agent.own_cell == "counts":
                        value += weights[m] * valence * q[m][cells[m], :, goal].astype(float)
            best = np.flatnonzero(value == value.max())
            if policy.idle == "no-op" and not value.any():
                action = 4
            else:
                action = int(best[int(uniform(stream) * len(best))] if len(best) > 1 else best[0])
        reward, _, done = world.step(state, action)
        rewards.append(reward)
        for m, each in enumerate(agent.maps):
            events[m].append(action)
            cell_t = int(each.encode(state.agent_position / world.width))
            if cell_t == cells[m] and rule.driver == "cell":
                continue
            counts = np.array([events[m].count(event) for event in range(4)])
            credit = {"share": counts.astype(np.float32) / np.float32(len(events[m])),
                      "happened": (counts > 0).astype(np.float32),
                      "last": (np.arange(4) == action).astype(np.float32)}[rule.credit]
            traces[m] = [(cells[m], alpha * credit), *traces[m]][:rule.trace]
            if rule.bootstrap:
                table, cell_tm1 = q[m], cells[m]
                target = np.float32(rule.discount) * table[cell_t].max(axis=0)
                target[cell_t] = 1 if rule.terminal else 1 + target[cell_t]
                for event in range(4):
                    rate, old = alpha * credit[event], table[cell_tm1, event].copy()
                    new = old + rate * (target - old) if rate > 0 else old - decay * old
                    table[cell_tm1, event] = np.where(new > 1e-30, new, 0)
            fading = np.float32(1)
            for back, (cell_left, rates) in enumerate(traces[m]):
                if back > 0 or not rule.bootstrap:
                    q[m][cell_left, :, cell_t] += fading * rates * (1 - q[m][cell_left, :, cell_t])
                fading *= np.float32(rule.discount)
            cells[m], events[m] = cell_t, []
        if done:
            reset_board(state, world.rules)
            cells = [int(each.encode(state.agent_position / world.width)) for each in agent.maps]
            events, traces = [[] for _ in q], [[] for _ in q]
    return rewards, q


@pytest.mark.parametrize("name", READINGS)
def test_a_run_equals_the_rules_told_again_in_plain_python(name):
    agent, world, steps = READINGS[name], WaterWorld(width=100, n_creeps=2, win_reward=5.0), 1_500
    run = Run(agent, world, seed=3, run=2)
    brought = run.advance(steps)
    rewards, q = told_again(agent, world, steps, seed=3, run=2)
    assert brought == sum(rewards) != 0
    for m, table in enumerate(q):
        np.testing.assert_array_equal(run.q(m), table)
        assert table.any()


def fingerprint(names, steps, **how):
    """Everything that a few runs brought, as bytes."""
    parts = []
    for name in names:
        result = simulate(READINGS[name], TANK, steps=steps, runs=3, seed=1, progress=False, **how)
        run = Run(READINGS[name], TANK, seed=1, run=1)
        run.advance(steps)
        parts += [result.rewards, result.hits, run.memory.q, *run.state]
    return b"".join(part.tobytes() for part in parts)


def test_runs_are_the_same_with_the_compiler_switched_off():
    """The other process is this file run as a program, with NUMBA_DISABLE_JIT."""
    names, steps = ["several", "last", "trace", "step"], 250
    interpreted = subprocess.run([sys.executable, __file__, str(steps), *names], capture_output=True, check=True,
                                 env={**os.environ, "NUMBA_DISABLE_JIT": "1"}).stdout
    assert interpreted == fingerprint(names, steps)


def test_runs_are_the_same_on_one_thread_and_on_two():
    names = list(READINGS)
    assert fingerprint(names, 4_000, threads=1) == fingerprint(names, 4_000, threads=2)


def test_a_run_is_the_same_alone_and_among_others():
    alone, among = (simulate(READINGS["several"], TANK, steps=3_000, runs=runs, seed=9, progress=False)
                    for runs in (1, 5))
    np.testing.assert_array_equal(alone.rewards[0], among.rewards[0])
    last = Run(READINGS["several"], TANK, seed=9, run=4)
    assert last.advance(3_000) == among.totals[4]


def test_a_run_is_the_same_in_slices():
    whole, sliced = (Run(READINGS["trace"], TANK, seed=4) for _ in range(2))
    whole.advance(3_000)
    for steps in (1, 9, 990, 2_000):
        sliced.advance(steps)
    np.testing.assert_array_equal(whole.memory.q, sliced.memory.q)
    for one, other in zip(whole.state, sliced.state):
        np.testing.assert_array_equal(one, other)


def test_runs_write_to_no_common_cache_line():
    runs = [Run(place_cells([3]), TANK, run=run) for run in range(20)]
    written = [(array.ctypes.data, array.ctypes.data + array.nbytes, run.memory) for run in runs
               for array in (*run.memory, *run.state, run._contacts) if array.nbytes < 4_096]
    for (_, end, one), (begin, _, other) in itertools.pairwise(sorted(written, key=lambda each: each[:2])):
        assert begin - end >= 64 or one is other


def test_runs_and_seeds_differ():
    result = simulate(READINGS["default"], TANK, steps=5_000, runs=3, seed=0, progress=False)
    other = simulate(READINGS["default"], TANK, steps=5_000, runs=1, seed=1, progress=False)
    assert len({rewards.tobytes() for rewards in [*result.rewards, *other.rewards]}) == 4


def test_the_bins_add_up():
    world = WaterWorld(n_creeps=8, win_reward=5.0, fps=30)
    result = simulate(neorl.brownian(), world, steps=40_003, runs=2, progress=False)
    green, red = result.hits.sum(axis=(0, 1))
    wins = (result.totals.sum() - (green - red)) / 5.0
    assert result.rewards.shape == (2, 6_668)
    assert wins == int(wins) > 0
    assert result.time[-1] == result.seconds == pytest.approx(40_003 / 30)
    np.testing.assert_allclose(result.rate() * result.seconds, result.totals)
    first, rest = result.rate(0, 0.25), result.rate(0.25, 1)
    np.testing.assert_allclose((first * result.time[1666] + rest * (result.seconds - result.time[1666])),
                               result.totals)


@pytest.mark.parametrize("begin, end, message", [
    (-0.1, 1, "begin is -0.1"), (0, 1.1, "end is 1.1"), (0.5, 0.5, "end is 0.5, allowed are"), (1, 0, "end is 0")])
def test_a_bad_stretch_is_refused(begin, end, message):
    result = simulate(place_cells([3]), TANK, steps=100, runs=1, progress=False)
    with pytest.raises(ValueError, match=message):
        result.rate(begin, end)


def test_an_agent_whose_values_overflow_still_chooses():
    with np.errstate(all="ignore"):
        rule = Learning(terminal=False, discount=1.0)
        agent = place_cells([3], valence_green=1e308, valence_red=-1e308, learning=rule)
        assert simulate(agent, TANK, steps=50_000, runs=1, progress=False).hits.sum() > 0


def test_learning_pays():
    """N7 after an hour beats Brownian motion clearly, which is claim A2 in small."""
    learner, control = (simulate(agent, TANK, steps=60_000, runs=4, progress=False).rate(0.5).mean()
                        for agent in (place_cells([7]), neorl.brownian()))
    assert learner > control + 0.2


@pytest.mark.parametrize("change, message", [
    ({"steps": 0}, "steps is 0, allowed are integers ≥ 1"), ({"steps": -5}, "steps is -5"),
    ({"steps": 1e3}, "steps is 1000.0"), ({"runs": 0}, "runs is 0"), ({"runs": -1}, "runs is -1"),
    ({"seed": -1}, "seed is -1"), ({"threads": 0}, "threads is 0"), ({"agent": "N5"}, "agent is 'N5'"),
    ({"world": None}, "world is None, allowed is a WaterWorld"),
])
def test_a_bad_simulation_is_refused(change, message):
    arguments = {"agent": place_cells([3]), "world": TANK, "steps": 100, "runs": 1, "progress": False}
    with pytest.raises(ValueError, match=message):
        simulate(**{**arguments, **change})


def test_a_bad_advance_is_refused_and_changes_nothing():
    run = Run(place_cells([3]), TANK, seed=0)
    rewards, hits = np.zeros(10, np.float32), np.zeros((10, 2), np.int16)
    for steps, given, message in [(-1, (rewards, hits), "steps is -1"), (101, (rewards, hits), "rewards is float32"),
                                  (100, (rewards, hits[:, :1]), "hits is int16"),
                                  (100, (hits, hits), "rewards is int16")]:
        with pytest.raises(ValueError, match=message):
            run.advance(steps, *given)
    run.state.agent_position = np.nan
    with pytest.raises(ValueError, match="state.agent_position is"):
        run.advance(1)
    assert run.step == 0 and not run.memory.q.any()


def test_an_agent_that_does_not_fit_into_memory_is_refused():
    with pytest.raises(MemoryError, match="a run of this agent needs .* GiB"):
        simulate(place_cells([2_000]), TANK, steps=1, runs=1)


def test_a_run_that_fails_ends_the_others(monkeypatch):
    def fail(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("neorl.simulation.Run.advance", fail)
    with pytest.raises(KeyboardInterrupt):
        simulate(place_cells([3]), TANK, steps=10**9, runs=4, progress=False)


if __name__ == "__main__":
    sys.stdout.buffer.write(fingerprint(sys.argv[2:], int(sys.argv[1])))
