"""Runs, tables and sentences of the page on calibration, for made-up rows whose answers are known."""

import math
from dataclasses import replace

import numpy as np
import pytest

from lib import calibration
from lib.study.calibration import design
from lib.study.calibration_results import Together
from lib.study.calibration_table import Row
from lib.study.calibration_targets import CLAIMS, GROUPS, TARGETS, Measure
from neorl.evidence.priors import TO_THE_LETTER, WITHIN
from neorl.evidence.reading import Reading


def statistics(failing):
    """Made-up statistics that agree with all targets except those of the failing claims."""
    found = {}
    for name, target in TARGETS.items():
        edge, outward = (target.low, -1) if math.isfinite(target.low) else (target.high, 1)
        off = 2 * target.scale if target.claim in failing else -1e-3
        found[name] = Measure(edge + outward * off, 0.25)
    return found


def rows(*failing):
    """A complete row for each set of failing claims, with the readings of a design."""
    return [Row(0, i, 2, 3_000, reading, statistics(claims))
            for i, (reading, claims) in enumerate(zip(design(16), failing))]


@pytest.fixture
def asked(monkeypatch):
    """Record the requested runs instead of running them: a list of (row, groups)."""
    calls = []

    def lives(row, groups=tuple(GROUPS)):
        calls.append((row, tuple(groups)))
        return {group: row.runs for group in groups}

    monkeypatch.setattr(calibration, "lives", lives)
    monkeypatch.setattr(calibration, "measured", lambda row, life: replace(row, statistics=life))
    return calls


def test_single_maps_have_fewer_runs_unless_there_are_a_hundred():
    assert [calibration.few(runs) for runs in (1, 4, 20, 100)] == [2, 2, 4, 20]
    assert [calibration.runs_of_single_maps(runs) for runs in (4, 20, 99, 100)] == [2, 4, 19, 100]


def test_the_best_row_runs_once_more_with_its_reading_and_fresh_seeds(asked):
    (best,) = rows(())
    row, life = calibration.confirm(best, 600_000, 20, 1_000_003)
    assert (row.reading, row.seed, row.steps, row.runs) == (best.reading, 1_000_003, 600_000, 20)
    assert life == row.statistics == dict.fromkeys(GROUPS, 20) | {"single": 4}
    assert calibration.confirm(best, 600_000, 1, 0)[0].runs == 2


def test_the_letter_runs_in_all_groups_with_a_fifth_of_the_runs(asked):
    row = calibration.to_the_letter(600_000, 20, 1_000_003)
    assert (row.reading, row.seed, row.steps, row.runs) == (TO_THE_LETTER, 1_000_003, 600_000, 4)
    assert row.statistics == dict.fromkeys(GROUPS, 4)


def test_other_readings_run_twice_without_the_single_maps(asked):
    first, best, other = rows((), (), ())
    assert len(calibration.lives_of_others([first, replace(best, seed=99), other], best, 600_000, 50)) == 2
    assert [(row.reading, row.seed, row.runs, row.steps) for row, _ in asked] == [
        (first.reading, 50, 2, 600_000), (other.reading, 52, 2, 600_000)]
    assert {groups for _, groups in asked} == {tuple(GROUPS)[:-1]}


def test_rows_that_agree_with_all_targets_are_counted():
    assert calibration.agreeing(rows((), ["C4"], ())) == "2"
    assert calibration.agreeing(rows(["C4"])) == "None"


@pytest.fixture
def together():
    """Three claims, of which B1 holds with no other; by chance it would hold with A6, but hardly with A7."""
    both = np.array([[9, 5, 0], [5, 8, 0], [0, 0, 7]])
    expected = np.array([[9.0, 4.0, 3.5], [4.0, 8.0, 1.2], [3.5, 1.2, 7.0]])
    return Together(("A6", "A7", "B1"), np.full((3, 3), 20), both, expected, [(("A6", "A7"), 5), (("B1",), 7)])


def test_pairs_that_never_hold_together_are_named(together):
    assert calibration.never_together(together) == "A6 and B1"
    assert calibration.unseen_pairs(together) == "A6 with B1 (3.5); A7 with B1 (1.2)"
    seen = together._replace(both=np.ones((3, 3)))
    assert calibration.never_together(seen) == calibration.unseen_pairs(seen) == "none"


def test_sets_of_claims_are_listed_with_those_that_they_lack(together):
    assert calibration.largest_sets(together).splitlines()[2:] == ["| A6, A7 | 5 | B1 |", "| B1 | 7 | A6, A7 |"]
    many = together._replace(sets=together.sets * 20)
    assert len(calibration.largest_sets(many).splitlines()) == 2 + calibration.SETS


def test_unseen_pairs_are_listed_up_to_a_limit():
    none = Together(CLAIMS, np.ones((13, 13)), np.zeros((13, 13)), np.ones((13, 13)), [])
    assert len(calibration.unseen_pairs(none).split("; ")) == calibration.PAIRS


def test_numbers_are_marked_where_they_agree_with_the_thesis():
    good, bad = rows((), ["A7", "C1"])
    lines = calibration.numbers(bad, good, good).replace("\u00a0", " ").splitlines()[2:]
    assert len(lines) == len(TARGETS)
    assert [line.split(" | ")[0] for line in lines] == sorted(line.split(" | ")[0] for line in lines)
    assert "| A7 | three maps / N7 | 3.5 | 2.5 … 5 | ○ 1.50 ± 0.25 | ● 2.50 ± 0.25 | ● 2.50 ± 0.25 |" in lines
    (rise,) = [line for line in lines if "A, final − early" in line]
    assert "| improves over time | 0.01 … ∞ | ○ −0.05 ± 0.25 |" in rise
    (weak,) = [line for line in lines if "A / C" in line]
    assert "| −∞ … 0.5 | ○ 0.70 ± 0.25 | ● 0.50 ± 0.25 |" in weak


def test_readings_are_compared_in_the_choices_that_the_text_leaves_open():
    table = calibration.choices({"To the letter": TO_THE_LETTER, "Best": Reading()})
    assert table.startswith("| Choice | To the letter | Best |\n|---|---|---|\n")
    assert "| form of absence | away | " in table and len(table.splitlines()) == 2 + len(WITHIN)


@pytest.mark.parametrize("change, idle", [({}, True), ({"bootstrap": True}, False),
                                          ({"memory": 3.0}, False)])
def test_the_discount_is_idle_without_bootstrapping_and_memory(change, idle):
    reading = Reading(**{"bootstrap": False, "memory": 0.0, **change})
    assert ("γ has no effect" in calibration.idle_discount(reading)) == idle
    assert idle or calibration.idle_discount(reading) == ""


def test_claims_are_sorted_by_the_distance_that_remains_without_them():
    table = rows(["C4"], ["A6", "A7", "B1"])
    lines = calibration.without_a_claim(table).splitlines()[2:]
    held = ", ".join(claim for claim in CLAIMS if claim != "C4")
    assert lines[0] == f"| nothing | {table[0].distance:.2f} | {held} |"
    assert lines[1] == f"| C4 | 0.00 | {held} |"
    distances = [float(line.split(" | ")[1]) for line in lines[1:]]
    assert distances == sorted(distances) and len(distances) == len(CLAIMS)


def test_rows_are_counted_by_group_and_wave():
    table = [replace(row, wave=2 * i) for i, row in enumerate(rows((), (), ()))]
    table[1] = replace(table[1], statistics={name: Measure(0.0, 0.0) for name in GROUPS["layers"].targets})
    assert calibration.rows_by_group(table) == (
        "2 places, 3 layers, 2 objects, 2 both, 2 networks, 2 single; in 5 waves")


def test_every_target_has_its_reason():
    lines = calibration.targets().splitlines()[2:]
    assert len(lines) == len(TARGETS)
    assert "| B4 | minutes of both | 10 | 30 or less, as in the rule |" in lines


def test_rows_that_equal_their_rerun_are_counted():
    one, other = rows((), ["C4"])
    assert calibration.equal([(one, one), (one, other), (other, replace(other))]) == 2


def test_the_box_counts_readings_and_claims(together):
    letter, confirmed = rows(["C4"], ())
    text = calibration.in_short(rows((), ["C4"], ()), letter, confirmed, together)
    assert text.startswith("Of 3 readings within the text that were run in every condition, 2 agree with all")
    assert f"{len(letter.held)} of 3 claims hold; under the best reading, in 2 runs" in text
    assert "hold together in any one reading are 2." in text
