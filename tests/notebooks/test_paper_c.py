"""The page of paper C: networks under readings, and the weight of recursion in the last one."""

from dataclasses import replace

import numpy as np
import pytest

from neorl import Result, WaterWorld, brownian
from lib.paper_c import wiring
from lib.paper_c.experiments import NETWORKS, explorer_conditions, live, neighbours, networks, recur
from lib.paper_c.findings import drastic_level, final_rates, finals, in_short, in_words, recursion_in_words
from neorl.evidence.priors import TO_THE_LETTER
from neorl.evidence.reading import GROUPS, Reading, networks as agents
from neorl.evidence.statistics import Estimate

LIKE_THE_THESIS = {"A": 0.12, "B": 0.2, "C": 0.3, "D": 0.6}


def made_up(agent, rate, runs=12, bins=3_000):
    """A result in which every run earns about `rate` per second in its second half, and nothing before."""
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


def test_weights_that_the_networks_do_not_run_have_few_runs(monkeypatch):
    monkeypatch.setattr("lib.shared.side_by_side.sweep", lambda conditions: conditions)
    (made,) = recur({"book": Reading()}, [-3.0, -1.0, 0.0], steps=300, runs=30).values()
    assert [condition.runs for condition in made] == [10, 30, 30]


def test_what_was_found_is_put_in_words(results):
    words = in_words({"book": results})
    assert words.startswith("- **Book.** By reward")
    numbers = [f"{result.rate(0.8, 1.0).mean():.2f}" for result in networks(results).values()]
    assert " < ".join(f"{name} ({number})" for name, number in zip(NETWORKS, numbers)) in words
    backwards = results | {("network", "A"): results["network", "D"], ("network", "D"): results["network", "A"]}
    assert "order is D (" in in_words({"book": backwards})
    short = in_short({"to the letter": backwards, "calibrated": results})
    assert f"the order is A ({numbers[0]}) <" in short and short.index("D (") < short.index("to the letter")
    assert "≈" not in short
    alike = results | {("network", "B"): results["network", "A"]}
    short = in_short({"to the letter": alike, "calibrated": results})
    assert f"A ({numbers[0]}) ≈ B ({numbers[0]}) <" in short and "lead marked ≈ includes 0. Calibrated" in short


def test_neighbours_differ_in_one_choice_and_are_more_with_many_runs():
    reading = Reading(network_resolutions=(3, 7, 23), memory=5.0, scale=0.5, bootstrap=True)
    made = neighbours(reading, runs=99)
    assert list(made) == ["maps of primes", "no memory", "places × 5", "valence in vectors"]
    assert made["places × 5"] == replace(reading, network_gain=5.0)
    more = neighbours(reading, runs=100)
    assert list(more)[:4] == list(made) and "no bootstrapping" in more and "bootstrapping" not in more
    assert more["ten times as far"].scale == 5.0 and more["valence in vectors"].vectors == "signed"


def test_the_explorer_offers_the_networks_of_both_readings(results):
    letter = dict.fromkeys(results, "letter")
    offered = explorer_conditions({"to the letter": letter, "calibrated": results})
    name = "Paper C, figure 4e: network"
    assert [*offered][:5] == [*(f"{name} {each}" for each in NETWORKS), f"{name} A, to the letter"]
    assert offered[f"{name} D"] is results["network", "D"] and offered[f"{name} D, to the letter"] == "letter"


def test_recursion_has_to_lift_a_network_that_earns_something(results):
    (level,) = drastic_level(results).values()
    assert level == pytest.approx(1.5 * results["network", "C"].rate(0.8, 1.0).mean())
    assert list(drastic_level(results)) == ["thesis: D beyond 1.5 × C"]
    assert [*drastic_level(results | {("network", "C"): made_up(brownian(), -0.1)}).values()] == [0.0]


def test_final_rates_over_weights_are_those_of_the_last_fifth(results):
    ((low, high),) = finals({"book": [results["network", "A"], results["network", "D"]]}).values()
    assert high.value == pytest.approx(results["network", "D"].rate(0.8, 1.0).mean()) and low.high < high.low


def test_the_best_weight_of_recursion_is_reported_with_the_reward_without_recursion():
    found = {"to the letter": [Estimate(0.3, 0.2, 0.4), Estimate(0.1, 0.0, 0.2), Estimate(-0.2, -0.3, -0.1)],
             "calibrated": [Estimate(0.0, -0.1, 0.1), Estimate(0.2, 0.1, 0.3), Estimate(0.5, 0.4, 0.6)]}
    assert recursion_in_words([-0.5, 0.0, 1.0], found) == (
        "Under the reading *to the letter* the best weight is r\u00a0=\u00a0−0.5, which earns 0.30 [0.20, 0.40]; "
        "without recursion it is 0.10 [0.00, 0.20]. Under the reading *calibrated* the best weight is "
        "r\u00a0=\u00a01, which earns 0.50 [0.40, 0.60]; without recursion it is 0.20 [0.10, 0.30].")


def test_the_table_has_a_row_for_each_network_and_reading(results):
    rows = final_rates({"one": results, "other": results}).splitlines()[2:]
    assert [row.split(" | ")[:2] for row in rows[:3]] == [["| A", "one"], ["| A", "other"], ["| B", "one"]]
    assert len(rows) == 8 and rows[-1].endswith("| 0.0 |")


MOVING = Reading(0.03, 0.8, "share", absent_decay=0.0, memory=0.0, bootstrap=True, terminal=True,
                 object_state="object", exploration=0.1)


def test_desires_that_land_on_the_agent_are_distinguished_from_those_that_do_not():
    near, far = (wiring.distances({"book": replace(MOVING, scale=scale)},
                                 60_000, runs=2) for scale in (1e-6, 1e6))
    assert list(near) == [("book", name) for name in NETWORKS]
    for name in NETWORKS:
        widths, share = near["book", name]
        assert widths.shape == (2,) and np.all(widths < 0.01) and np.all(share == 1)
    widths, share = far["book", "D"]
    assert np.all(widths > 1) and np.all(share < 1)
    assert wiring.distance_table(near).count("\n") == 1 + len(NETWORKS)
