"""The claims of the thesis: each with its place, the sentence that is judged, and the thesis's own number.

*Demonstrations* stand beside them: experiments of this book on sentences that ask for something and report no result.

They are data, in `statements.toml`; `neorl.evidence.claims` judges the claims.
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

    def hold(self, found):
        """Whether the interval of an `Estimate` lies within."""
        return self._below(self.low, found.low) and self._below(found.high, self.high)

    def allow(self, found):
        """Whether the interval of an `Estimate` reaches inside, so that more runs might show the claim."""
        return self._below(self.low, found.high) and self._below(found.low, self.high)

    def _below(self, one, other):
        return (operator.lt if self.open else operator.le)(one, other)

    def __str__(self):
        if math.isinf(self.high):
            text = f"more than {self.low:g}" if self.open else f"{self.low:g} or more"
        elif math.isinf(self.low):
            text = f"less than {self.high:g}" if self.open else f"{self.high:g} or less"
        else:
            text = f"from {self.low:g} to {self.high:g}"
        return text.replace("-", "−")


POSITIVE = Bounds(low=0.0, open=True)


@dataclass(frozen=True)
class Statement:
    """One claim, as stated before any result; `statements.toml` says what its fields are."""

    place: str
    quotation: str
    text: str
    statistic: str
    thesis: str
    figure: str
    rule: str
    bounds: Bounds
    also: Mapping[str, Bounds]
    demonstration: bool = False


STATEMENTS = {
    name: Statement(**given | {"bounds": Bounds(**given["bounds"]) if "bounds" in given else POSITIVE,
                               "also": {what: Bounds(**each) for what, each in given.get("also", {}).items()}})
    for name, given in tomllib.loads((resources.files(__package__) / "statements.toml").read_text("utf-8")).items()}
CLAIMS = tuple(name for name, statement in STATEMENTS.items() if not statement.demonstration)
DEMONSTRATIONS = tuple(name for name, statement in STATEMENTS.items() if statement.demonstration)
