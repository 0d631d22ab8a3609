"""The README: its claims are those of the record, and its examples print what it says."""

import re
from pathlib import Path

import matplotlib.pyplot as plt
import pytest
import readme

from neorl import Agent, Desire, Node, Policy
from neorl.core import modality
from companion.thesis.statements import STATEMENTS
from record import RECORD, of_book

README = (Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8")
EXAMPLES = re.findall(r"```python\n(.*?)```", README, re.DOTALL)


@pytest.mark.skipif(not RECORD.exists(), reason="nothing is recorded")
def test_claims_are_as_recorded():
    (written,) = readme.BETWEEN.findall(README)
    assert written == readme.by_verdict(of_book(None)), "the README must show the record: make readme"


def test_claims_are_written_between_the_marks_and_nothing_else_is_touched():
    text = "before\n<!-- claims: make readme -->\nold\n<!-- end of claims -->\nafter | \\1\n"
    found = {"here": [0.49, 0.48, 0.51], "runs": 20, "verdict": "reproduced", "numbers": {}}
    new = readme.by_verdict({"claims": {"B3": found, "B5": found | {"verdict": "refuted by proof"}}, "letter": {}})
    assert new.startswith("With every gap of the text filled") and "(20 runs of each condition)" in new
    assert all(new.count(f"**{name}** {each.text}") == 1 for name, each in STATEMENTS.items())
    assert re.search(r"^\| ●\u00a0reproduced \| \*\*B3\*\* .*; here 0.49 \[0.48, 0.51\]\) \|$", new, re.MULTILINE)
    assert re.search(r"Counted apart:\n\n(.*\n){2}\| ∎\u00a0refuted by proof \| \*\*B5\*\* ", new)
    assert readme.BETWEEN.sub(lambda _: new, text) == (
        f"before\n<!-- claims: make readme -->\n{new}<!-- end of claims -->\nafter | \\1\n")


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
    names = {"Agent": lambda *parts: Agent(*parts, policy=Policy(0.0, "no-op")), "Desire": Desire,
             "Node": Node, "modality": modality}
    exec(loop.replace("5_000", "3"), names)
    assert (names["x"], names["y"]) == (0.5, 0.5)
