"""The English of the pages: outside quotations and code, no word hides the technical subject of a sentence.

The subject of a sentence is the agent, the kernel, the run or the claim, and its verb is the field's: instead of "who
remembers all makes 0.9 a second", "agents that remember all earn 0.9 per second". `KEPT` lists exceptions.
"""

import ast
import json
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
# The docstrings and strings of all these rooms are checked.
ROOMS = ("core", "worlds", "agents", "experiments", "evidence", "drawing", "browser", "gym")
TELLTALE = re.compile(r"""
    \b(whoever|whom|nobody|somebody|someone|anybody|everybody|from\ nothing|tells?|told|hangs?\ on|wish(es|ed)?)\b
    | (^|[.:;(–]\ )who\b | \b(to|for|by|with|of|and|or|from|as|than|is|those)\ who\b  # without a noun before it
    | (?<!half\ )(?<!of\ )\ba\ second\b(?=[.,;:)|]|$|\ (and|in|on|for|with|at|before|while|by|of|each|from)\b)
    """, re.VERBOSE | re.IGNORECASE)
QUOTED = re.compile(r"“[^”]*”|```.*?```|`[^`]*`|\$\$?[^$]*\$\$?", re.DOTALL)
NOT_YET = ()
KEPT = {
    "after many of them it is hard to tell from a [Wiener process]",  # an idiom
}


def prose():
    """Yield every text that readers see, as (file, Markdown or string)."""
    for path in (ROOT / "README.md", *sorted((ROOT / "book").glob("*.md"))):
        yield path.name, path.read_text(encoding="utf-8")
    for path in sorted((ROOT / "notebooks").glob("*.ipynb")):
        for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
            source = "".join(cell["source"])
            shown = cell["metadata"].get("mystnb", {})
            yield path.name, shown.get("figure", {}).get("caption", "")
            yield path.name, shown.get("image", {}).get("alt", "")
            if cell["cell_type"] == "markdown":
                yield path.name, source
            else:
                yield from ((path.name, text) for text in strings(source))
    for folder in (*(ROOT / "neorl" / room for room in ROOMS), ROOT / "notebooks" / "lib"):
        for path in sorted(folder.rglob("*.py")):
            yield from ((str(path.relative_to(ROOT)), text) for text in strings(path.read_text(encoding="utf-8")))


def strings(source):
    """Yield the strings in Python code that have more than one word."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and " " in node.value:
            yield node.value


def telltales(text):
    """Sentences of a text, outside quotations and code, with a telltale word: [(word, sentence), …]."""
    text = " ".join(QUOTED.sub(" ", text).split())
    found = []
    for match in TELLTALE.finditer(text):
        begin, end = text.rfind(". ", 0, match.start()) + 1, text.find(". ", match.end())
        sentence = text[begin:end if end > 0 else None].strip()
        if not any(kept in sentence for kept in KEPT):
            found.append((match[0], sentence))
    return found


@pytest.mark.parametrize("sentence, word", [
    ("Whoever is quick shows it there.", "Whoever"), ("It is what nobody told it.", "nobody"),
    ("Only for who perceives it.", "for who"), ("Who walks into a wall stays.", "Who"),
    ("They make 0.55 a second.", "a second"), ("How steep it is hangs on the gain.", "hangs on"),
    ("It lives at 50 steps a second.", "a second")])
def test_a_telltale_word_is_found(sentence, word):
    assert telltales(sentence)[0] == (word, sentence.rstrip())


@pytest.mark.parametrize("text", [
    "The whole run.", "Half a second later.", "Rats, who had learned, ran.", "Jung and Adler, who disagreed.",
    "The thesis: “agents who wish”.", "The arrow keys steer a second player.", "`told` is a name."])
def test_what_is_plain_or_quoted_passes(text):
    assert telltales(text) == []


def test_no_sentence_of_pages_and_docstrings_hides_its_subject():
    assert [(where, *each) for where, text in prose() if not any(page in where for page in NOT_YET)
            for each in telltales(text)] == []
