"""The base rate: readings drawn at random, how they are judged by values alone, and the stored table."""

import re
from dataclasses import replace

import pytest

from companion.study import base_rate
from companion.study.base_rate import DRAWN, Row, agreeing, agrees, plan, read, reading_of, row_of
from companion.thesis.measures import exact
from companion.thesis.priors import PINNED
from companion.thesis.reading import READINGS
from companion.thesis.statements import AGENTS, Bounds
from companion.thesis.verdict import Claim
from neorl.statistics import Estimate
from writing.base_rate import section

POSITIVE = Bounds(low=0.0)
CLAIM = Claim("A2", exact(1.0), {
    "own": (Estimate(1.0, -9.0, 9.0), POSITIVE, "asked"), "another": (exact(-1.0), POSITIVE, "part"),
    "of interest": (exact(-1.0), None, "shown")}, 2, "undecided")


def test_a_claim_agrees_by_the_values_that_its_rule_asks_for_whatever_their_intervals():
    assert agrees(CLAIM)
    assert not agrees(replace(CLAIM, numbers=CLAIM.numbers | {"also": (Estimate(-1.0, -9.0, 9.0), POSITIVE, "asked")}))
    assert not agrees(replace(CLAIM, numbers={"own": (Estimate(float("nan"), 0.0, 9.0), POSITIVE, "asked")}))
    assert not agrees(replace(CLAIM, outcome="not testable"))


def test_draws_are_within_the_text_and_none_is_drawn_twice():
    rows = plan()
    draws = [reading_of(*row) for row in rows if row[0] == DRAWN]
    assert len({*draws}) == len(draws) == base_rate.DRAWS and not {*draws} & {*READINGS.values()}
    assert all(reading.choices[name] == value for reading in draws for name, value in PINNED.items())
    assert all([reading_of(kind, number) == READINGS[kind] for kind, number in rows if kind != DRAWN])
    assert all(rows.count((kind, base_rate.REPLICATES - 1)) == 1 for kind in READINGS)


def test_rows_that_are_missing_are_appended(tmp_path, monkeypatch):
    computed = []

    def found(kind, number):
        computed.append((kind, number))
        return Row(kind, number, {"A2": True, "A3": False})

    monkeypatch.setattr(base_rate, "row_of", found)
    monkeypatch.setattr(base_rate, "DRAWS", 2)
    path = tmp_path / "base_rate.csv"
    base_rate.main(path)
    assert read(path) == [Row(*each, {"A2": True, "A3": False}) for each in plan()] and computed == plan()
    path.write_text("".join(path.read_text().splitlines(keepends=True)[:-2]))
    del computed[:]
    base_rate.main(path)
    assert computed == plan()[-2:] and [row[:2] for row in read(path)] == plan()


def test_counts_are_of_claims_that_every_row_has():
    rows = [Row(DRAWN, 0, {"A2": True, "A3": True, "A4": True}), Row(DRAWN, 1, {"A2": False, "A3": True}),
            Row("letter", 0, {"A2": True, "A3": False})]
    found, claims = agreeing(rows)
    assert claims == 2 and {kind: each.tolist() for kind, each in found.items()} == {
        DRAWN: [2, 1], "letter": [1], "calibrated": []}
    assert agreeing(rows, ("A3", "A4"))[0][DRAWN].tolist() == [1, 1]


def test_the_stored_table_has_every_row_and_the_same_claims_in_each():
    rows = read()
    assert sorted(row[:2] for row in rows) == sorted(plan())
    assert len({tuple(row.agrees) for row in rows}) == 1 and {*rows[0].agrees} < {*AGENTS}


@pytest.mark.parametrize("kind, number, groups", [(DRAWN, 3, ["layers", "networks"]), ("letter", 1, ["layers"])])
def test_a_row_of_the_stored_table_is_computed_again(kind, number, groups):
    stored = next(row for row in read() if row[:2] == (kind, number))
    again = row_of(kind, number, groups)
    assert again.agrees and again.agrees.items() <= stored.agrees.items()


def test_the_base_rate_s_caption_ends_in_its_finding_and_the_bars_count_the_readings_drawn():
    names = ("A2", "A3", "A6", "B2", "B6")  # the last two were not used for the fit
    numbers = {DRAWN: [0, 0, 1, 1, 1, 1, 2, 3], "letter": [1, 2], "calibrated": [4, 5]}
    rows = [Row(kind, number, {name: place < each for place, name in enumerate(names)})
            for kind, of_kind in numbers.items() for number, each in enumerate(of_kind)]
    text = section(rows)
    assert text.endswith("Of 5 claims about agents a reading drawn at random agrees with 1 [0, 3]; the reading to the "
                         "letter with 1.5, more than 75\u00a0% of those drawn, and the calibrated one with 4.5, more "
                         "than all of those drawn.")
    assert "Bars: 8 readings" in text and "repeated 2 times" in text
    assert "of the 2 others a random reading agrees with 0 on average, and the calibrated one with 1.5" in text
    heights = [float(height) for height in re.findall(r'<rect[^>]*height="([\d.]+)"', text)]
    assert [height / heights[-1] for height in heights] == [2, 4, 1, 1]
