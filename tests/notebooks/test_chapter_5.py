"""The page of chapter 5: its experiment, and the verdicts on the claims behind each conclusion."""

import re
from dataclasses import replace

import pytest
from matplotlib import pyplot as plt
from page_cells import planned

from companion import chapter_5
from companion.shared.report import CALIBRATED, LETTER
from companion.thesis.reading import PRIMES, Reading, conditions
from companion.thesis.statements import AGENTS, CLAIMS, STATEMENTS
from companion.thesis.verdict import VERDICTS


def experiment(**given):
    """What the page's cells define down to its experiment, with conditions in place of results: {name: value}."""
    return planned("chapter_5", "experiment", "ran", runs=3, steps=900, seed=2, **given)


def test_agents_have_the_coarsest_maps_of_paper_b_up_to_all():
    results = experiment()["results"]
    paper_b = conditions(Reading(), 900, 3, 2, ["modal"])
    for name, key in (("place cells", ("place", "all")), ("object-vector cells", ("objects", "all")), ("both", "both")):
        assert results[name, 6] == paper_b[key]
        for n in (1, 2, 4):
            assert {node.resolutions for node in results[name, n].agent.nodes} == {PRIMES[:n]}
            assert replace(results[name, n], agent=paper_b[key].agent) == paper_b[key]


@pytest.mark.parametrize("begin, step", [(0.5, 450), (0.25, 225)])
def test_indifferent_agents_have_the_same_desires_but_no_valence_until_these_begin(begin, step):
    page = experiment(begin=begin, counts=[2])
    results, throughout, later = (page[name] for name in ("results", "throughout", "later"))
    assert (page["numbers"], page["begun"], results["later"]) == ([2], begin, later)
    assert throughout == conditions(Reading(), 900, 3, 2, ["modal"])["both"]
    assert later.changes == ((step, throughout.agent),)
    assert [desire.source for desire in later.agent.desires] == [desire.source for desire in throughout.agent.desires]
    assert not any(desire.valence for desire in later.agent.desires) and later.agent.nodes == throughout.agent.nodes


def test_every_claim_belongs_to_one_group():
    assert sorted(name for names in chapter_5.GROUPS.values() for name in names) == sorted(CLAIMS)
    assert chapter_5.GROUPS["Counted apart"] == tuple(name for name in CLAIMS if name not in AGENTS)


def test_each_reading_has_its_verdicts_on_each_conclusion():
    found = {part: {name: {"verdict": verdict} for name, verdict in verdicts.items()}
             for part, verdicts in (("claims", {"C1": "partly", "T1": "reproduced", "C3": "undecided"}),
                                    ("letter", {"C1": "not testable", "A2": "no verdict"}))}
    head, _, *rows = chapter_5.verdicts(found).splitlines()
    cells = {tuple(cell.strip() for cell in row.split("|")[1:3]): [cell.strip() for cell in row.split("|")[3:-1]]
             for row in rows}
    columns = [re.sub("<.*?>|\u00a0", "", cell).strip(" ●◐○◇?∎∃") for cell in head.split("|")[3:-1]]
    assert columns == [each for each in (*VERDICTS, "not judged") if each not in (VERDICTS[2], *VERDICTS[5:7])]
    assert cells["Learning apart from behaviour", CALIBRATED] == ["T1", "C1", "C3", "", "", "T7 C2 C4"]
    assert cells["Learning apart from behaviour", LETTER] == ["", "", "", "C1", "", "T1 T7 C2 C3 C4"]
    assert cells["Superposition", LETTER][4] == "A2" and len(rows) == 8


def test_what_no_page_has_judged_is_said_in_one_sentence():
    nothing = {"claims": {}, "letter": {}, "shares": {}}
    assert chapter_5.remedy(nothing).startswith("**No claim has been judged yet: `make book` computes")
    assert chapter_5.verdicts(nothing) == chapter_5.extract(nothing, CLAIMS) == ""
    claim = {"here": [2.0, 1.0, 3.0], "runs": 10, "verdict": "partly", "numbers": {}}
    some = nothing | {"claims": {name: claim for name in STATEMENTS if name not in ("A2", "T6")}}
    assert "A2, T6 have not been judged yet" in chapter_5.remedy(some)
    assert "not computed" not in chapter_5.extract(some, CLAIMS)
    assert chapter_5.remedy(some | {"claims": dict.fromkeys(STATEMENTS, claim)}) == ""
    for record, rows in ((some, ["A3  partly"]), (nothing, [])):
        chapter_5.draw_standing(record, ["A2", "A3"])
        assert [label.get_text() for label in plt.gca().get_yticklabels() if plt.gca().axison] == rows
    plt.close("all")
