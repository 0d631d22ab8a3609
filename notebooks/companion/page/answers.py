"""The answer that opens a page, in plain words with recorded numbers: `answers.toml` has the words of each page."""

import re
import tomllib
from importlib import resources

from companion.page import behind, counts, report
from companion.page.wording import in_words
from companion.thesis.pins import PINS
from companion.thesis.priors import WITHIN
from companion.thesis.reading import READINGS
from neorl.statistics import Estimate

WORDS = tomllib.loads((resources.files(__package__) / "answers.toml").read_text("utf-8"))
NUMBER = re.compile(r"\{(\w+)(?:: ([^}%[]+?))?( %| \[\])?\}")
BOLD = re.compile(r"\*\*(.+?)\*\*")


def answer(page):
    """The answer of a page as HTML, with the one number that carries it in bold; "" if it has none."""
    words = WORDS.get(page, "")
    return BOLD.sub(r"<strong>\1</strong>", NUMBER.sub(lambda found: _number(*found.groups()), words))


def _number(name, what, form):
    found = _found(name, what)
    if isinstance(found, int):
        return str(found)
    value, *_ = found = report.estimate_of(found)
    if form == " %":
        return f"{100 * value:.0f}\u00a0%"
    return in_words(found if form else Estimate(value, value, value))


def _found(name, what):
    if name == "choices":
        return choices()[what]
    if name == "searched":
        hold, of_all = counts.reproduced(report.record()["claims"], report.record()["shares"])
        return {"hold": hold, "claims": of_all}[what]
    if name in ("early", "final", "whole"):
        runs = behind.recorded_runs("calibrated", what)
        return runs.curve[:, 0] if name == "early" else getattr(runs, name)
    claim = report.record()["claims"][name]
    return claim["numbers"][what][0] if what else claim["here"]


def choices():
    """How many choices there are in building the agents, how many the text fixes, and how readings fill the others."""
    fixed = sum(pin.status == "pinned" for pin in PINS)
    letter, calibrated = (READINGS[name].choices for name in ("letter", "calibrated"))
    return {"all": len(PINS), "fixed": fixed, "open": len(PINS) - fixed,
            "departing": sum(letter[name] != calibrated[name] for name in WITHIN)}
