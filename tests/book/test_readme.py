"""The README: a build wrote its table of claims, and its examples print what it says."""

import re
from pathlib import Path

import matplotlib.pyplot as plt
import pytest
import readme

from neorl import Agent, Desire, Node, Policy
from neorl.core import modality
from neorl.evidence.verdict import VERDICTS
from lib.shared.report import NOT_COMPUTED
from neorl.evidence.statements import CLAIMS, DEMONSTRATIONS, STATEMENTS

README = (Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8")
EXAMPLES = re.findall(r"```python\n(.*?)```", README, re.DOTALL)


def test_the_tables_have_every_claim_as_it_is_stated_now_and_a_verdict_from_the_rules():
    (written,) = readme.BETWEEN.findall(README)
    for name in (*CLAIMS, *DEMONSTRATIONS):
        assert written.count(f"**{name}** {STATEMENTS[name].text}") == 1
    rows = re.findall(r"^\| ([●◐○◇])\u00a0(.*?) \| (.*) \|$", written, re.MULTILINE)
    assert {verdict for _, verdict, _ in rows} <= {*VERDICTS[:4], NOT_COMPUTED}
    for _, _, claims in rows:
        for claim in claims.split("; **"):
            name = re.match(r"[*]*(\w+)", claim)[1]
            forms = [rf"{each} \[{each}, {each}\]" for each in (r"−?\d+\.\d\d", r"−?\d+")]  # `Estimate`
            found = re.search(rf"here ({'|'.join(forms)})\)$", claim)
            assert bool(found) == (STATEMENTS[name].bounds.number is not None), claim


def test_claims_are_written_between_the_marks_and_nothing_else_is_touched():
    text = "before\n<!-- claims: make readme -->\nold\n<!-- end of claims -->\nafter | \\1\n"
    found = {"here": [0.1, 0.09, 0.11], "runs": 20, "verdict": "reproduced", "numbers": {}}
    new = readme.by_verdict({"claims": {"C2": found}, "letter": {}, "shares": {}})
    assert "with 20 runs of each condition" in new and new.count("**C2** One desire per colour") == 1
    assert all(new.count(f"**{name}** ") == 1 for name in STATEMENTS)
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
