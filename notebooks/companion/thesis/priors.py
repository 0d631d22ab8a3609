"""Priors for every choice of a reading: one space within the text, and one beyond it.

1. Each choice has its own prior, a distribution or equally likely levels, stated before any result.
2. Within the text (`WITHIN`), a choice that `companion.thesis.pins` pins to one value is not varied; open choices are
   varied widely.
3. Beyond the text (`BEYOND`), pinned choices are varied as well, jointly with all others.
4. The reading to the letter takes the values that the text pins. Where more than one is left, it takes the one that a
   sentence or an equation prints, or else the simplest, which stands first among the levels, or else the middle of the
   prior, which is a number of ours. `companion.thesis.pins` says which and why.
5. Trials outside this project had found α of 0.03, −ψ(0) of 0.9 and memories of some 20 cells before these priors were
   written; they reach far beyond on either side.
"""

import math
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

from neorl.agents import papers
from neorl.agents.rules import WHEN_INDIFFERENT
from companion.thesis.reading import LAYERS, Reading
from neorl.worlds.waterworld import CONTACTS

# Measures of a value that are uniform in their logarithm, with their inverses.
MEASURES = {"": (lambda value: value, lambda measure: measure),
            "1 + value": (lambda value: 1 + value, lambda measure: measure - 1),
            "1 / (1 − value)": (lambda value: 1 / (1 - value), lambda measure: 1 - 1 / measure)}


@dataclass(frozen=True)
class LogUniform:
    """A distribution of numbers that is uniform in the logarithm of their `measure`.

    A number at one of the ends or beyond may be apart, with a probability of its own.
    """

    low: float  # of the measure
    high: float
    measure: str = ""  # one of `MEASURES`
    apart: float | None = None
    chance: float = 0.0  # of the number apart

    @property
    def _apart_is_highest(self):
        return self.apart is not None and self.apart > MEASURES[self.measure][1](self.low)

    def ppf(self, share):
        """The quantile at a share in [0, 1]."""
        begin, end = (0.0, 1 - self.chance) if self._apart_is_highest else (self.chance, 1.0)
        if self.apart is not None and not begin <= share < end:
            return self.apart
        return float(MEASURES[self.measure][1](self.low * (self.high / self.low) ** ((share - begin) / (end - begin))))

    def cdf(self, value):
        """The share that lies below a number; 0 or 1 for the number apart."""
        if value == self.apart:
            return float(self._apart_is_highest)
        measure = MEASURES[self.measure][0](value)
        share = min(max(math.log(measure / self.low) / math.log(self.high / self.low), 0.0), 1.0)
        return (1 - self.chance) * share + (0.0 if self._apart_is_highest else self.chance)

    def support(self):
        """The least and the greatest number."""
        ends = [MEASURES[self.measure][1](end) for end in (self.low, self.high)]
        ends += [] if self.apart is None else [self.apart]
        return min(ends), max(ends)

    def __str__(self):
        words = "log-uniform" + (f" in {self.measure}" if self.measure else "")
        if self.apart is None:
            return words
        return words + f", or {self.apart:g} ({self.chance:.0%})".replace("%", "\u00a0%")


class Choice(NamedTuple):
    """How one of the `choices` of a `Reading` is varied."""

    label: str
    prior: tuple | LogUniform  # levels, the simplest first, or a distribution
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
        return self.levels if isinstance(self.prior, tuple) else (
            f"{' … '.join(map(self.words, replace(self.prior, apart=None).support()))}, {self.prior}")

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


CONTACT_REACH = 0.096  # half the side of the square of contact, 24 of 250 pixels (`neorl.worlds.waterworld`)
WITHIN = {
    "learning_rate": Choice("learning rate, α", LogUniform(3e-4, 0.5), "ABCT"),
    "discount": Choice("discount, γ", LogUniform(1.5, 300, "1 / (1 − value)", apart=1.0, chance=0.25), "ABCT"),
    "credit": Choice("credit, ψ(N)", ("activity", "count", "happened", "share"), "ABCT"),
    "absent_decay": Choice("absence, −ψ(0)", LogUniform(1e-3, 1), "ABCT"),
    "absent_form": Choice("form of absence", ("away", "decay"), "ABCT"),
    "memory": Choice("memory, cells", LogUniform(1.5, 1_001, "1 + value", apart=0.0, chance=0.15), "ABCT"),
    "activity": Choice("activity, in seconds", LogUniform(0.05, 5), "ABCT"),
    "bootstrap": Choice("bootstrapping", (True, False), "ABCT"),
    "terminal": Choice("goals terminal", (False, True), "ABCT"),
    "shared_cell": Choice("shared cell", ("once", "each"), "ABCT"),
    "resets": Choice("resets", ("unnoticed", "noticed"), "ABCT"),
    "object_state": Choice("state of object vectors", ("self", "per object", "object"), "BCT"),
    "object_reach": Choice("reach of contact", (0.0, CONTACT_REACH), "BCT"),
    "object_tiled_fraction": Choice("range of objects", (1.0, 0.5, 0.25), "BCT"),
    "object_beyond": Choice("cell beyond the range", ("outermost", "none"), "BCT"),
    "object_centred": Choice("centred on the self", (False, True), "BCT"),
    "weighting": Choice("map weights", ("resolution", "cells"), "ABCT"),
    "place_gain": Choice("gain of place, B", (1.0, 2.0, 3.0, 4.0, 5.0, 7.0, 10.0, 14.0, 20.0), "BT"),
    "vectors": Choice("desire vectors", ("by size", "signed"), "C"),
    "scale": Choice("desire scale", LogUniform(0.1, 1_000), "C"),
    "network_resolutions": Choice("resolutions, C", (LAYERS, papers.PRIMES), "C"),
    "fps": Choice("steps per second", (50, 30, 60), "BCT"),
    "contact": Choice("contact", CONTACTS, "ABCT"),
    "paper_a_fps": Choice("steps per second, A", (50, 30, 60), "A"),
}
PINNED: dict[str, Any] = {
    "own_cell": "counts", "tiled_fraction": 1.0, "exploration": 0.0, "when_indifferent": "random", "network_gain": 1.0,
    "recursion": -1.0}
_BEYOND = WITHIN | {
    "credit": Choice("credit, ψ(N)", ("activity", "count", "happened", "share", "last", "step"), "ABCT"),
    "absent_decay": Choice("absence, −ψ(0)", LogUniform(1e-3, 1, apart=0.0, chance=0.4), "ABCT"),
    "own_cell": Choice("own cell", ("counts", "silent"), "ABCT"),
    "tiled_fraction": Choice("range of places", (1.0, 0.5), "ABCT"),
    "weighting": Choice("map weights", ("resolution", "cells", "equal"), "ABCT"),
    "exploration": Choice("exploration, ε", (0.0, 0.02, 0.1), "ABCT"),
    "when_indifferent": Choice("when idle", WHEN_INDIFFERENT, "ABCT"),
    "network_gain": Choice("gain of place, C", (1.0, 3.0, 5.0), "C"),
    "recursion": Choice("recursion, r", (-1.0, -3.0, -2.0, -0.5, 0.5, 1.0), "C"),
}
BEYOND = {name: _BEYOND[name] for name in Reading().choices}
