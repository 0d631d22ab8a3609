"""Learning in the chamber with two levers, against closed forms and a second implementation of the rules."""

from dataclasses import replace

import numpy as np
import pytest

from lib.chapter_4 import credit
from lib.chapter_4.credit import DEFAULT, DIFFERENCE, INVERSION, Chamber, by_role, learn_in
from neorl.agents.rules import CALIBRATED
from neorl.core.kernel import execute
from neorl.core.stream import new_stream, randint, uniform

QUICK = replace(INVERSION, learning_rate=0.3)


def restated(chamber, learning, visits, seed=0, run=0):
    """The values of one run of `learn_in` in plain Python, bout by bout and visit by visit: (visits, 4, 2)."""
    stream = new_stream(np.random.SeedSequence(seed, spawn_key=(run,)))
    q, over, values = np.zeros((4, 2)), True, []
    for _ in range(visits):
        seen, opened = [], None
        while opened is None or len(seen) <= opened[1] + chamber.delay:
            if over:
                lever = execute(randint, stream, 2)
                on = [lever == 0, lever == 1, execute(uniform, stream) < chamber.light,
                      execute(uniform, stream) < chamber.bell]
            seen.append(np.array(on, float))
            over = execute(uniform, stream) < 1 / chamber.hold
            if opened is None and sum(seen)[lever] >= chamber.effort:
                opened = lever, len(seen) - 1
        goal = np.eye(2)[opened[0]]
        if learning.update_on == "step":
            for events in seen[:-1]:
                q += learning.learning_rate * events[:, None] * (learning.discount * q.max(axis=0) - q)
            q += learning.learning_rate * seen[-1][:, None] * (goal - q)
        else:
            times = sum(seen)
            psi = {"share": times / len(seen), "happened": times > 0, "last": seen[-1],
                   "count": times}[learning.credit]
            psi = psi[:, None].astype(float)
            learns = 1.0 if learning.bootstrap else goal
            rate = learning.learning_rate * np.where(psi > 0, psi, learning.absent_decay) * learns
            away = -rate * (goal - q) if learning.absent_form == "away" else -rate * q
            q = np.clip(q + np.where(psi > 0, np.minimum(rate, 1) * (goal - q), away), 0, 1)
        values.append(q.copy())
    return np.array(values)


@pytest.mark.parametrize("chamber", [Chamber(), Chamber(effort=3, hold=2.0, light=0.9), Chamber(delay=7, hold=4.0)])
@pytest.mark.parametrize("learning", [QUICK, replace(QUICK, credit="happened"), replace(QUICK, credit="last"),
                                      replace(QUICK, absent_decay=0.5), replace(QUICK, credit="count"),
                                      replace(QUICK, absent_decay=0.5, absent_form="away"),
                                      replace(QUICK, absent_decay=0.5, bootstrap=False),
                                      replace(DEFAULT, learning_rate=0.3),
                                      replace(QUICK, discount=0.9, update_on="step")])
@pytest.mark.filterwarnings("ignore:overflow encountered")
def test_the_kernel_does_what_the_rules_say(chamber, learning):
    values = learn_in(chamber, learning, visits=20, runs=2, seed=5)
    np.testing.assert_allclose(values[1], restated(chamber, learning, 20, seed=5, run=1), atol=2e-5)


def test_with_one_step_a_visit_both_rules_are_the_same():
    chamber = Chamber(effort=1, hold=3.0)
    np.testing.assert_array_equal(learn_in(chamber, INVERSION, 50, 3), learn_in(chamber, DIFFERENCE, 50, 3))


def test_a_held_lever_has_the_closed_form_values_of_inversion_and_temporal_difference():
    """A lever held throughout a visit of T steps is worth 1 to inversion, and to temporal difference the solution
    of q = 1 / T + (1 − 1 / T) γ q."""
    chamber, steps = Chamber(effort=8, hold=10_000.0, light=0.0, bell=0.0), 8
    rules = replace(INVERSION, learning_rate=0.1), replace(DIFFERENCE, learning_rate=0.01)
    (inverted,), (stepwise,) = (learn_in(chamber, rule, 600, 1) for rule in rules)
    lever = int(inverted[-1, 1].sum() > inverted[-1, 0].sum())
    assert inverted[-1, lever, lever] == pytest.approx(1.0, abs=1e-3)
    expected = 1 / steps / (1 - 0.8 * (1 - 1 / steps))
    assert stepwise[-1, lever, lever] == pytest.approx(expected, rel=0.05)


def test_an_event_that_always_occurs_is_worth_the_share_of_each_exit_to_inversion():
    values = learn_in(Chamber(light=1.0, hold=5.0), replace(INVERSION, learning_rate=0.02), 400, 40)
    np.testing.assert_allclose(values[:, -1, 2].mean(axis=0), 0.5, atol=0.02)


def test_the_stream_is_the_same_for_any_number_of_runs_and_any_rule():
    few, many = (learn_in(Chamber(), INVERSION, 30, runs) for runs in (2, 4))
    np.testing.assert_array_equal(few, many[:2])
    assert (many[0] != many[1]).any()
    exits = [np.diff(np.pad(learn_in(Chamber(), rule, 30, 1)[0, :, :2].max(axis=1), ((1, 0), (0, 0))), axis=0) > 0
             for rule in (INVERSION, replace(INVERSION, credit="last"))]
    np.testing.assert_array_equal(*exits)


def test_compared_rules_learn_from_the_same_streams_as_alone():
    rules = {"one": INVERSION, "other": DIFFERENCE}
    found = credit.learn_by_each(Chamber(effort=3), rules, 20, 2, seed=4)
    assert list(found) == ["one", "other"]
    np.testing.assert_array_equal(found["other"], learn_in(Chamber(effort=3), DIFFERENCE, 20, 2, seed=4))
    by_hold = credit.vary_hold((2, 50), rules, 20, 2, seed=4)
    assert list(by_hold) == [2, 50]
    np.testing.assert_array_equal(by_hold[50]["one"], learn_in(Chamber(hold=50), INVERSION, 20, 2, seed=4))


def test_with_the_same_horizon_the_steps_of_a_visit_are_discounted_as_a_visit():
    rules = credit.variants(Chamber(effort=5))
    assert rules["temporal difference, same horizon"].discount ** 5 == pytest.approx(INVERSION.discount)
    assert rules["temporal difference, same horizon"].update_on == "step"
    of_inversion = [(rule.credit, rule.absent_decay) for rule in rules.values() if rule.update_on == "cell"]
    assert of_inversion == [("happened", 0), ("last", 0), ("share", 1)]


def test_roles_are_means_over_both_exits():
    values = np.array([[1.0, 0.2], [0.4, 0.8], [0.5, 0.7], [0.0, 0.1]])
    np.testing.assert_allclose(by_role(values), [0.9, 0.3, 0.6, 0.05])
    assert credit.lead_of_cause(values) == pytest.approx(0.3)
    assert credit.ROLES == ("cause", "other lever", "light", "bell")


@pytest.mark.parametrize("change, message", [
    ({"effort": 0}, "effort must be .*, but is 0"), ({"delay": -1}, "delay must be .*, but is -1"),
    ({"hold": 0.5}, "hold must be .*, but is 0.5"),
    ({"light": 1.5}, "light must be .*, but is 1.5"), ({"bell": -0.1}, "bell must be .*, but is -0.1"),
])
def test_a_bad_chamber_is_refused(change, message):
    with pytest.raises(ValueError, match=message):
        Chamber(**change)


@pytest.mark.parametrize("change, message", [
    ({"chamber": None}, "chamber must be .*, but is None"),
    ({"learning": replace(INVERSION, credit="activity")},
     "credit must be 'share', 'happened', 'count' or 'last', but is 'activity'"),
    ({"visits": 0}, "visits must be .*, but is 0"), ({"runs": 0}, "runs must be .*, but is 0"),
    ({"seed": -1}, "seed must be .*, but is -1"),
])
def test_learning_in_a_chamber_refuses_what_it_cannot_do(change, message):
    with pytest.raises(ValueError, match=message):
        learn_in(**{"chamber": Chamber(), "learning": INVERSION, "visits": 1, "runs": 1, "seed": 0, **change})


def test_the_default_rule_is_that_of_the_agents_at_the_rates_of_the_others():
    assert replace(DEFAULT, learning_rate=CALIBRATED.learning_rate, discount=CALIBRATED.discount) == CALIBRATED
    assert (DEFAULT.learning_rate, DEFAULT.discount) == (INVERSION.learning_rate, INVERSION.discount)


def test_an_agent_that_is_put_back_remembers_no_earlier_cell():
    learned = [learn_in(Chamber(), replace(DEFAULT, memory=memory), 30, 2) for memory in (0.0, 5.0)]
    np.testing.assert_array_equal(*learned)
