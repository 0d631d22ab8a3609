"""Claims are judged of the conditions that they are about, without a verdict where runs are shorter."""

from dataclasses import replace

import numpy as np
import pytest

from companion.page import judging
from neorl import Condition, Result
from companion.thesis.reading import TO_THE_LETTER, Reading

PAPER_C = judging.papers_conditions(Reading(), "networks")


def results(steps=300_000, runs=12, **others):
    """Results of paper C's conditions in which nothing is earned, a list. others: {key: Condition} in place of some."""
    conditions = {key: replace(each, steps=min(steps, each.steps), runs=runs) for key, each in PAPER_C.items()}
    bins = {key: np.zeros((runs, each.steps // 10), np.float32) for key, each in conditions.items()}
    return [Result(others.get(key[1], each), bins[key], np.zeros((*bins[key].shape, 2), np.int16))
            for key, each in conditions.items()]


def with_another_node(condition):
    agent = condition.agent
    return replace(condition, agent=replace(agent, nodes=[*agent.nodes, replace(agent.nodes[-1], name="another")]))


@pytest.mark.parametrize("ran, reading, verdicts", [
    (results(), Reading(), {"not testable"}),
    (results() + results(D=with_another_node(PAPER_C["network", "D"])), Reading(), {"not testable"}),
    (results(runs=9) + results() + results(steps=299_999, runs=20), Reading(), {"not testable"}),
    (results(steps=299_999), Reading(), {"no verdict"}), (results(runs=9), Reading(), {"no verdict"}),
    (results(), Reading(network_gain=2.0), set()), (results(), TO_THE_LETTER, set()),
    (results(D=with_another_node(PAPER_C["network", "D"])), Reading(), set()),
    (results(D=replace(PAPER_C["network", "D"], world=replace(PAPER_C["network", "D"].world, n_creeps=4))), Reading(),
     set()),
    (results()[:-1], Reading(), set())])
def test_networks_are_judged_if_they_are_the_paper_s(ran, reading, verdicts):
    claims = judging.judge_papers(ran, reading, "networks")
    assert {claim.verdict for claim in claims} == verdicts and len(claims) == (5 if verdicts else 0)


def test_agents_that_change_at_the_same_share_of_a_run_are_the_same():
    turned = judging.papers_conditions(Reading(), "revaluing")["revalued"]
    short = judging.readings.conditions(Reading(), 3_001, 2, groups=("revaluing",))["revalued"]
    assert judging.same(short, turned) and not judging.same(replace(short, changes=()), turned)
    later = replace(short, changes=((2_000, short.changes[0][1]),))
    assert not judging.same([short, later], [turned, turned]) and not judging.same([short], [turned, turned])


def test_other_things_are_compared_as_they_stand():
    assert judging.same({"maze": (1, "a"), "day": 11}, {"maze": (1, "a")}) and not judging.same((1, "b"), (1, "a"))
    assert isinstance(next(iter(PAPER_C.values())), Condition)
