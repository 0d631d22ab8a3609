"""The display of verdicts, the same everywhere: a symbol, on pages also a colour, but never colour alone.

The colours are set by classes in the book's style sheet, for light pages and for dark ones. What speaks against a claim
has one colour, what decides nothing is grey.
"""

from typing import NamedTuple

from companion.thesis.verdict import VERDICTS

NOT_COMPUTED = "not computed in this build"


class Mark(NamedTuple):
    """The symbol of a verdict, and its class in the book's style sheet."""

    symbol: str
    css: str


NONE = Mark("◇", "verdict-none")  # not a dash, which a number turns into a minus sign
MARKS = dict(zip(VERDICTS, (Mark("●", "verdict-reproduced"), Mark("◐", "verdict-partly"),
                            Mark("○", "verdict-contradicted"), Mark("⊘", "verdict-partly"),
                            Mark("?", "verdict-none"), NONE,
                            Mark("∎", "verdict-contradicted"), Mark("∃", "verdict-contradicted"), NONE), strict=True)
             ) | {NOT_COMPUTED: NONE}
REASONS = {"not as a whole": "whether a part holds is open", "undecided": "more runs would tell",
           "not testable": "the agents learned too little"}
DECIDED = {True: "✓", False: "✗", None: "?"}  # whether an interval is as a rule asks, see `Bounds.decide`


def symbol(verdict: str) -> str:
    """The symbol of a verdict."""
    return MARKS[verdict].symbol


def leads(verdict: str) -> bool:
    """Whether a verdict's symbol stands before a number: with too few runs, the number stands alone."""
    return verdict not in ("no verdict", NOT_COMPUTED)


def legend(verdicts=VERDICTS[:-1]) -> str:
    """The symbols of some verdicts with their meaning: "● reproduced, …"."""
    return ", ".join(f"{symbol(verdict)}\u00a0{explained(verdict)}" for verdict in verdicts)


def explained(verdict: str) -> str:
    """A verdict, with its reason if it has one."""
    return f"{verdict} ({REASONS[verdict]})" if verdict in REASONS else verdict


def html(verdict: str) -> str:
    """The symbol in its colour, as inline HTML for Markdown; the verdict is its name for screen readers."""
    return (f'<span class="verdict {MARKS[verdict].css}" role="img" '
            f'aria-label="{verdict}" title="{verdict}">{symbol(verdict)}</span>')
