"""A run refuses what would crash the interpreter or corrupt its values, and can be interrupted."""

import _thread
import pickle
import subprocess
import sys
import threading
import time
from dataclasses import replace

import numpy as np
import psutil
import pytest
from same import assert_same

from neorl import Agent, Desire, Learning, Node, Policy, Run, WaterWorld, multimodal, network_d, place_cells, simulate
from neorl.worlds import Arena
from neorl.core.modality import PLACE_CELL

TANK = WaterWorld(n_creeps=4)


@pytest.fixture
def run():
    return Run(multimodal([3, 4]), TANK, seed=1)


def test_a_tank_with_other_creeps_is_refused_and_one_with_as_many_is_copied(run):
    with pytest.raises(ValueError, match=r"state.scene.things must be float64 \(4, 2\), contiguous and writeable, but"):
        run.world_state = WaterWorld(n_creeps=9).reset(0)
    with pytest.raises(ValueError, match="state must be a WaterWorldState, but is 5"):
        run.world_state = 5
    tank = TANK.reset(7)
    run.world_state = tank
    run.advance(1_000)
    assert np.array_equal(tank.scene.position, [125, 125])
    assert not np.array_equal(run.world_state.scene.position, [125, 125])


def test_what_does_not_fit_into_memory_or_64_bits_is_refused(run):
    large = place_cells([2_000])
    with pytest.raises(MemoryError, match="a run of this agent needs 238419.0 GiB of memory"):
        Run(large, TANK)
    with pytest.raises(MemoryError, match="a run of this agent needs"):
        run.change(large)
    with pytest.raises(ValueError, match="steps must be an integer from 0 to 9223372036854775807, but is 184467440737"):
        run.advance(2**64)
    with pytest.raises(MemoryError, match="rewards and hits of all these runs need .*; choose fewer runs or steps"):
        simulate(place_cells([3]), TANK, steps=1, runs=10**12)
    run.advance(100)


def test_hits_are_counted_as_far_as_there_is_room_for_their_number(run):
    hits = np.repeat(np.array([[32_766, 32_767]], np.int16), 500, axis=0)
    run.advance(5_000, hits=hits)
    assert set(hits[:, 0].tolist()) == {32_766, 32_767} == {*hits[:, 0].tolist(), *hits[:, 1].tolist()}


@pytest.mark.parametrize("rewards", [np.zeros(200, np.float32)[::2], [0.0] * 100, np.zeros((100, 1), np.float32)])
def test_bins_that_the_kernel_cannot_take_are_refused(run, rewards):
    with pytest.raises(ValueError, match=r"rewards must be float32 from \(100,\) on, contiguous and writeable, but is"):
        run.advance(1_000, rewards)


@pytest.mark.usefixtures("interruptible")
def test_an_interrupted_run_goes_on_where_it_stopped():
    """Ctrl-C works at any moment, without waiting until all steps are done."""
    agent = network_d([3, 9])
    interrupted, whole = (Run(agent, TANK, seed=3) for _ in range(2))
    interrupted.advance(1)  # compiles the kernel
    threading.Timer(0.4, _thread.interrupt_main).start()
    began = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        interrupted.advance(10**8)
    assert time.monotonic() - began < 30 and interrupted.step > 1
    interrupted.advance(777)
    whole.advance(interrupted.step)
    assert_same(interrupted, whole)


POOL = Arena(trial_seconds=4.0, pay=(0.1,), radius=0.2)
SWIMMER = Agent((Node("PC", PLACE_CELL, [5]),), (Desire("platform", "PC", 1.0),), Learning(0.3), Policy(0.3))


@pytest.mark.parametrize("every", [1, 7, 400])
def test_a_recording_changes_nothing_and_holds_what_the_run_did(every):
    recorded, plain = (Run(SWIMMER, POOL, seed=4) for _ in range(2))
    recorded.advance(1_003)
    path = recorded.record(3_000, every)
    plain.advance(1_003)
    hits = np.zeros((401, 1), np.int16)
    positions, rewards = [plain.world_state.scene.position.copy()], []
    for end in range(every, 3_000 + every, every):
        rewards.append(plain.advance(min(every, 3_000 + every - end), hits=hits))
        positions.append(plain.world_state.scene.position.copy())
    assert_same(recorded, plain)
    np.testing.assert_array_equal(path.steps, [*range(1_003, 4_003, every), 4_003])
    np.testing.assert_allclose(path.rewards, rewards, rtol=1e-12)
    assert path.hits.sum() == hits.sum() > 2 and path.actions.shape == path.rewards.shape
    ended = np.isin(path.steps, path.ends)  # where a trial ended, the recording has its last place, not the next start
    np.testing.assert_array_equal(path.positions[~ended], np.array(positions)[~ended])
    assert path.returns.sum() == pytest.approx(path.rewards.sum()) and len(path.returns) == len(path.ends) > 14


def test_a_trial_without_success_returns_0_and_ends_when_its_time_is_up():
    path = Run(Agent(SWIMMER.nodes), POOL, seed=1).record(2_000)
    lengths = np.diff([0, *path.ends])
    assert np.all(lengths[path.returns == 0] == 200) and np.all(lengths <= 200)
    np.testing.assert_allclose(path.returns[lengths < 200], 0.1)
    for action, push in enumerate(POOL.actions.pushes):  # an action pushes the agent the way it says
        taken = np.flatnonzero(path.actions[1:] == action) + 1
        taken = taken[~np.isin(path.steps[taken], path.ends) & ~np.isin(path.steps[taken + 1], path.ends)]
        bends = np.diff(path.positions, axis=0)[taken] - np.diff(path.positions, axis=0)[taken - 1]
        assert (bends @ push).mean() > 0 and len(taken) > 50


def test_a_function_is_called_with_the_run_every_so_often_and_changes_nothing():
    watched, plain, seen = Run(SWIMMER, POOL, seed=4), Run(SWIMMER, POOL, seed=4), []
    paid = watched.advance(25_001, each=lambda run: seen.append(run.copy()), every=12_000)
    assert [each.step for each in seen] == [12_000, 24_000, 25_001]
    assert paid == plain.advance(24_000) + plain.advance(1_001)
    seen[1].advance(1_001)  # a checkpoint goes on to the same bit
    for each in (watched, *seen[1:]):
        assert_same(each, plain)
    watched.advance(3, each=seen.append, every=2)
    assert seen[3:] == [watched, watched]


def test_an_error_in_that_function_ends_the_call_at_its_step_and_a_bad_one_is_refused():
    run = Run(SWIMMER, POOL, seed=4)
    with pytest.raises(ZeroDivisionError):
        run.advance(1_000, each=lambda run: 1 / 0, every=300)
    assert run.step == 300
    for arguments, message in [({"each": 5}, "each must be a function that takes the run, or None, but is 5"),
                               ({"every": 0}, "every must be an integer of at least 1, but is 0")]:
        with pytest.raises(ValueError, match=message):
            run.advance(10, **arguments)


def test_a_call_within_a_call_is_refused_and_a_copy_goes_on():
    run, plain = Run(SWIMMER, POOL, seed=4), Run(SWIMMER, POOL, seed=4)
    for within in (lambda run: run.record(500), lambda run: run.advance(1)):
        with pytest.raises(RuntimeError, match="each must not advance the run; use run.copy()"):
            run.advance(1_000, each=within, every=500)
    assert run.step == 1_000  # two halves
    paths = []
    run.advance(1_000, each=lambda run: paths.append(run.copy().record(500)), every=500)
    plain.advance(2_000)
    assert_same(run, plain)
    assert [path.steps[0] for path in paths] == [1_500, 2_000]


def test_the_agent_may_change_within_a_call():
    other = replace(SWIMMER, policy=Policy(0.9))
    run, plain = Run(SWIMMER, POOL, seed=4), Run(SWIMMER, POOL, seed=4)
    run.advance(1_000, each=lambda run: run.step == 500 and run.change(other), every=500)
    plain.advance(500)
    plain.change(other)
    plain.advance(500)
    assert_same(run, plain)


@pytest.mark.parametrize("call", [lambda run: run.advance(1), lambda run: run.record(1), Run.copy, pickle.dumps,
                                  lambda run: run.change(SWIMMER), lambda run: run.transfer(run),
                                  lambda run: setattr(run, "world_state", run.world_state)])
def test_another_thread_is_refused(call):
    run, inside, refused = Run(SWIMMER, POOL, seed=4), threading.Event(), threading.Event()

    def wait(_):
        inside.set()
        assert refused.wait(60)

    advancing = threading.Thread(target=run.advance, args=(10,), kwargs={"each": wait})
    advancing.start()
    assert inside.wait(60)
    with pytest.raises(RuntimeError, match="must not be called while another thread's call is going on; give each"):
        call(run)
    refused.set()
    advancing.join()
    call(run)


KILLED = """
import os, signal, sys
from neorl import Run
def checkpoint(run):
    run.save("run.npz")
    if run.step == 6_000:
        os.kill(os.getpid(), getattr(signal, "SIGKILL", signal.SIGTERM))
Run.load("start.npz").advance(1_000_000, each=checkpoint, every=2_000)
"""


def test_a_run_that_was_killed_goes_on_from_its_checkpoint(tmp_path):
    whole = Run(SWIMMER, POOL, seed=4)
    whole.save(tmp_path / "start.npz")
    done = subprocess.run([sys.executable, "-c", KILLED], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode < 0, done.stderr
    resumed = Run.load(tmp_path / "run.npz")
    assert resumed.step == 6_000
    resumed.advance(3_333)
    whole.advance(9_333)
    assert_same(resumed, whole)


def test_the_memory_of_an_agent_of_twelve_maps_does_not_grow_with_its_steps():
    run = Run(multimodal(), WaterWorld())
    run.advance(200_000)  # by then every value has been touched
    before = psutil.Process().memory_info().rss
    for _ in range(10):
        run.advance(20_000)
    assert len(run.agent.maps) == 12 and psutil.Process().memory_info().rss - before < 2**19
