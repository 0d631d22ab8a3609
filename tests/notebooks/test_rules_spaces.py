"""The rules on Kaelbling's properties, on made-up samples with a known answer."""

import numpy as np
import pytest
from test_claims import made_up

from companion.thesis import claims


def sample(mean, runs=20):
    return mean + np.random.default_rng(round(100 * mean)).normal(0, 0.02 * abs(mean), runs)


@pytest.mark.parametrize("agent, table, chance, expected", [
    (10, 40, 50, "reproduced"), (30, 40, 50, "partly"), (45, 40, 50, "contradicted"), (10, 40, 8, "contradicted")])
def test_efficiency(agent, table, chance, expected):
    claim = claims.judge_efficiency(sample(agent), sample(table), sample(chance))
    assert claim.verdict == expected and claim.here.value == pytest.approx(agent / table, rel=0.05)


@pytest.mark.parametrize("agents, expected", [
    ((3, 4), "reproduced"), ((3, 0.5), "partly"), ((0.5, 0.6), "contradicted")])
def test_generality(agents, expected):
    claim = claims.judge_generality({str(agent): (sample(agent), sample(1)) for agent in agents})
    assert claim.verdict == expected and claim.here.value == (min(agents) > 1)


@pytest.mark.parametrize("apart, expected", [(1.1, "reproduced"), (1.5, "partly"), (3, "contradicted")])
def test_composition(apart, expected):
    assert claims.judge_composition(sample(apart), sample(1), sample(9)).verdict == expected
    assert claims.judge_composition(sample(apart), sample(1), sample(0.5)).verdict == "contradicted"


@pytest.mark.parametrize("joined, expected", [
    ((1.0, 1.3), "reproduced"), ((1.0, 0.95), "partly"), ((1.0, 0.8), "contradicted")])
def test_extension(joined, expected):
    alone, joined_later = made_up(1.0), made_up(*joined, learned_by=0.5)
    claim = claims.judge_extension(joined_later, alone, made_up(0.0))
    assert claim.verdict == expected and claim.here.value == pytest.approx(60 * (joined[1] - 1), abs=2)
    assert claims.judge_extension(joined_later, alone, made_up(1.5)).verdict == "not testable"


def test_few_runs_give_no_verdict():
    assert claims.judge_efficiency(sample(1, 9), sample(4), sample(5)).verdict == "no verdict"
    assert claims.judge_generality({"a": (sample(3, 9), sample(1))}).verdict == "no verdict"
    assert claims.judge_composition(sample(1), sample(1, 9), sample(5)).verdict == "no verdict"
    assert claims.judge_extension(made_up(1, 2, runs=9), made_up(1), made_up(0)).verdict == "no verdict"
