"""The findings on the claims, as pages report them: tables in Markdown, and what a page saves.

1. The *record* is committed, and what is said of the thesis comes from it: claims under the book's reading ("claims"),
   under the reading to the letter ("letter"), and the shares of readings within the text that agree with claims
   ("shares"). `book/computing/record.py` computes it.
2. A page saves the claims that it has judged by its own runs in the folder ``claims`` of the cache, in the same form.
   At 100 runs they are the record's, of claims that pages alone judge.
"""

import json
import re
import tomllib
from collections import Counter
from functools import cache
from importlib import resources

import numpy as np

from companion import thesis
from companion.page import wording
from companion.page.marks import DECIDED, NOT_COMPUTED, leads, legend, symbol
from companion.page.opening import box, link
from companion.thesis.statements import STATEMENTS
from companion.thesis.verdict import RUNS_FOR_A_VERDICT, VERDICTS
from neorl.common.files import cache_folder, write_whole
from neorl.experiments.condition import source_digest
from neorl.statistics import Estimate

RECORD = resources.files(thesis) / "record.json"
PART_OF = {"calibrated": "claims", "letter": "letter"}  # of readings
PARTS = ("claims", "letter", "shares")  # of all records together
CLAIMS_OF = {"alternatives": ("A10", "C5"), "chapter_2": ("H1",), "chapter_3": ("T3", "T4"), "chapter_4": ("T5", "T7"),
             "chapter_5": ("T1", "T2", "T6"),
             "other_spaces": ("G1", "G2", "G3", "G4"), "paper_a": (*(f"A{n}" for n in range(1, 10)), "A11", "T9"),
             "paper_b": (*(f"B{n}" for n in range(1, 8)), "T8"), "paper_c": ("C1", "C2", "C3", "C4", "C6"),
             "assumptions": (*(f"A{n}" for n in range(1, 10)), "A11", "B1", "B2", "B3", "B4", "B6", "C1", "C2", "C3",
                             "C4", "C6", "T6")}  # the last to the letter
MISSING = None, "", "", ""  # a number under one reading that the other has not


def verdicts(claims, reading="calibrated"):
    """Claims that a page has judged by its own runs, beside the record, as a small Markdown table; "" without claims.

    Runs that are too few or too short for a verdict are not shown: the recorded verdicts stand alone.
    reading: under which they are, a name in `READINGS`.
    """
    if not claims:
        return ""
    recorded = record()[PART_OF[reading]]
    runs = min(claim.runs for claim in claims)
    more = " or more" * any(claim.runs > runs for claim in claims)
    few = runs < RUNS_FOR_A_VERDICT or not all(claim.full_length for claim in claims)
    rows = [[f"{link(claim.name)} {STATEMENTS[claim.name].short}",
             *([] if few else [_with_symbol(claim.verdict, str(claim.here))]),
             _of_record(recorded.get(claim.name))] for claim in claims]
    shown = [each for each in (recorded.get(claim.name, {}).get("verdict") for claim in claims) if each]
    shown += [] if few else [claim.verdict for claim in claims]
    symbols = legend(verdict for verdict in VERDICTS[:-1] if verdict in shown)
    wanted = f"; verdicts need {RUNS_FOR_A_VERDICT} of full length, so these are the record’s" * few
    return box(f"This page has {runs} runs of each condition{more}{wanted}. {symbols}".rstrip(),
               wording.table(["Claim", *([] if few else ["This page"]), "Recorded"], rows))


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


@cache
def record():
    """The committed record: {"claims": {name: …}, "letter": …, "shares": …, …}, with claims as in `kept`."""
    return json.loads(RECORD.read_text("utf-8"))


def load(paths):
    """Load what pages have saved as one: {"claims": {name: …}, "letter": …, "shares": …}.

    A claim that two pages have judged is that of more runs.
    """
    records = [json.loads(path.read_text(encoding="utf-8")) for path in paths]
    merged = {part: {} for part in PARTS}
    for part, known in merged.items():
        for name, found in (each for record in records for each in record.get(part, {}).items()):
            if found.get("runs", 0) >= known.get(name, {}).get("runs", 0):
                known[name] = found
    return merged


def number(found):
    """Our number for a claim, with its interval, as text. found: a claim of a record."""
    return wording.in_words(estimate_of(found["here"]))


def estimate_of(number):
    """The `Estimate` of a number as a record has it: a missing bound is null, and an infinite time "inf" or "-inf"."""
    return Estimate(*(np.nan if end is None else float(end) for end in number))


def verdict(record, name):
    """The verdict on a claim under the book's reading, or that it is not computed."""
    return record["claims"].get(name, {"verdict": NOT_COMPUTED})["verdict"]


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
    return [None if np.isnan(each) else float(each) if np.isfinite(each) else str(float(each)) for each in found]


def _of_record(found):
    return _with_symbol(found["verdict"], f"{number(found)}, {found['runs']} runs") if found else ""


def _with_symbol(verdict, text):
    return f"{symbol(verdict)}\u00a0{text}" if leads(verdict) else text
