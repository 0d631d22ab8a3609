"""The display of verdicts, the same everywhere: a symbol, on pages also a colour, but never colour alone.

The colours are set by classes in the book's style sheet, for light pages and for dark ones.
"""

from typing import NamedTuple

from neorl.evidence.verdict import VERDICTS

NOT_COMPUTED = "not computed in this build"


class Mark(NamedTuple):
    """The symbol of a verdict, and its class in the book's style sheet."""

    symbol: str
    css: str


NONE = Mark("◇", "verdict-none")  # not a dash, which a number turns into a minus sign
MARKS = dict(zip(VERDICTS, (Mark("●", "verdict-reproduced"), Mark("◐", "verdict-partly"),
                            Mark("○", "verdict-not-reproduced"), NONE, NONE))) | {NOT_COMPUTED: NONE}


def symbol(verdict: str) -> str:
    """The symbol of a verdict: ● reproduced, ◐ partly, ○ not reproduced, ◇ anything else."""
    return MARKS[verdict].symbol


def leads(verdict: str) -> bool:
    """Whether a verdict's symbol stands before a number: with too few runs, the number stands alone."""
    return verdict not in ("no verdict", NOT_COMPUTED)


def html(verdict: str) -> str:
    """The symbol in its colour, as inline HTML for Markdown; the verdict is its name for screen readers."""
    return (f'<span class="verdict {MARKS[verdict].css}" role="img" '
            f'aria-label="{verdict}" title="{verdict}">{symbol(verdict)}</span>')
