"""The claims of the thesis: each with its place, the sentence that is judged, and the thesis's own number.

1. Most are about *agents*. The others are counted apart: a claim refuted by *proof*, claims that are true by
   *counting*, claims about the *code* of this book, and a *report* of what the author tried.
2. *Demonstrations* stand beside them: experiments of this book on sentences that ask for something and report no
   result, or for more than is measured.

They are data, in `statements.toml`; `companion.thesis.claims` judges the claims.
"""

import math
import operator
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from importlib import resources


@dataclass(frozen=True)
class Bounds:
    """The interval of an estimate that agrees with a claim.

    low, high: its ends, which may be infinite. number: the thesis's own, if it gives one. open: without its ends. why:
    how wide it is, in words.
    """

    low: float = -math.inf
    high: float = math.inf
    number: float | None = None
    open: bool = False
    why: str = field(default="", repr=False)

    def decide(self, found):
        """Whether the interval of an `Estimate` lies within (True), wholly outside (False) or across an end (None)."""
        if self._below(self.low, found.low) and self._below(found.high, self.high):
            return True
        reaches = self._below(self.low, found.high) and self._below(found.low, self.high)
        return None if reaches or math.isnan(found.low) else False

    def _below(self, one, other):
        no_bound = math.isinf(one) and one == other
        return (operator.lt if self.open and not no_bound else operator.le)(one, other)

    def __str__(self):
        if math.isinf(self.high):
            text = f"more than {self.low:g}" if self.open else f"{self.low:g} or more"
        elif math.isinf(self.low):
            text = f"less than {self.high:g}" if self.open else f"{self.high:g} or less"
        else:
            text = f"from {self.low:g} to {self.high:g}"
        return text.replace("-", "−")


POSITIVE = Bounds(low=0.0, open=True)
VISIBLE = Bounds(low=0.01, why="what a figure shows")  # of a lead in reward per second
KINDS = ("agents", "proof", "counting", "code", "report", "demonstration")


@dataclass(frozen=True)
class Statement:
    """One claim; `statements.toml` says what its fields are, and when they were stated."""

    place: str
    quotation: str
    short: str
    text: str
    statistic: str
    thesis: str
    figure: str
    rule: str
    bounds: Bounds
    also: Mapping[str, Bounds]
    kind: str = "agents"  # one of KINDS
    finding: str | Mapping[str, str] = ""
    why: str = ""


def _bounds(given):
    return VISIBLE if given == "visible" else Bounds(**given)


STATEMENTS = {
    name: Statement(**fields | {"bounds": _bounds(fields["bounds"]) if "bounds" in fields else POSITIVE,
                                "also": {what: _bounds(each) for what, each in fields.get("also", {}).items()}})
    for name, fields in tomllib.loads((resources.files(__package__) / "statements.toml").read_text("utf-8")).items()}
CLAIMS = tuple(name for name, statement in STATEMENTS.items() if statement.kind != "demonstration")
AGENTS = tuple(name for name, statement in STATEMENTS.items() if statement.kind == "agents")
DEMONSTRATIONS = tuple(name for name, statement in STATEMENTS.items() if statement.kind == "demonstration")
