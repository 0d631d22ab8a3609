"""The rules of the water maze, step by step against a reimplementation in plain Python with NumPy's random numbers."""

import math

import numpy as np
import pytest

from neorl.kernels.execution import execute
from neorl.worlds.water_maze import WaterMaze

RIM = [(0.5, 0.05), (0.5, 0.95), (0.95, 0.5), (0.05, 0.5)]
WAYS = [(0, -1), (0, 1), (1, 0), (-1, 0), (0, 0)]


class PlainMaze:
    """The rules of the module's docstring, one by one."""

    def __init__(self, world, seed):
        self.world, self.trial, self.remembered = world, 0, None
        self.rng = np.random.Generator(np.random.SFC64(np.random.SeedSequence(seed)))
        self.latencies = [0.0] * len(world.places) * world.trials_a_day
        self.begin()

    def begin(self):
        self.at, self.speed, self.steps = list(RIM[int(self.rng.random() * 4)]), [0.0, 0.0], 0
        self.platform = self.world.places[self.trial // self.world.trials_a_day % len(self.world.places)]
        self.trial += 1

    def step(self, action):
        for axis in range(2):
            self.speed[axis] += 0.02 * WAYS[action][axis]
            there = list(self.at)
            there[axis] += self.speed[axis] / self.world.fps
            if math.dist(there, (0.5, 0.5)) > 0.5:
                self.speed[axis] = 0.0
            else:
                self.at, self.speed[axis] = there, 0.95 * self.speed[axis]
        self.steps += 1
        found = math.dist(self.at, self.platform) < self.world.radius
        over = found or self.steps >= round(self.world.trial_seconds * self.world.fps)
        if over:
            self.remembered = self.platform
            if self.trial <= len(self.latencies):
                self.latencies[self.trial - 1] = self.steps / self.world.fps
        elif self.remembered and math.dist(self.at, self.remembered) < self.world.radius:
            self.remembered = None
        return float(found), over


PLACES = ((0.7, 0.5), (0.3, 0.4), (0.5, 0.75))


@pytest.mark.parametrize("world", [
    WaterMaze(), WaterMaze(PLACES, 2, 0.15, 30.0), WaterMaze(PLACES[:2], 1, 0.2, 12.0, fps=5)])
def test_trials_follow_the_rules(world):
    state, plain = world.reset(8), PlainMaze(world, 8)
    rng, seen = np.random.default_rng(2), {"found": 0, "failed": 0, "forgotten": 0}
    for action in np.repeat(rng.integers(0, 5, 800), rng.integers(1, 20, 800)):
        before = plain.remembered
        reward, met, done = world.step(state, int(action))
        assert (reward, done) == plain.step(action) and met.tolist() == [reward == 1]
        np.testing.assert_allclose(state.scene.position, plain.at, atol=1e-9)
        np.testing.assert_allclose(state.scene.velocity, plain.speed, atol=1e-9)
        assert (state.scene.kinds[0] == 0) == (plain.remembered is not None)
        if plain.remembered:
            assert tuple(state.scene.things[0]) == plain.remembered
        seen["forgotten"] += before is not None and plain.remembered is None
        if done:
            seen["found" if reward else "failed"] += 1
            execute(world.dynamics.reset, state, world.rules)
            plain.begin()
            assert state.trial[0] == plain.trial
    np.testing.assert_allclose(state.latency, plain.latencies)
    assert seen["found"] > 5 and (len(world.places) == 1 or seen["forgotten"] > 3)


def test_a_trial_that_has_not_begun_is_refused():
    state = WaterMaze().reset(0)
    state.trial[0] = 0
    with pytest.raises(ValueError, match=r"state.trial must be an integer of at least 1, but is array\(\[0\]\)"):
        WaterMaze().step(state, "N")
