"""Runs that are the same to the last bit."""

import hashlib

import numpy as np

from neorl import Learner, Result, Run
from neorl.agents import keeping
from neorl.core.stream import new_stream
from neorl.experiments import simulation
from neorl.experiments.bins import new_bins
from neorl.kernels.annotations import arrays


def numbers(values):
    """The arrays of the state of a `Learner` or `Run`, or in a named tuple, by name."""
    return keeping.state_of(values._record, values._memory) if isinstance(values, Learner | Run) else arrays(values)


def assert_equal(one, other):
    """Assert that the numbers in two of these are equal."""
    theirs = numbers(other)
    for name, mine in numbers(one).items():
        np.testing.assert_array_equal(mine, theirs[name], name)


def assert_same(one, other):
    """Assert that two runs are at the same step of the same run."""
    assert one.step == other.step
    assert_equal(one, other)
    assert_equal(one.world_state, other.world_state)


def digest(run, steps):
    """A run's reward in a number of steps, and a digest of its values and its world after them."""
    paid = run.advance(steps)
    content = [run.memory.q, *arrays(run.world_state).values()]
    return f"{paid} {hashlib.sha256(b''.join(each.tobytes() for each in content)).hexdigest()}"


def newborn(agent, world, seed=0, run=0):
    """A learner that has begun in a world, with the random stream of a run's choices, and the world's state."""
    sequence = np.random.SeedSequence(seed, spawn_key=(run,))
    state = world.reset(sequence)
    learner = Learner(agent, world.things, world.kinds, world.actions, size=world.size, fps=world.fps)
    learner._record["stream"] = new_stream(sequence.spawn(1)[0])
    learner.begin(state.scene)
    return learner, state


def alone(condition):
    """The result of a condition, run by run."""
    rewards, hits = new_bins(condition.world, condition.runs, condition.steps)
    for k in range(condition.runs):
        simulation.finished_run(condition, k, rewards[k], hits[k])
    return Result(condition, rewards, hits)
