"""Reports of the results: tables, records on disk, and entries that are missing."""

import json
from dataclasses import replace

import pytest
from test_claims import alone, brownian, paper_a, paper_c

from companion.page import report
from companion.thesis import claims
from companion.thesis.statements import Bounds
from neorl.statistics import Estimate
from companion.thesis.verdict import Claim

pytestmark = pytest.mark.usefixtures("cache_folder")


def networks(results=None):
    return claims.judge_networks(results or paper_c(), alone(), brownian())


def layers(runs=20):
    _, control, *rest = paper_a(runs)
    return claims.judge_multiple_layers(*rest, control)


def test_claims_are_kept_as_data_and_a_bound_that_does_not_exist_as_null(record, cache_folder):
    kept = json.loads((cache_folder / "claims" / "paper_c.json").read_text())
    assert list(kept["claims"]) == ["C1", "C2", "C3", "C4", "C6"] and "letter" not in kept
    assert kept["claims"]["C4"]["here"] == list(networks()[3].here) and kept["claims"]["C4"]["runs"] == 20
    text = (cache_folder / "claims" / "alternatives.json").read_text()
    assert "NaN" not in text and json.loads(text)["claims"]["C5"]["here"][1:] == [None, None]


def test_a_record_has_all_claims_of_its_page_or_stays_as_it_was(record, cache_folder):
    report.save("paper_c", networks()[:3])
    report.save("paper_c")
    assert report.load((cache_folder / "claims").iterdir()) == record


def test_claims_to_the_letter_are_kept_apart(cache_folder):
    report.save("paper_c", networks(), reading="letter")
    found = report.load((cache_folder / "claims").iterdir())
    assert not found["claims"] and list(found["letter"]) == ["C1", "C2", "C3", "C4", "C6"]


def test_a_claim_that_several_pages_have_judged_is_that_of_most_runs(tmp_path):
    paths = [tmp_path / f"{runs}.json" for runs in (5, 20, 10)]
    for path in paths:
        path.write_text(json.dumps({"claims": {"A1": {"runs": int(path.stem)}}}))
    assert report.load(paths)["claims"] == {"A1": {"runs": 20}}


def test_what_a_verdict_rests_on_is_the_numbers_of_both_readings():
    backwards = dict(zip("ABCD", [*paper_c().values()][::-1]))
    kept = {"claims": report.kept(networks()), "letter": report.kept(networks(backwards))}
    header, _, rise, weak, lead, *_, note = report.numbers(kept, "C1").splitlines()
    assert header == "| Number | Rule | Here, 20 runs or more | To the letter, 20 runs or more |"
    assert rise == ("| Final reward per second of A, less its early one | 0.01 or more (what a figure shows) | "
                    "✓\u00a00.05 [0.05, 0.05] | ✓\u00a00.40 [0.40, 0.40] |")
    assert weak.startswith("| half of C, less A | more than 0 (weak: less than half of what C earns) | ✓\u00a00.10 [")
    assert lead.startswith("| lead over Brownian motion | 0.01 or more (proficiency: more than by chance")
    assert note == ("The verdict rests on 3 intervals, so that each is one of 98.33\u00a0%: all hold together with "
                    "95\u00a0%.")


def test_a_number_has_a_mark_if_it_decides_and_a_part_says_what_it_makes_of_the_claim():
    numbers = {"D / C": (Estimate(1.6, 1.3, 1.9), Bounds(low=1.5), "asked"),
               "D": (Estimate(1, 0.9, 1.1), Bounds(high=0.5, why="half"), "asked"),
               "C": (Estimate(1, 0.9, 1.1), Bounds(high=2.0), "part"), "B": (Estimate(1, 0.9, 1.1), None, "shown")}
    kept = {"claims": report.kept([Claim("C4", numbers["D"][0], numbers, 10, "partly")]), "letter": {}}
    assert [line.split(" | ")[1:] for line in report.numbers(kept, "C4").splitlines()[2:]] == [
        ["1.5 or more", "?\u00a01.60 [1.30, 1.90] |"], ["0.5 or less (half)", "✗\u00a01.00 [0.90, 1.10] |"],
        ["partly if 2 or less", "✓\u00a01.00 [0.90, 1.10] |"], ["", "1.00 [0.90, 1.10] |"]]


@pytest.fixture
def record(cache_folder):
    report.save("paper_c", networks())
    report.save("alternatives", [replace(layers(runs=1)[0], name=name) for name in ("A10", "C5")])
    report.save("calibration", shares={"C2": {"agrees": 2, "measured": 40}})
    return report.load((cache_folder / "claims").iterdir())


def row(table, name):
    (found,) = [line for line in table.splitlines() if f">{name}</a>" in line and line[0] == "|"]
    return found


def test_verdicts_of_few_runs_are_the_record_s_alone():
    few = [replace(each, runs=4) for each in networks()]
    said = report.verdicts(few, "letter")
    assert "This page has 4 runs of each condition; verdicts need 10 of full length, so these are the record’s." in said
    assert "| Claim | Recorded |" in said and str(few[0].here) not in row(said, "C1")
    assert f"{report.number(report.record()['letter']['C2'])}, " in row(said, "C2")
    assert "| Claim | This page | Recorded |" in report.verdicts(networks())
    assert report.verdicts([]) == "" and "verdicts need" not in report.verdicts(networks())
