"""The table of readings, and the conclusions drawn from it."""

import math
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
import scipy

from companion.thesis import pins
from companion.thesis.priors import WITHIN
from companion.study import calibration_table, calibration_targets, sensitivity
from companion.study.calibration_table import Row, read_table, write_table
from companion.study.calibration_targets import CLAIMS, GROUPS, TARGETS, Measure, Target
from companion.study.emulator import features, reading_at
from neorl import CALIBRATED, Condition, WaterWorld, place_cells
from companion.thesis.reading import TO_THE_LETTER, Reading
from companion.thesis.statements import STATEMENTS
from neorl.experiments.result import Result


def result_of(*rates, runs=4, steps=150_000, n_creeps=8):
    """A `Result` in which every run earns these rates in turn, each over an equal stretch."""
    world = WaterWorld(n_creeps=n_creeps)
    bins = np.repeat(np.array(rates) * 0.2, steps // 10 // len(rates))
    rewards = np.tile(bins.astype(np.float32), (runs, 1))
    return Result(Condition(place_cells([3]), world, steps, runs), rewards, np.zeros((*rewards.shape, 2), np.int16))


def test_a_distance_is_zero_inside_and_counted_in_scale_and_error_outside():
    target = Target("A7", "ratio", len, 2.0, 5.0, 0.3, "3.5", "so")
    assert target.holds(2.0) and target.holds(5.0) and not target.holds(1.99)
    assert target.distance(3.5) == target.distance(2.0) == 0
    assert target.distance(1.7) == pytest.approx(1) and target.distance(5.6) == pytest.approx(2)
    assert target.distance(1.0, error=0.4) == pytest.approx(2)
    np.testing.assert_allclose(target.distance(np.array([1.7, 4.0, 5.3])), [1, 0, 1])
    assert replace(target, high=math.inf).distance(1e9) == 0


def test_targets_are_of_known_claims_and_each_belongs_to_one_group():
    assert set(CLAIMS) <= set(STATEMENTS)
    assert sorted(name for group in GROUPS.values() for name in group.targets) == sorted(TARGETS)
    assert all(target.low < target.high and target.scale > 0 and target.reason for target in TARGETS.values())


def test_what_the_layers_earn_is_measured():
    results = {("layer", 3): result_of(0.0, 0.0), ("layer", 7): result_of(0.1, 0.1), ("layer", 23): result_of(0.0, 0.2),
               "layers": result_of(0.05, 0.35)}
    found = {name: each.value for name, each in calibration_targets.measure("layers", results).items()}
    assert found == pytest.approx({"A7 ratio": 3.5, "A7 pace": -0.05, "A6 surplus": 0.05, "A6 pace": 0.0}, abs=1e-4)


def test_agents_that_have_not_learned_are_in_no_order_and_their_ratio_is_no_success():
    poor = {("layer", n): result_of(0.001) for n in (3, 7, 23)} | {"layers": result_of(0.0035)}
    assert calibration_targets.measure("layers", poor)["A7 ratio"].value == pytest.approx(0.0035 / 0.03, abs=1e-3)
    found = calibration_targets.measure("networks", {("network", name): result_of(0.0) for name in "ABCD"})
    assert [name for name, each in found.items() if TARGETS[name].holds(each.value)] == ["C1 weak"]


def test_levels_and_minutes_of_the_modalities_are_measured():
    world = {"steps": 600_000, "n_creeps": 3}
    slow = result_of(*[0.05] * 9, 0.15, *[0.29] * 2, **world)
    quick = result_of(0.3, *[0.55] * 11, **world)
    results = {("place", "all"): slow, ("objects", "all"): result_of(0.29, **world), "both": quick}
    found = {name: each.value for group in ("places", "objects", "both")
             for name, each in calibration_targets.measure(group, results).items()}
    assert found["B3 place"] == pytest.approx(0.25, abs=0.05) and found["B3 both"] == pytest.approx(0.55, abs=1e-4)
    assert 160 < found["B4 place"] <= 175 and 15 < found["B4 both"] < 25
    flat = results | {("place", "all"): result_of(0.05, **world)}
    assert calibration_targets.measure("places", flat)["B4 place"].value == 0


def test_the_error_is_that_of_the_mean_over_runs():
    result = result_of(0.2, steps=600_000)
    rates = np.array([0.1, 0.2, 0.25, 0.45])
    varied = replace(result, rewards=(result.rewards / 0.2 * rates[:, None]).astype(np.float32))
    results = {("place", "all"): varied, ("objects", "all"): varied, "both": varied}
    found = calibration_targets.measure("both", results) | calibration_targets.measure("objects", results)
    assert found["B3 both"].value == pytest.approx(0.25, rel=1e-4)
    assert found["B3 both"].error == pytest.approx(rates.std(ddof=1) / 2, rel=1e-3)
    assert found["B1 level"] == pytest.approx((1, 0), abs=1e-4)  # runs with the same seed are paired
    with pytest.raises(ValueError, match="runs must be an integer of at least 2, but is 1"):
        calibration_targets.measure("both", {
            key: replace(each, condition=replace(each.condition, runs=1), rewards=each.rewards[:1])
            for key, each in results.items()})


def test_a_claim_holds_if_all_its_targets_do():
    statistics = {"A6 surplus": Measure(0.1, 0), "A6 pace": Measure(-0.1, 0), "A7 ratio": Measure(3.5, 0)}
    row = Row(0, 0, 2, 3_000, Reading(), statistics)
    assert row.tested == {"A6"} and not row.agreeing
    row = replace(row, statistics=statistics | {"A6 pace": Measure(0.02, 0)})
    assert row.agreeing == {"A6"} and row.distance == 0 and replace(row, statistics={}).distance == math.inf


def readings(number):
    """Readings spread through the priors: a list."""
    return [reading_at(shares) for shares in scipy.stats.qmc.Sobol(len(WITHIN), rng=0).random(number)]


def test_readings_keep_to_the_text_and_span_the_priors():
    found = readings(64)
    for name, choice in WITHIN.items():
        places = [choice.place(reading.choices[name]) for reading in found]
        assert min(places) < 0.1 and max(places) > 0.9
    assert found[0] == TO_THE_LETTER.varied(**{name: found[0].choices[name] for name in WITHIN})
    seen = features(found)
    assert seen.min() >= 0 and seen.max() <= 1 and np.ptp(seen, axis=0).min() > 0


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
            for i, (reading, holding) in enumerate(zip(readings(points), claims))]


def test_a_table_reads_back_exactly(tmp_path):
    table = rows(*[{"A6", "B1"}] * 20)
    table[3] = replace(table[3], wave=2, statistics={name: table[3].statistics[name]
                                                     for name in GROUPS["layers"].targets})
    table[4] = replace(table[4], statistics=table[4].statistics | {"C4": Measure(1.2345e-05, 0.1)})
    write_table(table, tmp_path / "table.csv")
    assert read_table(tmp_path / "table.csv") == table
    assert table[3].groups == ("layers",) and not table[3].complete
    assert table[4].groups == tuple(GROUPS) and table[4].complete


def test_a_row_runs_again_as_it_was(cache_folder):
    made = [Row(0, 5 + i, 2, 1_500, reading) for i, reading in enumerate(readings(2))]
    table = calibration_table.run(made, "networks")
    table[0] = calibration_table.run(table[:1], "layers")[0]
    assert table[0].groups == ("layers", "networks")
    table[1] = replace(table[1], statistics=table[1].statistics | {"C3": Measure(9.0, 0.0)})
    again = calibration_table.run([replace(row, statistics={}) for row in table], "networks")
    assert [old.statistics.items() >= new.statistics.items() for old, new in zip(table, again)] == [True, False]


def test_the_table_of_this_package_has_the_default_as_its_best_reading_and_runs_again_as_it_was(cache_folder):
    table = read_table()
    best = calibration_table.best(table)
    assert best.reading == Reading() and best.reading.learning == CALIBRATED
    assert len(table) >= 1_000 and sum(row.complete for row in table) >= 70
    assert not any(pins.broken(row.reading) for row in table)
    drawn = [row for row in table if "layers" in row.groups and row.runs == 2][::1_500]
    again = calibration_table.run([replace(row, statistics={}) for row in drawn], "layers")
    assert all(old.statistics.items() >= new.statistics.items() for old, new in zip(drawn, again, strict=True))
    assert sensitivity.literal(table) and any(map(any, sensitivity.flips(table).values()))


def test_the_best_is_a_confirmed_row_and_a_reading_counts_as_it_was_confirmed():
    lucky, honest = rows(CLAIMS, {"A6"})
    assert calibration_table.best([lucky, honest]) == lucky
    confirmed = replace(lucky, seed=9, runs=20, statistics=statistics({"A7"}))
    assert calibration_table.best([lucky, honest, confirmed]) == confirmed
    assert calibration_table.leading([honest, lucky]) == [lucky, honest]
    assert calibration_table.nearest([lucky, confirmed, honest]) == sorted([confirmed, honest],
                                                                           key=lambda row: row.distance)


def test_confirmations_of_a_reading_are_pooled_and_the_best_is_one_confirmed_most_often():
    found, once = rows(set(CLAIMS), set(CLAIMS))
    first, second = (replace(found, seed=seed, runs=20, statistics={name: Measure(value, error) for name in TARGETS})
                     for seed, value, error in ((8, 1.0, 0.3), (9, 2.0, 0.4)))
    pooled, left = sorted(calibration_table.nearest([found, first, once, second]), key=lambda row: -row.runs)
    assert pooled == replace(second, runs=40, statistics={name: Measure(1.5, 0.25) for name in TARGETS})
    once = replace(once, runs=20)
    assert left.reading == once.reading and calibration_table.best([first, once]) == once
    assert calibration_table.best([first, second, once]) == pooled


def test_among_equals_the_book_keeps_its_reading_or_else_the_nearest_is_best():
    near, far, other = (replace(row, runs=20) for row in rows({"A6", "A7"}, {"B3", "B4"}, {"A6"}))
    near, far = sorted([near, far], key=lambda row: row.distance)
    assert near.distance < far.distance and calibration_table.equals([far, other, near]) == [near, far]
    assert calibration_table.best([far, other, near]) == near
    kept = replace(far, reading=Reading())
    assert calibration_table.best([kept, other, near]) == kept
    assert calibration_table.best([replace(other, reading=Reading()), near]) == near


def test_shares_at_the_papers_lengths_are_of_readings_that_nothing_has_chosen():
    table = rows(*[{"A6"}] * 8, *[set()] * 8)
    table += [replace(row, wave=1) for row in rows(*[{"A6"}] * 4)]
    found = sensitivity.evenly(table)
    assert found["A6"] == {"agrees": 8, "measured": 16} and found["C4"] == {"agrees": 0, "measured": 16}


def test_claims_that_exclude_each_other_are_found():
    table = rows(*[{"A6", "A7"}] * 12, *[{"B1", "A7"}] * 12, *[{"B3"}] * 2, *[set()] * 6)
    table += [replace(row, statistics=statistics({"C4"}, GROUPS["networks"].targets)) for row in table]  # not complete
    found = calibration_table.claims_together(table)
    at = CLAIMS.index
    assert found.both[at("A6"), at("A7")] == 12 and found.rows[at("A6"), at("A7")] == 32
    assert found.both[at("A6"), at("B1")] == 0 and found.expected[at("A6"), at("B1")] == pytest.approx(4.5)
    assert found.apart == []
    (pair,) = calibration_table.claims_together(table * 2).apart  # B3 holds too rarely to count
    assert pair == ("A6", "B1", 0, pytest.approx(9))
    assert found.pairs[0] == ("A6", "B1", 0, pytest.approx(4.5)) and ("A6", "B3") in [each[:2] for each in found.pairs]
    assert found.both[at("C4"), at("C4")] == 32 and found.rows[at("C4"), at("C4")] == 64


def test_a_number_with_a_wide_error_decides_nothing():
    target = TARGETS["B4 both"]
    found = [target.mark(value, error) for value, error in ((5.0, 1.0), (5.0, 97.5), (90.0, 2.0), (31.0, 5.0))]
    assert found == ["✓", "?", "✗", "?"]


def set_back(*, clearly):
    """The book's reading in 200 runs, and it without memory and with other ways of absence, ten runs each."""
    best = Row(9, 0, 200, 3_000, Reading(), statistics({"A6", "B1"}))
    lost = statistics({"A7", "B1"})
    if not clearly:
        lost = {name: Measure(found.value, 10 * TARGETS[name].scale) for name, found in lost.items()}
    return [best, Row(10, 1, 10, 3_000, Reading().varied(memory=0.0), lost),
            Row(10, 1, 10, 3_000, Reading().varied(absent_form="away"), best.statistics),
            Row(10, 1, 10, 3_000, Reading().varied(memory=7.0), lost), Row(10, 1, 10, 3_000, TO_THE_LETTER, lost)]


@pytest.mark.parametrize("clearly", [True, False])
def test_a_choice_decides_the_claims_that_flip_clearly_when_it_is_set_back(clearly):
    table = set_back(clearly=clearly)
    flips = sensitivity.flips(table)
    assert flips == {"memory": (("A6",), ("A7",)) if clearly else ((), ()), "absent_form": ((), ())}
    assert next(iter(flips)) == "memory" or not clearly
    assert sensitivity.literal(table) is table[-1] and sensitivity.literal(table[:-1]) is None


def test_the_default_is_set_back_choice_by_choice_and_not_twice(monkeypatch):
    monkeypatch.setattr(calibration_table, "run", lambda rows, group: [
        replace(row, statistics=row.statistics | statistics(CLAIMS, GROUPS[group].targets)) for row in rows])
    before = [Row(4, 0, 2, 3_000, Reading())]
    table = sensitivity.set_back(before, 2)[1:]
    departing = [name for name in WITHIN if Reading().choices[name] != TO_THE_LETTER.choices[name]]
    assert list(sensitivity.setbacks(table)) == departing and sensitivity.literal(table) is table[0]
    assert {(row.wave, row.seed, row.runs, row.steps) for row in table} == {(5, 1, 2, 600_000)}
    assert len(sensitivity.set_back(table[:3], 2)) == len(table)


def test_a_row_is_run_again_from_the_command_line(cache_folder, tmp_path):
    (row,) = calibration_table.run([Row(0, 5, 2, 1_500, Reading())], "places")
    write_table([row], tmp_path / "table.csv")
    command = [sys.executable, "notebooks/calibrate.py", "0", "--table", tmp_path / "table.csv"]
    shown = subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()
    assert [line.split(",")[0] for line in shown] == ["equal: B3 place", "equal: B4 place"]
    write_table([replace(row, seed=6)], tmp_path / "table.csv")
    assert "differs: B3 place" in subprocess.run(command, capture_output=True, text=True, check=True).stdout


def test_the_choice_that_matters_has_all_the_effect():
    table = [replace(row, statistics=statistics(CLAIMS if row.reading.world.contact == "rounded" else ()))
             for row in rows(*[()] * 128, points=128)]
    effects = sensitivity.total_effects(table, points=16)
    assert set(effects) == set(CLAIMS) and set(sensitivity.matters(effects, "contact")) == set(CLAIMS)
    assert all(sensitivity.matters(effects, name) == [] for name in WITHIN if name != "contact")
    noise = [replace(row, statistics=statistics(CLAIMS if i % 2 else ())) for i, row in enumerate(table)]
    assert sensitivity.matters(sensitivity.total_effects(noise, points=4), "memory") == []
