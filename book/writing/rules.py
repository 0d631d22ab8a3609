"""The page of rules: what the last change of rules moved, and when each rule was fixed and changed, with its code.

`rules.toml` has the history, with a digest of each rule as it stands, so that none changes without an entry,
`rules_before.json` the verdicts of the rules before the last change, on the runs that were recorded by then and on the
present ones, and `comparisons.toml` what claims leave out. So one sees what the rules moved, and what the runs did.
"""

import hashlib
import inspect
import json
import sys
import tomllib
from pathlib import Path

from companion.page import marks, report
from companion.page.wording import table
from companion.thesis import claims, measures, verdict
from companion.thesis.reading import NAMES
from companion.thesis.statements import STATEMENTS

BOOK = Path(__file__).parents[1]
HISTORY, BEFORE, LEFT_OUT = BOOK / "rules.toml", BOOK / "rules_before.json", BOOK / "comparisons.toml"


def page(record):
    """The last change and every rule, with the commits that fixed and changed it, in MyST Markdown.

    record: of all claims, see `report.load`.
    """
    history = tomllib.loads(HISTORY.read_text(encoding="utf-8"))
    return "\n\n".join([moved(record, history["changes"]), left_out(), "## The rules", *(
        _fold(name, rule, history["commits"]) for name, rule in history["rules"].items())]) + "\n"


def moved(record, changes):
    """What the last change of rules asked and asks, and what it and the present runs moved, for both readings."""
    before, rows = json.loads(BEFORE.read_text(encoding="utf-8")), []
    for name in STATEMENTS:
        for reading, part in report.PART_OF.items():
            if name in before[part]:
                rows.append([f"**{name}**, {NAMES[reading]}", *map(_number, (
                    before[part][name]["earlier runs"], before[part][name]["present runs"], record[part].get(name)))])
    lines = [f"- **{name}** asked: {asked}. It asks: {asks}." for name, (asked, asks) in changes.items()]
    head = ["Claim", "Earlier runs and rules", "Present runs, earlier rules", "Present runs and rules"]
    return "\n\n".join(["## The last change", "What claims asked before it, and what they ask now:", "\n".join(lines),
                        "Verdicts with their main numbers, by which one sees what runs and what rules have moved:",
                        table(head, rows)])


def left_out():
    """The simplest comparable agent of each claim that compares agents, and the sentences that no rule judges."""
    listed = tomllib.loads(LEFT_OUT.read_text(encoding="utf-8"))
    agents = [[f"**{name}** {STATEMENTS[name].short}", agent, decided]
              for name, (agent, decided) in listed["comparable"].items()]
    sentences = [[f"“{each['quotation']}” ({each['place']})", each["why"]] for each in listed["untested"]]
    return "\n\n".join([
        "## Beside whom agents stand", "For each claim that compares agents, the simplest agent that its sentence "
        "makes comparable, and whether a rule asks for it:",
        table(["Claim", "Simplest comparable agent", "Decided"], agents),
        "## Sentences without a rule", table(["Sentence", "Why no rule judges it"], sentences)])


def _number(found):
    return f"{marks.symbol(found['verdict'])}\u00a0{found['verdict']}, {report.number(found)}" if found else ""


def _fold(name, rule, commits):
    first, *later = rule["commits"]
    lines = [f"- Fixed on {commits[first]['date']} in commit `{first}`: {commits[first]['why']}."]
    lines += [f"- Reads {key}: “{each.quotation}” ({each.place})." for key, each in STATEMENTS.items()
              if each.rule == name]
    lines += [f"- Changed on {commits[each]['date']} in `{each}`: {commits[each]['why']}." for each in later]
    code = "\n\n\n".join(inspect.getsource(each).rstrip() for each in functions(name))
    return "\n".join([f":::{{dropdown}} {rule['title']}", f"({report.label(name)})=", *lines, "", "```python", code,
                      "```", ":::"])


def digest(name):
    """A digest of all that decides the verdicts of a rule: its code and the bounds of the statements it judges."""
    bounds = [(key, each.bounds, dict(each.also)) for key, each in STATEMENTS.items() if each.rule == name]
    text = "".join(inspect.getsource(each) for each in functions(name)) + repr(bounds)
    return hashlib.sha256(text.encode()).hexdigest()[:12]


def shared():
    """A digest of what all rules share: how they measure, and how verdicts follow."""
    return hashlib.sha256("".join(map(inspect.getsource, (measures, verdict))).encode()).hexdigest()[:12]


def functions(name):
    """A rule and the private functions of its module that it calls, a list."""
    rule = getattr(claims, name)
    module = sys.modules[rule.__module__]
    return [rule, *(getattr(module, each) for each in rule.__code__.co_names
                    if each.startswith("_") and inspect.isfunction(getattr(module, each, None)))]
