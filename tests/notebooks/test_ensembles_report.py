"""Sentences and tables on ensembles, for made-up rewards."""

import numpy as np
import pytest

from lib.chapter_3 import ensembles_report as report
from lib.chapter_3.ensembles import CHOOSERS, LEARNERS, RULES


def rewards(**ends):
    """Two runs of two bins by chooser: 1, then the final reward, given by the first word of the chooser's name."""
    made = {chooser: ends.get(chooser.split()[0].lower(), 0.0) for chooser in CHOOSERS[:-1]}
    return {chooser: np.array([[1.0, end], [1.0, end]]) for chooser, end in made.items()}


def rules(majority, rank, multiplication, addition, learner=0.0):
    """Rewards by chooser, with these final rewards of the four rules and of Sarsa."""
    made = rewards(sarsa=learner)
    for rule, end in zip(RULES, (majority, rank, multiplication, addition)):
        made[rule][:, 1] = end
    return made


def test_the_table_of_lives_has_a_row_for_each_chooser_and_one_for_chance():
    made = {"small": {"Sarsa": np.array([[1.0, 3.0]])}, "large": {"Sarsa": np.array([[0.0, 1.0]])}}
    chance = {"large": np.array([[-0.5, -1.5]]), "small": np.array([[0.25, 0.25]])}
    assert report.lifetime_table(made, chance).splitlines() == [
        "| Chosen by | small | large |", "|---|---|---|", "| Sarsa | 2.00 | 0.50 |", "| chance | 0.25 | −1.00 |"]


@pytest.mark.parametrize("learner, than", [(1.0, "better than"), (5.0, "worse than"),
                                           (4.0, "indistinguishable from")])
def test_the_best_rule_is_compared_with_the_best_learner_at_the_end(learner, than):
    made = rules(2, 1, 4, 3, learner)
    made["majority voting"][:, 0] = 9
    text = report.order_of_rules({"hall": made, "yard": rules(2, 1, 3, 4)})
    assert text.startswith("In the hall, Boltzmann multiplication ends highest and rank voting lowest of the four "
                           "rules; over the whole run majority voting is first. At the end Boltzmann multiplication "
                           f"is {than} the best single learner, Sarsa (difference")
    assert " In the yard, Boltzmann addition ends highest" in text


def test_the_places_of_rank_voting_are_reported_by_both_measures():
    early = rules(1, 2, 3, 4)
    early["rank voting"][:, 0] = 9
    text = report.places_of_rank_voting({"hall": early})
    assert "is third at the end in the hall, first over the run in the hall. So the place of rank voting" in text


def test_rank_voting_may_have_the_same_place_each_time():
    text = report.places_of_rank_voting({"hall": rules(2, 1, 4, 3), "yard": rules(4, 1, 2, 3)})
    assert "is last at the end in the hall, last over the run in the hall, last at the end in the yard, last" in text
    assert text.endswith("So rank voting has the same place in both mazes and by both measures.")


def by_greediness(*levels):
    """Final rewards of one run for each rule at three levels of its greediness."""
    return {rule: [np.array([float(end)]) for end in ends] for rule, ends in zip(RULES, zip(*levels))}


def test_the_table_of_greediness_has_a_column_for_each_level():
    lines = report.greediness_table(by_greediness((1, 2, 3, 4), (5, 6, 7, 8), (9, 10, 11, 12))).splitlines()
    assert lines[2] == "| majority voting | 1.00 | 5.00 | 9.00 |" and len(lines) == 2 + len(RULES)


def test_the_first_and_the_last_are_named_for_each_level_of_greediness():
    text = report.order_by_greediness(by_greediness((4, 1, 2, 3), (1, 2, 3, 4), (1, 4, 2, 3)))
    assert text.startswith("With greediness halved, unchanged and doubled, the first places go to majority voting, "
                           "Boltzmann addition and rank voting, the last to rank voting, majority voting and majority "
                           "voting. ")
    assert text.endswith("with probability 0.9990, rank voting with 0.95.")


def test_rank_voting_that_is_last_at_every_level_is_said_to_be_so():
    text = report.order_by_greediness(by_greediness((4, 1, 2, 3), (4, 1, 2, 3), (4, 1, 2, 3)))
    assert "go to majority voting each time, the last to rank voting each time. Greediness" in text
    assert text.endswith("Still, neither more exploration nor less lifts rank voting from the last place in this maze.")


def test_the_reading_of_a_vote_matters_more_than_the_rule_if_it_makes_more_difference():
    made = rules(3.0, 2.5, 2.9, 2.8)
    made["majority of favourites"][:, 1] = 1.0
    text = report.readings_of_a_vote(made)
    assert "is 2.00 [2.00, 2.00]. That exceeds the range between" in text
    assert "the best and the worst of the four rules, 0.50. The reading of one word" in text
    made["majority of favourites"][:, 1] = 2.8
    text = report.readings_of_a_vote(made)
    assert text.endswith("is 0.20 [0.20, 0.20]. The range between the best and the worst of the four rules is 0.50.")


def test_learners_are_ranked_among_themselves():
    made = rewards(acla=0.5)
    assert report._ranked(made, LEARNERS, "at the end")[0] == "ACLA"
