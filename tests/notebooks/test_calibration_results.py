"""The calibration table and the conclusions drawn from it; a sample of this package's table is recomputed."""

import math
from dataclasses import replace

import numpy as np
import pytest
from matplotlib import pyplot as plt

from lib.study import calibration_figures
from lib.study import calibration_results, calibration_table
from lib.study.calibration import design
from lib.study.calibration_results import Posterior, Together
from lib.study.calibration_table import Row, read_table, write_table
from lib.study.calibration_targets import CLAIMS, GROUPS, TARGETS, Measure
from neorl import CALIBRATED
from neorl.evidence.priors import WITHIN
from neorl.evidence.reading import Reading

SAMPLE = 3  # rows of the table that are recomputed, in the cheapest group


def statistics(holding, names=tuple(TARGETS)):
    """Made-up statistics of targets under which only the given claims hold."""
    found = {}
    for name in names:
        target = TARGETS[name]
        if target.claim in holding:
            value = max(target.low, -1e3) if target.high == math.inf else min(target.high, 1e3)
        else:
            value = target.low - 2 * target.scale if math.isfinite(target.low) else target.high + 2 * target.scale
        found[name] = Measure(float(f"{value:.5g}"), 0.0)
    return found


def rows(*claims, points=64):
    """A complete row for each set of claims that hold, with the readings of a design."""
    return [Row(0, i, 2, 3_000, reading, statistics(holding))
            for i, (reading, holding) in enumerate(zip(design(points), claims))]


def test_a_table_reads_back_exactly(tmp_path):
    table = rows(*[{"A6", "B1"}] * 20)
    table[3] = replace(table[3], wave=2, statistics={name: table[3].statistics[name]
                                                     for name in GROUPS["layers"].targets})
    table[4] = replace(table[4], statistics=table[4].statistics | {"C4": Measure(1.2345e-05, 0.1)})
    write_table(table, tmp_path / "table.csv")
    assert read_table(tmp_path / "table.csv") == table
    assert table[3].groups == ("layers",) and not table[3].complete
    assert table[4].groups == tuple(GROUPS) and table[4].complete


def test_a_table_of_another_version_is_refused(tmp_path):
    path = tmp_path / "table.csv"
    write_table(rows({"A6"}), path)
    path.write_text(path.read_text().replace("discount", "horizon", 1))
    with pytest.raises(ValueError, match="other columns than this version has: discount, horizon"):
        read_table(path)


def test_a_row_runs_again_as_it_was(cache_folder):
    made = [Row(0, 5 + i, 2, 1_500, reading) for i, reading in enumerate(design(2))]
    table = calibration_table.run(made, "networks")
    table[0] = calibration_table.run(table[:1], "layers")[0]
    assert table[0].groups == ("layers", "networks")
    pairs = calibration_table.rerun(table, 2, seed=1)
    assert [old for old, _ in pairs] == table and all(old == new for old, new in pairs)
    table[1] = replace(table[1], statistics=table[1].statistics | {"C3": Measure(9.0, 0.0)})
    assert [old == new for old, new in calibration_table.rerun(table, 2)] == [True, False]
    alone = calibration_table.rerun(table, 2, groups=("layers",))
    assert [set(new.statistics) for _, new in alone] == [set(GROUPS["layers"].targets), set()]
    with pytest.raises(ValueError, match="n must be an integer from 1 to 2, but is 3"):
        calibration_table.rerun(table, 3)


def test_the_default_is_the_best_confirmed_reading_of_the_table_of_this_package():
    best = calibration_results.best(read_table())
    assert best.reading == Reading() and best.reading.within_the_text
    assert best.reading.learning == CALIBRATED


def test_a_sample_of_the_table_of_this_package_runs_again_as_it_was(cache_folder):
    table = read_table()
    assert len(table) >= 1_000 and sum(row.complete for row in table) >= 70
    assert all(row.reading.within_the_text for row in table)
    for old, new in calibration_table.rerun(table, SAMPLE, groups=("layers",)):
        assert old == new


def test_the_accepted_rows_agree_with_all_targets_or_are_the_nearest():
    table = rows(*[set(CLAIMS) - {claim} for claim in CLAIMS], set(), set())
    found, rule = calibration_results.accepted(table)
    assert "nearest" in rule and len(found) == len(table)
    assert [row.distance for row in found] == sorted(row.distance for row in table)
    table += [replace(table[0], runs=9, statistics=statistics(CLAIMS))]
    found, rule = calibration_results.accepted(table)
    assert found == table[-1:] and "agree with all" in rule
    assert calibration_results.best(table) == table[-1]
    with pytest.raises(ValueError, match="none of them with all groups"):
        calibration_results.best([replace(table[0], statistics={})])


def test_the_best_is_a_confirmed_row_and_a_reading_counts_as_it_was_confirmed():
    lucky, honest = rows(CLAIMS, {"A6"})
    assert calibration_results.best([lucky, honest]) == lucky
    confirmed = replace(lucky, seed=9, runs=20, statistics=statistics({"A7"}))
    assert calibration_results.best([lucky, honest, confirmed]) == confirmed
    assert calibration_table.leading([honest, lucky]) == [lucky, honest]
    assert calibration_table.nearest([lucky, confirmed, honest]) == sorted([confirmed, honest],
                                                                           key=lambda row: row.distance)


def test_shares_at_the_papers_lengths_are_of_readings_that_nothing_has_chosen():
    table = rows(*[{"A6"}] * 8, *[set()] * 8)
    table += [replace(row, wave=1) for row in rows(*[{"A6"}] * 4)]
    found = calibration_results.evenly(table)
    assert found["A6"] == {"agrees": 8, "measured": 16} and found["C4"] == {"agrees": 0, "measured": 16}


def test_claims_that_exclude_each_other_are_found():
    table = rows(*[{"A6", "A7"}] * 12, *[{"B1", "A7"}] * 12, *[{"B3"}] * 2, *[set()] * 6)
    table += [replace(row, statistics=statistics({"C4"}, GROUPS["networks"].targets)) for row in table]  # not complete
    found = calibration_results.claims_together(table)
    at = CLAIMS.index
    assert found.both[at("A6"), at("A7")] == 12 and found.rows[at("A6"), at("A7")] == 32
    assert found.both[at("A6"), at("B1")] == 0 and found.expected[at("A6"), at("B1")] == pytest.approx(4.5)
    assert found.never == [("A6", "B1")]  # B3 holds too rarely to count
    assert found.unseen[0] == ("A6", "B1", pytest.approx(4.5)) and ("A6", "B3") in [pair[:2] for pair in found.unseen]
    assert found.sets == [(("A6", "A7"), 12), (("A7", "B1"), 12), (("B3",), 2)]
    assert found.both[at("C4"), at("C4")] == 32 and found.rows[at("C4"), at("C4")] == 64


def test_what_would_have_to_give_is_the_claim_that_no_row_holds_with_the_others():
    table = rows(set(CLAIMS) - {"B1"}, set(CLAIMS) - {"A3", "A4"})
    found = calibration_results.giving(table)
    assert found["B1"] == (0.0, table[0])
    assert found["A3"][0] > 0 and found["C4"][0] > 0


def test_a_posterior_knows_the_choice_that_matters_and_no_other():
    table = [replace(row, statistics=statistics(CLAIMS if row.reading.contact == "rounded" else ()))
             for row in rows(*[()] * 128, points=128)]
    found = calibration_results.posterior(table, 2_000)
    assert found.weights.sum() == pytest.approx(1) and 500 < found.effective < 1_600
    contact = calibration_results.marginal("contact", found)
    assert contact.levels == ("rounded", "truncated") and contact.posterior[0] > 0.9
    said = {name: calibration_results.marginal(name, found).information for name in WITHIN}
    assert calibration_results.most_informative(found, 2)[0] == "contact"
    assert said["contact"] > 0.5 and sum(said[name] for name in WITHIN if name != "contact") < 0.2
    with pytest.raises(ValueError, match="name must be .*, but is 'horizon'"):
        calibration_results.marginal("horizon", found)


def test_numbers_are_cut_into_intervals_of_equal_prior():
    levels, prior, places = calibration_results.binned("learning_rate", design(60 + 4))
    assert len(levels) == 6 and prior == pytest.approx(1 / 6)
    assert np.ptp(np.bincount(places)) <= 2 and " … " in levels[0]


def test_progress_is_the_nearest_so_far():
    table = rows({"A6"}, set(CLAIMS) - {"B1"}, {"A6"})
    table = [replace(row, wave=wave) for wave, row in enumerate(table)] + [replace(table[0], wave=3, statistics={})]
    found = calibration_results.progress(table)
    assert list(found) == [0, 1, 2, 3] and found[0] > found[1] == found[2] == found[3]


def test_marginals_and_pairs_are_drawn_with_their_shares():
    readings = design(64)
    found = Posterior(readings, np.full(64, 1 / 64), "")
    calibration_figures.draw_marginals(found, found, names=("contact", "learning_rate", "bootstrap"))
    shown = [axes for axes in plt.gcf().axes if axes.get_visible()]
    assert [axes.get_title() for axes in shown] == [WITHIN[name].label
                                                   for name in ("contact", "learning_rate", "bootstrap")]
    bars = [patch.get_width() for patch in shown[0].patches]
    np.testing.assert_allclose(bars, 0.5)
    np.testing.assert_allclose(shown[0].lines[0].get_xdata(), 0.5)
    calibration_figures.draw_pairs(found, ["contact", "bootstrap"])
    (image,) = [axes.images[0] for axes in plt.gcf().axes if axes.images]
    assert image.get_array().sum() == pytest.approx(1)


def test_claims_together_are_drawn_and_the_excluded_are_crossed():
    rows_, both = np.full((2, 2), 20), np.array([[10, 0], [0, 5]])
    calibration_figures.draw_together(Together(("A6", "B1"), rows_, both, rows_ / 5, []))
    assert [text.get_text() for text in plt.gca().texts] == ["50", "×", "25"]


def test_what_a_missed_target_goes_together_with_least():
    table = rows({"A6"}, {"A6"}, {"A6"}, {"C2", "C3"}, {"C2", "C3"}, {"C3", "A6"})
    found = calibration_results.conflicts(table, table[-1])
    missed = {conflict.missed: conflict for conflict in found}
    assert set(missed) == {name for name, target in TARGETS.items() if target.claim not in ("C3", "A6")}
    assert missed["C2"].met.startswith("A6") and missed["C2"].both == 0
    assert missed["C2"].expected == pytest.approx(2 * 4 / 6) and missed["C2"].found.shape == (6, 2)
    shown = calibration_figures.draw_conflicts([missed["C2"]], table[-1])
    assert shown[0, 0].get_title(loc="right") == "0 meet both, by chance 1"
    assert shown[0, 0].lines[0].get_xydata() == pytest.approx(missed["C2"].found)


def test_distances_are_drawn_by_wave():
    table = [replace(row, wave=wave) for wave, row in enumerate(rows({"A6"}, CLAIMS, set()))]
    calibration_figures.draw_distances(table)
    points, steps = plt.gca().lines
    np.testing.assert_allclose(points.get_ydata(), [row.distance for row in table])
    assert steps.get_ydata()[-1] == 0


def test_predicted_figures_carry_the_numbers_of_the_thesis(cache_folder):
    table = [Row(0, i, 2, 30_000, reading) for i, reading in enumerate(design(2))]
    lives = [calibration_table.lives(row) for row in table]
    assert set(lives[0]) == {key for group in GROUPS.values() for key in group.keys}
    for draw in (calibration_figures.draw_single, calibration_figures.draw_layers, calibration_figures.draw_modalities,
                 calibration_figures.draw_networks):
        draw(lives)
    words = [text.get_text() for number in plt.get_fignums() for text in plt.figure(number).axes[0].texts]
    assert {"0.29", "0.55", "3.5 × N7", "1.5 × C", "N50", "sum", "both", "D"} <= set(words)
    assert "160 min" not in words  # these runs last ten minutes
