"""The page of chapter 5: its experiment, and the verdicts on the claims behind each conclusion."""

import re
from dataclasses import replace

import pytest
from page_cells import planned

from lib import chapter_5
from lib.shared.report import CALIBRATED, LETTER
from neorl.evidence.reading import PRIMES, Reading, conditions
from neorl.evidence.statements import CLAIMS
from neorl.evidence.verdict import VERDICTS


def experiment(**given):
    """What the page's cells define down to its experiment, with conditions in place of results: {name: value}."""
    return planned("chapter_5", "lists", "experiment", runs=3, steps=900, seed=2, **given)


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
    results = experiment(begin=begin, counts="[2]")["results"]
    throughout, later = results["throughout"], results["later"]
    assert throughout == conditions(Reading(), 900, 3, 2, ["modal"])["both"]
    assert later.changes == ((step, throughout.agent),)
    assert [desire.source for desire in later.agent.desires] == [desire.source for desire in throughout.agent.desires]
    assert not any(desire.valence for desire in later.agent.desires) and later.agent.nodes == throughout.agent.nodes


def test_every_claim_belongs_to_one_group():
    assert sorted(name for names in chapter_5.GROUPS.values() for name in names) == sorted(CLAIMS)


def test_each_reading_has_its_verdicts_on_each_conclusion():
    found = {part: {name: {"verdict": verdict} for name, verdict in verdicts.items()}
             for part, verdicts in (("claims", {"C1": "partly", "T1": "reproduced", "C3": "reproduced"}),
                                    ("letter", {"C1": "not testable", "A2": "no verdict"}))}
    head, _, *rows = chapter_5.verdicts(found).splitlines()
    cells = {tuple(cell.strip() for cell in row.split("|")[1:3]): [cell.strip() for cell in row.split("|")[3:-1]]
             for row in rows}
    columns = [re.sub("<.*?>|\u00a0", "", cell).strip(" ●◐○◇") for cell in head.split("|")[3:-1]]
    assert columns == [each for each in (*VERDICTS, "not judged") if each != "not reproduced"]  # that none has
    assert cells["Learning apart from behaviour", CALIBRATED] == ["T1 C3", "C1", "", "", "T7 C2 C4"]
    assert cells["Learning apart from behaviour", LETTER] == ["", "", "C1", "", "T1 T7 C2 C3 C4"]
    assert cells["Superposition", LETTER][3] == "A2" and len(rows) == 8
