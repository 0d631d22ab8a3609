"""What the page of paper C computes: networks under readings, and how strongly the last one recurs."""

from dataclasses import replace

import numpy as np
import pytest

from neorl import Result, WaterWorld, brownian
from neorl.chapters.paper_c import NETWORKS, final_rates, in_words, live, networks, recur
from neorl.evidence.priors import TO_THE_LETTER
from neorl.evidence.reading import GROUPS, Reading, networks as agents
from neorl.evidence.rules_paper_c import judge_networks

LIKE_THE_THESIS = {"A": 0.12, "B": 0.2, "C": 0.3, "D": 0.6}


def made_up(agent, rate, runs=12, bins=3_000):
    """A result in which every run earns `rate` a second, give or take some luck, in the second half of its life."""
    hits = np.zeros((runs, bins, 2), np.int16)
    hits[:, bins // 2 :, 0] = np.random.default_rng(0).random((runs, bins - bins // 2)) < 0.2 * rate
    return Result(agent, WaterWorld(), 10 * bins, runs, 0, hits[..., 0].astype(np.float32), hits)


@pytest.fixture
def results():
    made = {("network", name): made_up(agent, LIKE_THE_THESIS[name]) for name, agent in agents(Reading()).items()}
    return made | {("brownian", 3): made_up(brownian(), 0.05)}


def test_the_networks_are_run_under_each_reading(cache_folder):
    found = live({"to the letter": TO_THE_LETTER, "book": Reading()}, steps=300, runs=3)
    assert [set(each) for each in found.values()] == [set(GROUPS["networks"])] * 2
    assert networks(found["to the letter"])["D"].agent == agents(TO_THE_LETTER)["D"]
    assert networks(found["book"])["A"].runs == 3


def test_recursion_is_varied_and_none_is_network_c(cache_folder):
    (results,) = recur({"book": Reading()}, [-2.0, 0.0, 1.0], steps=300, runs=2).values()
    expected = [agents(replace(Reading(), recursion=-2.0))["D"], agents(Reading())["C"],
                agents(replace(Reading(), recursion=1.0))["D"]]
    assert [result.agent for result in results] == expected


def test_what_the_networks_page_has_not_run_yet_has_few_runs(monkeypatch):
    monkeypatch.setattr("neorl.chapters.paper_c.sweep", lambda conditions: conditions)
    (made,) = recur({"book": Reading()}, [-3.0, -1.0, 0.0], steps=300, runs=30).values()
    assert [condition.runs for condition in made] == [10, 30, 30]


def test_what_was_found_is_put_in_words(results):
    judged = judge_networks(*networks(results).values(), results["brownian", 3])
    words = in_words(results, judged)
    assert "● reproduced: C1, C2, C3, C4" in words
    numbers = [f"{result.rate(0.8, 1.0).mean():.2f}" for result in networks(results).values()]
    assert " < ".join(f"{name} ({number})" for name, number in zip(NETWORKS, numbers)) in words
    backwards = results | {("network", "A"): results["network", "D"], ("network", "D"): results["network", "A"]}
    assert "order is D (" in in_words(backwards, judged)


def test_the_table_has_a_row_for_each_network_and_reading(results):
    rows = final_rates({"one": results, "other": results}).splitlines()[2:]
    assert [row.split(" | ")[:2] for row in rows[:3]] == [["| A", "one"], ["| A", "other"], ["| B", "one"]]
    assert len(rows) == 8 and rows[-1].endswith("| 0.0 |")
