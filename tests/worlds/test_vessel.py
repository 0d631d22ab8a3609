"""The rules of the vessel, step by step against a reimplementation in plain Python with NumPy's random numbers."""

import math

import numpy as np
import pytest

from neorl.worlds.vessel import Vessel


class PlainVessel:
    """The rules of the module's docstring, one by one; vectors in the plane are complex numbers."""

    def __init__(self, world, seed):
        self.world = world
        self.rng = np.random.Generator(np.random.SFC64(np.random.SeedSequence(seed)))
        self.at, self.heading, self.rate = 0.5 + 0.5j, 1.0 + 0j, 0.0
        self.things = [self.fresh(thing > 0) for thing in range(world.things)]

    def fresh(self, moves):
        at = self.rng.random() + 1j * self.rng.random()
        while abs(at - self.at) < 0.25:
            at = self.rng.random() + 1j * self.rng.random()
        course = 0j
        while moves and course == 0:
            course = int(self.rng.random() * 3) - 1 + 1j * (int(self.rng.random() * 3) - 1)
        return [at, course / abs(course) * self.world.speed * self.rng.random() if moves else 0j]

    def step(self, action):
        world, dt = self.world, 1 / self.world.fps
        self.rate += ({0: -1, 1: 1, 2: 0}[action] * world.turning - self.rate) * dt / world.lag
        self.heading *= np.exp(2j * math.atan(self.rate * dt / 2))
        at = self.at + (world.speed * self.heading + complex(*world.current)) * dt
        self.at = complex(min(max(at.real, 0), 1), min(max(at.imag, 0), 1))
        met = [abs(at - self.at) < world.radius for at, _ in self.things]
        self.things = [self.fresh(thing > 0) if met[thing] else each for thing, each in enumerate(self.things)]
        self.things = [self.sailed(at, course, dt) for at, course in self.things]
        return met[0] - sum(met[1:]), met

    def sailed(self, at, course, dt):
        x, y = (at + course * dt).real, (at + course * dt).imag
        if not 0 <= x <= 1:
            x, course = (-x if x < 0 else 2 - x), complex(-course.real, course.imag)
        if not 0 <= y <= 1:
            y, course = (-y if y < 0 else 2 - y), complex(course.real, -course.imag)
        return [complex(x, y), course]


def as_pairs(numbers):
    return np.array([(number.real, number.imag) for number in numbers])


WORLDS = [Vessel(), Vessel(traffic=20, current=(-0.05, 0.08), speed=0.3, turning=3, lag=0.2, radius=0.08, fps=20),
          Vessel(traffic=0, current=(0, 0))]


@pytest.mark.parametrize("world", WORLDS)
def test_a_life_follows_the_rules(world):
    state, plain = world.reset(3), PlainVessel(world, 3)
    rng, hits = np.random.default_rng(1), 0
    for action in np.repeat(rng.integers(0, 3, 150), rng.integers(1, 30, 150)):
        reward, met, done = world.step(state, int(action))
        assert (reward, met.tolist(), done) == (*plain.step(action), False)
        np.testing.assert_allclose(state.scene.position, as_pairs([plain.at])[0], atol=1e-9)
        np.testing.assert_allclose(state.scene.velocity, world.speed * as_pairs([plain.heading])[0], atol=1e-9)
        np.testing.assert_allclose(state.scene.things, as_pairs([at for at, _ in plain.things]), atol=1e-9)
        hits += sum(met)
    assert hits > 20 or world.traffic < 20


def test_starboard_is_clockwise_with_a_lag():
    world, states = Vessel(traffic=0), {}
    for side in ("port", "starboard", "amidships"):
        states[side] = world.reset(0)
        for _ in range(30):
            world.step(states[side], side)
    assert states["starboard"].rate[0] == pytest.approx(1.0, abs=0.01) == -states["port"].rate[0]
    assert states["starboard"].heading[1] > 0 > states["port"].heading[1]  # y points down
    world.step(states["starboard"], "amidships")
    assert 0.7 < states["starboard"].rate[0] < 0.9


def test_a_heading_that_is_no_direction_is_refused():
    state = Vessel().reset(0)
    state.heading[:] = 1.0
    with pytest.raises(ValueError, match=r"state.heading must be a vector of length 1, but is array\(\[1., 1.\]\)"):
        Vessel().step(state, "port")
