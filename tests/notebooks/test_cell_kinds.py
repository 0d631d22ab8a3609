"""The kinds of cells among the book's modalities, compared with the thesis's table 2.1."""

from lib.chapter_2.cell_kinds import THESIS, as_in_thesis, kinds, kinds_table


def test_kinds_are_those_of_the_thesis_and_the_speed_cell():
    found = kinds()
    assert {kind: found[kind] for kind in THESIS} == THESIS
    assert set(found) - set(THESIS) == {"speed cell"} and found["speed cell"] == ("–", "–", "agent speed")


def test_a_kind_that_is_missing_or_differs_is_not_as_in_the_thesis():
    assert as_in_thesis(THESIS) == 6
    assert as_in_thesis({"place cell": THESIS["place cell"], "border cell": ("–", "–", "location of borders"),
                         "speed cell": ("–", "–", "agent speed")}) == 1


def test_the_table_has_a_row_for_each_kind():
    assert kinds_table({"place cell": THESIS["place cell"]}).splitlines() == [
        "| Cell | Locality | Direction | Concern |", "|---|---|---|---|",
        "| place cell | allocentric | – | agent position |"]
