"""Priors for every choice of a reading: one space within the text, and one beyond it.

1. Each choice has its own prior, a distribution or equally likely levels, stated before any result.
2. Within the text (`WITHIN`), a choice that `neorl.evidence.pins` pins to one value is not varied; open choices are
   varied widely.
3. Beyond the text (`BEYOND`), pinned choices are varied as well, jointly with all others.
4. The reading to the letter takes the values that the text pins. Where more than one is left, it takes the one that a
   sentence or an equation prints, or else the plainest, which stands first among the levels, or else the middle of the
   prior. `neorl.evidence.pins` says which and why.
"""

import math
from dataclasses import dataclass, fields
from typing import Any, NamedTuple

from neorl.agents import papers
from neorl.agents.rules import WHEN_INDIFFERENT
from neorl.evidence.reading import LAYERS, Reading
from neorl.worlds.waterworld import CONTACTS

# Measures of a value that are uniform in their logarithm, with their inverses.
MEASURES = {"": (lambda value: value, lambda measure: measure),
            "1 + value": (lambda value: 1 + value, lambda measure: measure - 1),
            "1 / (1 − value)": (lambda value: 1 / (1 - value), lambda measure: 1 - 1 / measure)}


@dataclass(frozen=True)
class LogUniform:
    """A distribution of numbers that is uniform in the logarithm of their `measure`.

    low, high: the ends of that measure, which is the number itself or one of `MEASURES`. zero: the probability of 0,
    outside these ends.
    """

    low: float
    high: float
    measure: str = ""
    zero: float = 0.0

    def ppf(self, share):
        """The quantile at a share in [0, 1]."""
        if share < self.zero:
            return 0.0
        share = (share - self.zero) / (1 - self.zero)
        return float(MEASURES[self.measure][1](self.low * (self.high / self.low) ** share))

    def cdf(self, value):
        """The share that lies below a number; 0 at the extra zero."""
        if self.zero and value == 0:
            return 0.0
        measure = MEASURES[self.measure][0](value)
        share = math.log(measure / self.low) / math.log(self.high / self.low)
        return self.zero + (1 - self.zero) * min(max(share, 0.0), 1.0)

    def support(self):
        """The least and the greatest number."""
        least = 0.0 if self.zero else MEASURES[self.measure][1](self.low)
        return least, MEASURES[self.measure][1](self.high)

    def __str__(self):
        words = "log-uniform" + (f" in {self.measure}" if self.measure else "")
        return words + (f", or 0 ({self.zero:.0%})".replace("%", "\u00a0%") if self.zero else "")


class Choice(NamedTuple):
    """How a field of `Reading` is varied."""

    label: str
    prior: tuple | LogUniform  # levels, the plainest first, or a distribution
    papers: str  # the first letters of the claims that depend on it

    @property
    def levels(self):
        """Its levels, or the ends of its prior, in words."""
        if isinstance(self.prior, tuple):
            return ", ".join(map(self.words, self.prior))
        return " … ".join(map(self.words, self.prior.support()))

    @property
    def stated(self):
        """The whole prior, in words."""
        return self.levels if isinstance(self.prior, tuple) else f"{self.levels}, {self.prior}"

    @property
    def plainest(self):
        """The first of the levels, or the middle of the prior."""
        return self.at(0.0 if isinstance(self.prior, tuple) else 0.5)

    @staticmethod
    def words(value):
        """A value in words."""
        if isinstance(value, bool):
            return "yes" if value else "no"
        if isinstance(value, tuple):
            return f"{{{', '.join(map(str, value))}}}"
        if isinstance(value, str):
            return value
        return (f"{value:.3g}" if abs(value) < 999.5 else f"{value:,.0f}").replace("-", "−")

    def at(self, share):
        """The quantile of the prior at a share in [0, 1)."""
        if isinstance(self.prior, tuple):
            return self.prior[int(share * len(self.prior))]
        return self.prior.ppf(share)

    def place(self, value):
        """Where a value lies between the ends of the prior, from 0 to 1."""
        if isinstance(self.prior, tuple):
            return self.prior.index(value) / (len(self.prior) - 1)
        return self.prior.cdf(value)


WITHIN = {
    "learning_rate": Choice("learning rate, α", LogUniform(3e-4, 0.5), "ABCT"),
    "discount": Choice("discount, γ", LogUniform(1.5, 300, "1 / (1 − value)"), "ABCT"),
    "credit": Choice("credit, ψ(N)", ("happened", "share", "count", "activity"), "ABCT"),
    "absent_decay": Choice("absence, −ψ(0)", LogUniform(1e-3, 1), "ABCT"),
    "absent_form": Choice("form of absence", ("away", "decay"), "ABCT"),
    "memory": Choice("memory, cells or 0.1\u00a0s", LogUniform(1, 1_001, "1 + value"), "ABCT"),
    "memory_unit": Choice("memory fades with", ("cells", "seconds"), "ABCT"),
    "memory_value": Choice("value in memory", ("reached", "discounted"), "ABCT"),
    "activity": Choice("activity, in seconds", LogUniform(0.05, 5), "ABCT"),
    "bootstrap": Choice("bootstrapping", (True, False), "ABCT"),
    "terminal": Choice("goals terminal", (False, True), "ABCT"),
    "causes": Choice("causes", ("any", "own"), "BCT"),
    "capture": Choice("capture", ("contact", "leap", "silent"), "BCT"),
    "attention": Choice("attention", ("each", "nearest", "wanted"), "BCT"),
    "object_tiled_fraction": Choice("range of objects", (1.0, 0.5, 0.25), "BCT"),
    "weighting": Choice("map weights", ("resolution", "cells"), "ABCT"),
    "place_gain": Choice("gain of place, B", (1.0, 3.0, 5.0), "BT"),
    "network_resolutions": Choice("resolutions, C", (LAYERS, papers.PRIMES), "C"),
    "fps": Choice("steps per second", (50, 30, 60), "ABCT"),
    "contact": Choice("contact", CONTACTS, "ABCT"),
}
PINNED: dict[str, Any] = {
    "own_cell": "counts", "tiled_fraction": 1.0, "exploration": 0.0, "when_indifferent": "random", "network_gain": 1.0,
    "vectors": "signed", "scale": 1.0, "recursion": -1.0}
TO_THE_LETTER = Reading(**PINNED, **{name: choice.plainest for name, choice in WITHIN.items()})
_BEYOND = WITHIN | {
    "credit": Choice("credit, ψ(N)", ("happened", "share", "count", "activity", "last", "step"), "ABCT"),
    "absent_decay": Choice("absence, −ψ(0)", LogUniform(1e-3, 1, zero=0.4), "ABCT"),
    "memory": Choice("memory, cells or 0.1\u00a0s", LogUniform(1, 1_001, "1 + value", zero=0.2), "ABCT"),
    "own_cell": Choice("own cell", ("counts", "silent"), "ABCT"),
    "tiled_fraction": Choice("range of places", (1.0, 0.5), "ABCT"),
    "weighting": Choice("map weights", ("resolution", "cells", "equal"), "ABCT"),
    "exploration": Choice("exploration, ε", (0.0, 0.02, 0.1), "ABCT"),
    "when_indifferent": Choice("when idle", WHEN_INDIFFERENT, "ABCT"),
    "network_gain": Choice("gain of place, C", (1.0, 3.0, 5.0), "C"),
    "vectors": Choice("desire vectors", ("signed", "by size", "incoming"), "C"),
    "scale": Choice("desire scale", LogUniform(0.25, 4), "C"),
    "recursion": Choice("recursion, r", (-1.0, -3.0, -2.0, -0.5, 0.5, 1.0), "C"),
}
BEYOND = {field.name: _BEYOND[field.name] for field in fields(Reading)}
