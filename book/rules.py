"""The rules on the page of claims: when each was fixed and changed, and its code.

`rules.toml` has the history, with a digest of each rule as it stands, so that none changes without an entry.
"""

import hashlib
import inspect
import sys
import tomllib
from pathlib import Path

from companion.page import report
from companion.thesis import claims
from companion.thesis.statements import STATEMENTS

HISTORY = Path(__file__).parent / "rules.toml"


def page():
    """Every rule in a fold of its own, with the commits that fixed and changed it, in MyST Markdown."""
    history = tomllib.loads(HISTORY.read_text(encoding="utf-8"))
    return "\n\n".join(_fold(name, rule, history["commits"]) for name, rule in history["rules"].items()) + "\n"


def _fold(name, rule, commits):
    first, *later = rule["commits"]
    lines = [f"- Fixed on {commits[first]['date']} in commit `{first}`: {commits[first]['why']}."]
    lines += [f"- Changed on {commits[each]['date']} in `{each}`: {commits[each]['why']}." for each in later]
    code = "\n\n\n".join(inspect.getsource(each).rstrip() for each in functions(name))
    return "\n".join([f":::{{dropdown}} {rule['title']}", f"({report.label(name)})=", *lines, "", "```python", code,
                      "```", ":::"])


def digest(name):
    """A digest of all that decides the verdicts of a rule: its code and the bounds of the statements it judges."""
    bounds = [(key, each.bounds, dict(each.also)) for key, each in STATEMENTS.items() if each.rule == name]
    text = "".join(inspect.getsource(each) for each in functions(name)) + repr(bounds)
    return hashlib.sha256(text.encode()).hexdigest()[:12]


def functions(name):
    """A rule and the private functions of its module that it calls, a list."""
    rule = getattr(claims, name)
    module = sys.modules[rule.__module__]
    return [rule, *(getattr(module, each) for each in rule.__code__.co_names
                    if each.startswith("_") and inspect.isfunction(getattr(module, each, None)))]
