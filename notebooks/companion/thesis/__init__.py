"""What judges this one thesis: its claims, their rules and verdicts, and readings of the text."""

from companion.thesis import claims, pins
from companion.thesis.priors import WITHIN
from companion.thesis.reading import (GROUPS, LAYERS, NAMES, PRIMES, READINGS, RECORDED_ALONE, TO_THE_LETTER,
                                      Reading, additions, changed, conditions, judge, named)
from companion.thesis.measures import EARLY, FINAL

__all__ = ["EARLY", "FINAL", "GROUPS", "LAYERS", "NAMES", "PRIMES", "READINGS", "RECORDED_ALONE", "Reading",
           "TO_THE_LETTER", "WITHIN", "additions", "changed", "claims", "conditions", "judge", "named", "pins"]
