"""The rules of the arm, step by step against a reimplementation in plain Python with NumPy's random numbers."""

import math

import numpy as np
import pytest

from neorl.core.direction import circle
from neorl.kernels.kernel import function_of
from neorl.worlds import arm
from neorl.worlds.arm import Arm


def hand_in(posture, lengths):
    angles = 2 * np.pi * np.cumsum(posture)
    return np.array([np.sum(lengths * np.cos(angles)), np.sum(lengths * np.sin(angles))])


class PlainArm:
    """The rules of the module's docstring, one by one."""

    def __init__(self, world, seed):
        self.world, self.lengths = world, np.array(world.lengths) / sum(world.lengths)
        self.rng = np.random.Generator(np.random.SFC64(np.random.SeedSequence(seed)))
        self.angles = self.speeds = np.zeros(len(self.lengths))
        self.kinds = [0] * world.targets + [1] * world.obstacles
        self.postures = [self.fresh() for _ in self.kinds]

    def distance(self, posture):
        return math.dist(hand_in(posture, self.lengths), hand_in(self.angles, self.lengths))

    def fresh(self):
        while True:
            posture = np.array([self.rng.random() for _ in self.lengths])
            if self.distance(posture) >= 2 * self.world.radius:
                return posture

    def step(self, action):
        push = np.zeros(len(self.lengths))
        if action < 2 * len(push):
            push[action // 2] = 0.05 * (1, -1)[action % 2]
        self.speeds = self.speeds + push
        self.angles = (self.angles + self.speeds / self.world.fps) % 1.0
        self.speeds = 0.9 * self.speeds
        met = [self.distance(posture) < self.world.radius for posture in self.postures]
        self.postures = [self.fresh() if meets else posture for meets, posture in zip(met, self.postures)]
        return sum((1, -1)[kind] for kind, meets in zip(self.kinds, met) if meets), met


WORLDS = [Arm(), Arm((3, 2, 1), targets=2, obstacles=3, radius=0.2), Arm((1, 1), 0, 2, 0.15, fps=7)]


@pytest.mark.parametrize("world", WORLDS)
def test_a_life_follows_the_rules(world):
    state, plain = world.reset(5), PlainArm(world, 5)
    count, rng, hits = 2 * len(world.lengths) + 1, np.random.default_rng(0), 0
    for action in np.repeat(rng.integers(0, count, 500), rng.integers(1, 6, 500)):
        reward, met, done = world.step(state, int(action))
        assert (reward, met.tolist(), done) == (*plain.step(action), False)
        turned = (state.scene.position - plain.angles + 0.5) % 1 - 0.5
        np.testing.assert_allclose(turned, 0, atol=1e-9)
        np.testing.assert_allclose(state.scene.velocity, plain.speeds, atol=1e-12)
        np.testing.assert_allclose(state.scene.things, plain.postures, atol=1e-15)
        np.testing.assert_allclose(state.hand, hand_in(plain.angles, plain.lengths), atol=1e-9)
        hits += sum(met)
    assert hits > 5


def test_an_angle_closes_on_itself():
    world = Arm()
    state = world.reset(0)
    world.step(state, "1−")
    assert state.scene.position.tolist() == [1 - 0.05 / 20, 0]
    state = world.reset(0)
    state.scene.velocity[0] = -1e-20 - arm.PUSH
    world.step(state, "1+")
    assert 0 <= state.scene.position[0] < 1


def test_unit_vectors_are_cosine_and_sine_to_the_last_bits():
    for turns in [*np.random.default_rng(0).uniform(-2, 2, 2_000), 0.0, 0.125, 0.25, 0.5, 0.75, 1.0]:
        angle = 2 * math.pi * turns
        assert function_of(circle)(turns, arm.TERMS) == pytest.approx((math.cos(angle), math.sin(angle)), abs=4e-15)
