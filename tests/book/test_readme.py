"""The README: it shows the record, and its examples, as those of the package's first page, print what they say."""

import dataclasses
import doctest
import importlib
import json
import re
from pathlib import Path

import matplotlib.pyplot as plt
import pytest
from writing import readme

import neorl
from companion.page import report

ROOT = Path(__file__).parents[2]
README, PACKAGE = ((ROOT / name).read_text(encoding="utf-8") for name in ("README.md", "book/api.md"))
EXAMPLES = re.findall(r"```python\n(.*?)```", README + PACKAGE, re.DOTALL)


def test_claims_are_as_recorded():
    (written,) = readme.BETWEEN.findall(README)
    assert written == readme.found(report.record()), "the README must show the record: make readme"


def test_the_verdicts_of_both_readings_are_written_between_the_marks_and_nothing_else_is_touched():
    text = "before\n<!-- claims: make readme -->\nold\n<!-- end of claims -->\nafter | \\1\n"
    found = {"here": [0.49, 0.48, 0.51], "runs": 20, "verdict": "reproduced", "numbers": {}}
    new = readme.found({"claims": {"B3": found, "B5": found | {"verdict": "refuted by proof"}},
                        "letter": {"B3": found | {"verdict": "partly"}}})
    assert new.startswith("The thesis makes") and new.partition("\n")[0].endswith(" B3 and B5 on 20.")
    assert "| Claims about agents, by which the calibrated reading was chosen | 0 of 1 | 1 of 1 |\n" in new
    assert readme.BETWEEN.sub(lambda _: new, text) == (
        f"before\n<!-- claims: make readme -->\n{new}<!-- end of claims -->\nafter | \\1\n")


def test_the_package_says_what_it_is_for_with_an_example_that_runs():
    (example,) = doctest.DocTestFinder(exclude_empty=True, recurse=False).find(
        neorl, extraglobs={"neorl": neorl, "dataclasses": dataclasses})
    assert len(example.examples) == 7 and doctest.DocTestRunner().run(example).failed == 0


def test_names_come_from_where_the_package_s_first_page_says():
    rows = re.findall(r"^\|.*\| (.*) \| `(neorl[\w.]*)` \|$", PACKAGE, re.MULTILINE)
    assert {"neorl", "neorl.custom", "neorl.worlds"} < {place for _, place in rows}
    for names, place in rows:
        for target in re.findall(r"`~([\w.]+)`", names):
            module, _, name = target.rpartition(".")
            there = importlib.import_module(target) if name in ("modality", "walls") else getattr(
                importlib.import_module(module), name)
            assert getattr(importlib.import_module(place), name) is there, target


def test_names_that_have_moved_are_where_the_change_log_says():
    moved = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8").partition("### Names that have moved")[2]
    rows = re.findall(r"^\| (`.*`) \| `(neorl\.[\w.]*)` \|$", moved, re.MULTILINE)
    assert len(rows) == 10
    for names, place in rows:
        there = importlib.import_module(place)
        for name in re.findall(r"`([\w.]+)`", names):
            if name.startswith("neorl."):
                with pytest.raises(ImportError):
                    importlib.import_module(name)
            else:
                assert hasattr(there, name) and name not in dir(neorl), name


def test_the_commands_stand_right_below_the_picture():
    lines = README.splitlines()
    assert [line for line in lines if line.startswith("## ")][0] == "## Two commands"
    assert max(lines.index(line) for line in lines if re.match("make (book|test) ", line)) < 20


def test_readers_are_sent_to_pages_by_the_titles_that_these_have():
    titles = [json.loads(path.read_text(encoding="utf-8"))["cells"][0]["source"][0].removeprefix("# ").strip()
              for path in (ROOT / "notebooks").glob("*.ipynb")]
    titles += [path.read_text(encoding="utf-8").partition("\n")[0].removeprefix("# ") for path in
               (ROOT / "book").glob("*.md")]
    named = re.findall(r"\*([A-Z][^*\n]+)\*(?!\*)", README.partition("## Where next")[2].partition("## Examples")[0])
    assert len(named) > 4 and not set(named) - set(titles)


@pytest.mark.filterwarnings("ignore::DeprecationWarning:distributed", "ignore::ResourceWarning")
def test_every_example_prints_what_stands_behind_its_arrow(tmp_path, monkeypatch, capsys):
    names = {}
    monkeypatch.chdir(tmp_path)
    for example in EXAMPLES:
        exec(example, names)
    plt.close("all")
    promised = re.findall(r"print\(.*# → (.*)", "\n".join(EXAMPLES))
    assert capsys.readouterr().out.splitlines() == promised
    assert len(promised) == "\n".join(EXAMPLES).count("print(")


def test_the_loop_of_a_learner_takes_an_agent_that_is_idle_while_it_knows_nothing(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (loop,) = [each for each in EXAMPLES if ".act()" in each]
    names, idle = {"neorl": neorl}, 'valence=1.0)], policy=neorl.Policy(0.0, "no-op"))'
    exec(loop.replace("5_000", "3").replace("valence=1.0)])", idle), names)
    assert (names["x"], names["y"]) == (0.5, 0.5)
