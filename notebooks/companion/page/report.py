"""The findings on the claims, as pages report them: tables in Markdown, and the record that a page saves.

A record is a JSON file for each page, in the folder ``claims`` of the cache. It has the claims that the page has judged
under the reading that it ran, or the shares of readings within the text that agree with claims ("shares"). Together
they have the claims under the book's reading ("claims"), those under the reading to the letter ("letter") and the
shares. `book/writing/ledger.py` makes the page of all claims from the records.
"""

import json
import re
import tomllib
from collections import Counter
from importlib import resources

import numpy as np

from companion import thesis
from companion.page import wording
from companion.page.marks import DECIDED, NOT_COMPUTED, leads, legend, symbol
from companion.page.opening import link
from companion.thesis.statements import CLAIMS, DEMONSTRATIONS, STATEMENTS
from neorl.common.files import cache_folder, write_whole
from neorl.experiments.condition import source_digest
from neorl.statistics import Estimate

COLUMNS = ("Claim", "Thesis", "To the letter", "Calibrated", "Verdict")
LEGEND = (f"{legend()}; without a symbol, no verdict. Numbers: the quantities in italics, with 95\u00a0% intervals "
          "over runs, or where a verdict rests on several, intervals that hold together with 95\u00a0%. A claim's name "
          "leads to what its verdict rests on.")
BESIDE = "Demonstrations of this book, not counted among the claims:"
PART_OF = {"calibrated": "claims", "letter": "letter"}  # of readings
PARTS = ("claims", "letter", "shares")  # of all records together
CLAIMS_OF = {"alternatives": ("A10", "C5"), "chapter_2": ("H1",), "chapter_3": ("T3", "T4"), "chapter_4": ("T5", "T7"),
             "chapter_5": ("T1", "T2", "T6"),
             "other_spaces": ("G1", "G2", "G3", "G4"), "paper_a": (*(f"A{n}" for n in range(1, 10)), "A11", "T9"),
             "paper_b": (*(f"B{n}" for n in range(1, 8)), "T8"), "paper_c": ("C1", "C2", "C3", "C4"),
             "assumptions": (*(f"A{n}" for n in range(1, 10)), "A11", "B1", "B2", "B3", "B4", "B6", "C1", "C2", "C3",
                             "C4", "T6")}  # the last to the letter
MISSING = None, "", "", ""  # a number under one reading that the other has not


def verdicts(claims):
    """Claims as a Markdown table, then demonstrations, and a legend; "" if there are none."""
    record = {"claims": kept(claims), "letter": {}}
    some, others = ([claim.name for claim in claims if claim.name in kind] for kind in (CLAIMS, DEMONSTRATIONS))
    parts = ([rows(record, some)] if some else []) + ([BESIDE, rows(record, others)] if others else [])
    return "\n\n".join([*parts, LEGEND]) if parts else ""


def comparison(judged):
    """Verdicts under readings, {reading: [Claim, …]}, on claims judged under most of them."""
    counts = Counter(claim.name for claims in judged.values() for claim in claims)
    names = sorted(name for name, count in counts.items() if 2 * count > len(judged))
    cells = {reading: {claim.name: _with_symbol(claim.verdict, wording.number(claim.here.value)) for claim in claims}
             for reading, claims in judged.items()}
    return wording.table(["Reading", *names], [[reading, *(found.get(name, "") for name in names)]
                                               for reading, found in cells.items()])


def errata(place=""):
    """The errata of the source as a Markdown table: all, or those of a place such as "paper A"."""
    listed = tomllib.loads((resources.files(thesis) / "errata.toml").read_text("utf-8"))["erratum"]
    rows = wording.table(["Where", "The thesis says", "Correct"],
                         [each.values() for each in listed if place in each["place"]])
    return re.sub(r"\^([A-Z]+)", r"<sup>\1</sup>", rows)


def save(page, claims=(), shares=None, reading="calibrated"):
    """Save the findings of a page as JSON, with the digest of the source that computed them.

    A record is complete: nothing is saved unless all claims of the page are judged.
    reading: under which they are, a name in `READINGS`. shares: {name of a claim: {"agrees", "measured"}}, counts of
    readings within the text, run at the papers' lengths. A missing bound is null.
    """
    if {claim.name for claim in claims} != {*CLAIMS_OF.get(page, ())}:
        return
    content = {"page": page, "source": source_digest(), PART_OF[reading]: kept(claims), "shares": shares or {}}
    write_whole(cache_folder() / "claims" / f"{page}.json", json.dumps(content, indent=1, allow_nan=False).encode())


def load(paths=None):
    """Load records, by default all that are saved, as one: {"claims": {name: …}, "letter": …, "shares": …}.

    A claim that two pages have judged is that of more runs.
    """
    paths = sorted((cache_folder() / "claims").glob("*.json")) if paths is None else paths
    records = [json.loads(path.read_text(encoding="utf-8")) for path in paths]
    merged = {part: {} for part in PARTS}
    for part, known in merged.items():
        for name, found in (each for record in records for each in record.get(part, {}).items()):
            if found.get("runs", 0) >= known.get(name, {}).get("runs", 0):
                known[name] = found
    return merged


def number(found):
    """Our number for a claim, with its interval, as text. found: a claim of a record."""
    return str(Estimate(*(np.nan if each is None else each for each in found["here"])))


def verdict(record, name):
    """The verdict on a claim under the book's reading, or that it is not computed."""
    return record["claims"].get(name, {"verdict": NOT_COMPUTED})["verdict"]


def rows(record, names):
    """Some claims of a record, as `load` returns it, as a Markdown table without its empty columns."""
    head, cells = wording.filled(COLUMNS, [_cells(record, name) for name in names])
    head = head if "To the letter" in head else ["Here" if each == "Calibrated" else each for each in head]
    return wording.table(head, cells)


def numbers(record, name):
    """The numbers of a claim under both readings, with the bounds that its rule asks for, as a Markdown table or "".

    A number has a mark if it decides: ✓, ✗ or ?. A part of the claim says so in its bounds. A sentence says how wide
    the intervals are.
    """
    found = {reading: record[part][name] for reading, part in (("Here", "claims"), ("To the letter", "letter"))
             if name in record[part]}
    rules = {what: rule for each in found.values() for what, (_, rule, *_) in each["numbers"].items()}
    rows = [[what, rule, *(_marked(*each["numbers"].get(what, MISSING)) for each in found.values())]
            for what, rule in rules.items()]
    head = ["Number", "Rule", *(f"{reading}, {each['runs']} runs or more" for reading, each in found.items())]
    together = max(each["together"] for each in found.values()) if found else 1
    note = (f"\n\nThe verdict rests on {together} intervals, so that each is one of {100 - 5 / together:.2f}\u00a0%: "
            "all hold together with 95\u00a0%." if together > 1 else "")
    return wording.table(head, rows) + note if rows else ""


def label(rule):
    """The label under which the book shows the code of a rule."""
    return f"rule-{rule.replace('_', '-')}"


def kept(claims):
    """Claims as a record has them: {name: data}."""
    return {claim.name: {"here": _bounded(claim.here), "runs": claim.runs, "verdict": claim.verdict,
                         "together": claim.together, "parts": claim.parts,
                         "numbers": {what: [_bounded(found), *_decided(found, bounds, role)]
                                     for what, (found, bounds, role) in claim.numbers.items()}} for claim in claims}


def _decided(found, bounds, role):
    """The bounds of a number in words, its mark and its role; the first two are "" if it is only shown."""
    if bounds is None:
        return "", "", role
    why = f" ({bounds.why})" if bounds.why else ""
    return f"{'partly if ' if role == 'part' else ''}{bounds}{why}", DECIDED[bounds.decide(found)], role


def _marked(found, _, mark, role):
    return (f"{mark}\u00a0" if mark else "") + number({"here": found}) if role else ""


def _bounded(found):
    return [float(each) if np.isfinite(each) else None for each in found]


def _cells(record, name):
    statement = STATEMENTS[name]
    return [f"**{link(name)}** {statement.text} <small>*{statement.statistic}*</small>", statement.thesis,
            *(_with_symbol(found["verdict"], number(found)) if (found := record[part].get(name)) else ""
              for part in ("letter", "claims")), verdict(record, name)]


def _with_symbol(verdict, text):
    return f"{symbol(verdict)}\u00a0{text}" if leads(verdict) else text
