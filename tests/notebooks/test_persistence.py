"""Agents that learn at changes of cell or at every step: their runs, verdicts and sentences."""

from dataclasses import replace

import numpy as np
import pytest

from lib.chapter_4 import persistence
from lib.chapter_4.persistence import AGENTS, BROWNIAN, CHANGES, PLACES
from neorl import Result, WaterWorld, brownian
from neorl.evidence.priors import TO_THE_LETTER
from neorl.evidence.reading import conditions


def made_up(first, last=None, runs=12, bins=100):
    """A result whose runs earn about `first` per second, and about `last` in the last fifth."""
    rates = np.full((runs, bins), first)
    rates[:, -bins // 5 :] = first if last is None else last
    rates += 1e-4 * np.arange(runs)[:, None]
    return Result(brownian(), WaterWorld(), 10 * bins, runs, 0, (0.2 * rates).astype(np.float32),
                  np.zeros((runs, bins, 2), np.int16))


def results(changes=1.0, step=0.2):
    return {PLACES: {CHANGES: made_up(0.5, changes), BROWNIAN: made_up(0.1, 0.9), "γ = 0.8": made_up(0.1),
                     "γ = 0.98": made_up(0.5, step)}}


@pytest.fixture
def lived(monkeypatch):
    monkeypatch.setattr(persistence, "sweep", lambda conditions: conditions)
    reading = replace(TO_THE_LETTER, discount=0.8)
    (found,) = persistence.live({"to the letter": reading}, steps=150_000, runs=30, seed=3).values()
    return reading, found


def test_agents_differ_in_their_temporal_driver_alone(lived):
    reading, found = lived
    assert list(found) == list(AGENTS)
    made = conditions(reading, 150_000, 30, 3, ["layers", "modal"])
    for which, (key, control) in AGENTS.items():
        each = found[which]
        assert list(each) == [CHANGES, BROWNIAN, "γ = 0.8", "γ = 0.9779", "γ = 0.9955"]
        assert each[CHANGES] == made[key] and each[BROWNIAN] == made[control]
        step = each["γ = 0.9779"]
        assert step.agent.learning.update_on == "step" and step.agent.learning.discount**10 == pytest.approx(0.8)
        alike = replace(reading, object_state="object")  # which learning at every step requires
        agent = conditions(alike, 1, 1, 0, ["layers", "modal"])[key].agent
        assert replace(step.agent, learning=alike.learning) == agent


def test_learning_at_every_step_has_as_many_runs_as_a_verdict_needs(lived):
    _, found = lived
    assert (found[PLACES][CHANGES].runs, found[PLACES]["γ = 0.8"].runs) == (30, 10)


def test_the_best_discount_counts():
    claim = persistence.judge(results(changes=1.1, step=0.3))
    assert claim.name == "T7" and claim.here.value == pytest.approx((0.3 - 0.26) / (1.1 - 0.26), abs=1e-3)
    assert "does best with γ = 0.98," in claim.detail


def test_rewards_are_reported_beside_the_share_of_the_gain_that_is_kept():
    lived = {"to the letter": results(), "calibrated": results(step=0.5)}
    text = persistence.in_words(lived, {name: persistence.judge(each) for name, each in lived.items()})
    rows = [line for line in text.splitlines() if line.startswith("|")]
    assert rows[0] == "| Agent | Learns at | to the letter | calibrated |"
    assert rows[2] == "| place cells | changes of cell | 1.00 [1.00, 1.00] | 1.00 [1.00, 1.00] |"
    assert rows[3] == "| place cells | nothing: Brownian motion | 0.26 [0.26, 0.26] | 0.26 [0.26, 0.26] |"  # whole run
    assert rows[5] == "| place cells | every step | 0.20 [0.20, 0.20] (γ = 0.98) | 0.50 [0.50, 0.50] (γ = 0.98) |"
    assert text.splitlines()[-1] == (
        "To the letter, learning at every step gains up to −0.08 [−0.08, −0.08] times as much as learning at changes "
        "of cell; calibrated, learning at every step gains up to 0.32 [0.32, 0.32] times as much as learning at "
        "changes of cell.")


def test_without_a_gain_there_is_nothing_to_keep():
    lived = {"calibrated": results(changes=0.2)}
    text = persistence.in_words(lived, {"calibrated": persistence.judge(lived["calibrated"])})
    assert text.endswith("Calibrated, agents that learn at changes of cell show no gain to compare with.")
