"""Agents whose desires begin late: their definition and the sentences on them."""

from types import SimpleNamespace

import numpy as np
import pytest

from lib.chapter_5 import late_desires
from neorl.evidence.reading import Reading, conditions


@pytest.fixture
def not_lived(monkeypatch):
    """Return agents and the settings of their runs in place of results."""
    monkeypatch.setattr(late_desires, "simulate_once", lambda agent, world, **chosen: (agent, chosen))


def made_up(rate_from):
    """A result of ten runs, from {share of the run at which a stretch begins: reward per second in it}."""
    return SimpleNamespace(rate=lambda begin, end: rate_from[begin] + np.linspace(-0.01, 0.01, 10))


def said(before=0.0, after=0.3, newborn=0.1, throughout=0.3, final=(0.5, 0.5)):
    return late_desires.in_words(made_up({0.0: newborn, 0.5: throughout, 0.8: final[0]}),
                                 made_up({0.4: before, 0.5: after, 0.8: final[1]}))


def test_indifferent_agents_have_the_same_desires_but_no_valence_until_these_begin(not_lived):
    desiring, throughout = late_desires.live(Reading(), 0, steps=900, runs=3, seed=2)
    assert desiring == conditions(Reading(), 900, 3, 2, ["modal"])["both"].agent
    assert throughout == {"steps": 900, "runs": 3, "seed": 2, "changes": []}
    indifferent, late = late_desires.live(Reading(), 450, steps=900, runs=3)
    assert late["changes"] == [(450, desiring)]
    assert [desire.source for desire in indifferent.desires] == [desire.source for desire in desiring.desires]
    assert not any(desire.valence for desire in indifferent.desires) and indifferent.nodes == desiring.nodes


def test_rewards_before_and_after_half_time_are_reported():
    assert said().startswith("In the tenth of the run before half-time the indifferent agents earn 0.00 [0.00, 0.00] "
                             "per second, in the tenth after it 0.30 [0.30, 0.30]. The others earned 0.10 [0.10, 0.10] "
                             "in the first tenth of their run. ")


def test_agents_that_have_learned_before_lead_over_newborn_ones():
    assert ". The indifferent agents thus learned before half-time: their lead over the first tenth is 0.20 [" in said()
    assert ". Their lead over that tenth is not certain: 0.00 [0.00, 0.01]. " in said(after=0.102)


@pytest.mark.parametrize("after, why", [
    (0.3, ", which these runs do not distinguish from 0; in"),
    (0.2, ": lower, since agents that pursue creeps meet more of them; in"),
    (0.4, ": higher, since drifting agents visit more of the tank; in"),
])
def test_the_difference_to_agents_with_desires_throughout_is_explained(after, why):
    assert why in said(after=after)


def test_agents_that_finally_lead_are_said_to():
    assert said(final=(0.5, 0.6)).endswith(
        "it is 0.10 [0.09, 0.11], so the agents without desires for half the run are ahead.")
    assert said(final=(0.5, 0.5)).endswith("it is 0.00 [−0.01, 0.01].")


def test_desires_begin_earlier_and_later(monkeypatch):
    asked = []

    def live(reading, begin, steps, runs, seed):
        earned = np.full(2, {1_500: 0.2, 15_000: 0.4}[begin])
        return SimpleNamespace(world=SimpleNamespace(fps=50), rate=lambda *share: asked.append(share) or earned)

    monkeypatch.setattr(late_desires, "live", live)
    earned = late_desires.vary_begin(Reading(), [1_500, 15_000], steps=30_000, runs=2)
    np.testing.assert_allclose(asked, [(0.05, 0.15), (0.5, 0.6)])
    assert late_desires.beginnings(earned).splitlines() == [
        " 0.50 minutes without: 0.20 [0.20, 0.20] per second in the next tenth",
        " 5.00 minutes without: 0.40 [0.40, 0.40] per second in the next tenth"]
