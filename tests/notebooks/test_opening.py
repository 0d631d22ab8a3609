"""The box of a page shows verdicts with symbols and links, or says that there are none."""

from lib.shared import marks, opening
from neorl.evidence.statistics import Estimate
from neorl.evidence.verdict import Claim


def claims(**verdicts):
    return [Claim(name, Estimate(0.1, 0.05, 0.2), "", 10, verdict, False) for name, verdict in verdicts.items()]


def test_a_box_has_verdicts_by_reading_with_symbols_names_and_links():
    text = opening.found({"calibrated": claims(A2="reproduced", A3="partly", A4="reproduced"),
                          "": claims(C1="not testable")}, 10)
    begin, title, calibrated, nameless, end = text.split("\n\n")
    assert (begin, title, end) == ('<div class="found">', "**What was found**", "</div>")
    link = '<a href="../book/claims.md#claim-{}" title="'
    assert calibrated.startswith(f"Calibrated: {marks.html('reproduced')}\u00a0{link.format('a2')}Every single")
    assert f", {link.format('a4')}" in calibrated and calibrated.endswith(" partly")
    assert calibrated.index("A4</a>") < calibrated.index("; ") < calibrated.index("◐")
    assert "C1</a> not testable, because the agents learned too little" in nameless


def test_with_few_runs_a_box_says_that_there_are_no_verdicts():
    text = opening.found({"calibrated": claims(A2="reproduced")}, 9)
    assert "**Quick look: no verdicts.**" in text and "computed with 9" in text and "A2" not in text
