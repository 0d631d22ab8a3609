"""A run in real time, with a made-up clock and run."""

from types import SimpleNamespace

import numpy as np
import pytest

from lib.chapter_4 import realtime


class Clock:
    """A clock that advances only by sleep and work; only work uses the processor."""

    def __init__(self):
        self.now, self.used = 100.0, 7.0

    def monotonic(self):
        return self.now

    def process_time(self):
        return self.used

    def sleep(self, seconds):
        assert seconds >= 0
        self.now += seconds

    def work(self, seconds):
        self.now += seconds
        self.used += seconds


@pytest.fixture
def clock(monkeypatch):
    clock = Clock()
    monkeypatch.setattr(realtime, "time", clock)
    return clock


def run_that_takes(clock, seconds):
    """A run at 50 steps per second whose k-th step takes `seconds[k]`; later steps take the last of them."""
    run = SimpleNamespace(world=SimpleNamespace(fps=50), step=0)

    def advance(steps):
        clock.work(seconds[min(run.step, len(seconds) - 1)])
        run.step += steps

    run.advance = advance
    return run


def test_a_quick_run_idles_until_each_step_is_due(clock):
    run = run_that_takes(clock, [0.002])
    pace = realtime.keep_pace(run, windows=3, seconds=0.2)
    assert run.step == 30 and clock.now == pytest.approx(100.6)
    np.testing.assert_allclose(pace.load, 0.1)
    np.testing.assert_allclose(pace.delay, np.full((3, 10), 0.1))


def test_a_slow_step_makes_those_after_it_late_until_they_have_caught_up(clock):
    pace = realtime.keep_pace(run_that_takes(clock, [0.005, 0.05, 0.005]), windows=1, seconds=0.2)
    np.testing.assert_allclose(pace.delay[0, :5], [0.25, 2.5, 1.75, 1.0, 0.25])
    np.testing.assert_allclose(pace.load, (9 * 0.005 + 0.05) / 0.2)


def test_a_run_that_is_too_slow_falls_ever_further_behind(clock):
    pace = realtime.keep_pace(run_that_takes(clock, [0.04]), windows=2, seconds=0.2)
    np.testing.assert_allclose(pace.load, 1.0)
    np.testing.assert_allclose(np.diff(pace.delay.ravel()), 1.0)


@pytest.mark.parametrize("change, message", [({"windows": 0}, "windows must be .*, but is 0"),
({"seconds": 0.01}, "seconds must be .*, but is 0.01")])
def test_bad_windows_are_refused(clock, change, message):
    with pytest.raises(ValueError, match=message):
        realtime.keep_pace(run_that_takes(clock, [0.0]), **{"windows": 1, "seconds": 1.0, **change})
