"""The box that opens a page shows verdicts with symbols and links, or says that there are none."""

from lib.shared import marks, opening
from neorl.evidence.statistics import Estimate
from neorl.evidence.verdict import judged


def test_a_box_has_verdicts_by_reading_with_symbols_names_and_links():
    text = opening.what_was_found("It earns 0.30.", 10, {"calibrated": {"A2": "reproduced", "A3": "partly",
                                                                       "A4": "reproduced"}, "": {"A1": "no verdict"}})
    begin, title, calibrated, nameless, sentences, end = text.split("\n\n")
    assert (begin, title, sentences, end) == ('<div class="found">', "**What was found**", "It earns 0.30.", "</div>")
    link = '<a href="../book/claims.md#claim-{}" title="'
    assert calibrated.startswith(f"Calibrated: {marks.html('reproduced')}\u00a0{link.format('a2')}Every single")
    assert f", {link.format('a4')}" in calibrated and calibrated.endswith(" partly")
    assert calibrated.index("A4</a>") < calibrated.index("; ") < calibrated.index("◐")
    assert nameless.startswith(marks.html("no verdict"))
    untested = opening.what_was_found("", 10, {"": {"C1": "not testable"}})
    assert "C1</a> not testable, because the agents learned too little" in untested


def test_with_few_runs_a_box_says_that_there_are_no_verdicts():
    text = opening.what_was_found("It earns 0.30.", 9, {"calibrated": {"A2": "reproduced"}})
    assert "**Quick look: no verdicts.**" in text and "computed with 9" in text and "A2" not in text
    assert "**Quick look.**" in opening.what_was_found("Fast.", 9)


def test_a_box_can_consist_of_verdicts_alone():
    claims = [judged("A2", Estimate(0.1, 0.05, 0.2), "", 10, reproduced=True, partly=False, possible=True)]
    assert opening.found({"calibrated": claims}, 10) == opening.what_was_found("", 10, {
        "calibrated": {"A2": "reproduced"}})
