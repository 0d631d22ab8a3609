"""Sentences and tables on heads and the single learner, for made-up games."""

import numpy as np
import pytest

from lib.chapter_3 import hybrid_reward_report as report
from lib.chapter_3.hybrid_reward import Game, Played

EDGES = np.array([0, 100, 200, 1_000])


def played(rewards, caught=0, late=0, known=(3, 5), edges=EDGES):
    """Two runs with these rewards per bin; of 100 games in the last, `caught` end by the ghost and `late` by time."""
    ends = np.zeros((2, len(rewards), 3), int)
    ends[0, -1] = [100 - caught - late, caught, late]
    return Played(edges, np.array([rewards, rewards], float), ends, np.array(known))


def kinds(one, heads, latent):
    return {"one learner": one, "heads": heads, "latent heads": latent}


def test_the_table_has_a_row_for_each_kind_with_its_states_and_what_it_knows():
    of_kinds = kinds(played([0, 0, -1.5]), played([0, 0, 2]), played([0, 0, 3], known=(1_000, 2_000)))
    assert report.finals(Game(), of_kinds).splitlines()[2:] == [
        "| One learner | 350,464 | 4 | −1.50 [−1.50, −1.50] |", "| Heads | 1,665 | 4 | 2.00 [2.00, 2.00] |",
        "| Latent heads | 1,665 | 1,500 | 3.00 [3.00, 3.00] |"]


@pytest.mark.parametrize("latent, expected", [
    (5, "Latent heads learn more from the same steps than heads (difference 3.00"),
    (1, "Latent heads learn less from the same steps than heads (difference −1.00"),
    (2, "Latent heads are indistinguishable from heads"),
])
def test_latent_heads_are_better_than_heads_if_the_interval_says_so(latent, expected):
    text = report.lead_of_heads(kinds(played([0, 0, 0]), played([0, 0, 2]), played([0, 0, latent])))
    assert expected in text and "with probability 1.00 [1.00, 1.00]. " in text


def test_the_single_learner_catches_up_where_its_mean_first_reaches_the_final_score_of_heads():
    heads = played([9, 9, 4], edges=np.array([0, 20, 30, 50]))
    text = report.catching_up(kinds(played([1, 4, 7]), heads, None))
    assert text == ("The single learner does catch up: after 200 steps its mean first reaches 4.0, the score of heads "
                    "after 50 steps.")


def test_the_final_score_of_a_single_learner_that_does_not_catch_up_is_reported():
    heads = played([0, 0, -1], edges=np.array([0, 20, 30, 50]))
    text = report.catching_up(kinds(played([-4, -3, -2.5]), heads, None))
    assert text == ("In 1,000 steps the single learner does not reach the −1.0 that heads score after 50; it ends at "
                    "−2.5.")


@pytest.mark.parametrize("caught, expected", [(6, "The separation thus has a price"),
                                              (7, "does not show in this number.")])
def test_the_separation_has_a_price_if_all_heads_are_caught_more_often(caught, expected):
    text = report.price(kinds(played([0, 0, 0], caught), played([0, 0, 0], 9), played([0, 0, 0], 7)))
    assert expected in text
    assert f"is caught in {caught} % of its games, heads in 9 % and latent heads in 7 %." in text


def test_the_best_discounts_of_heads_are_reported_and_how_often_they_run_out_of_time():
    swept = kinds([played([0, 0, x]) for x in (0, 0, 1)],
                  [played([0, 0, x], late=late) for x, late in ((5, 0), (4, 1), (3, 20))],
                  [played([0, 0, x], late=late) for x, late in ((2, 0), (3, 2), (2, 30))])
    text = report.best_discounts([0.3, 0.5, 0.9], swept)
    assert text.startswith("After 1,000 steps heads do best at γ = 0.3 and latent heads at γ = 0.5, of those tried. "
                           "At γ = 0.5, 1.0 % of the games of heads run out of time; at γ = 0.9 it is 20.0 % (latent "
                           "heads: 2.0 % and 30.0 %).")
    assert text.endswith("At every discount, though, heads of either kind lead the single learner with the same "
                         "experience.")


def test_heads_whose_worst_discount_is_below_the_best_of_the_single_learner_are_not_always_ahead():
    swept = kinds([played([0, 0, x]) for x in (0, 2, 0)], [played([0, 0, x]) for x in (5, 4, 3)],
                  [played([0, 0, x]) for x in (2, 3, 4)])
    text = report.best_discounts([0.3, 0.5, 0.9], swept)
    assert text.endswith("At the worst discount heads no longer lead the single learner with the same experience.")
