"""What was found about the claims, as pages tell it: tables in Markdown, and the record that a page leaves on disk.

A record is JSON, one file a page, in the folder ``claims`` of the store: the claims that the page has judged, or, from
the chapter on assumptions, the shares of readings under which they hold. The page of all claims is made of records.
"""

import json

import numpy as np

from neorl.claims import VERDICTS
from neorl.statements import STATEMENTS
from neorl.statistics import Estimate
from neorl.store import folder, source_digest, write_whole

SIGNS = dict(zip(VERDICTS, "●◐○––"))
NOT_COMPUTED = "not computed in this build"


def table(claims):
    """The claims as a Markdown table."""
    rows = ["| Claim | Thesis, and here with 95 % interval | Verdict |", "|---|---|---|"]
    rows += [f"| **{claim.name}** {claim.statement.text} | {claim.statement.statistic}. Thesis: "
             f"{claim.statement.thesis}. Here: {claim.here}. {claim.detail} | **{claim.verdict}** |"
             for claim in claims]
    return "\n".join(rows)


def comparison(judged):
    """Verdicts under several readings as a Markdown table: judged {reading: [Claim, …]}."""
    names = sorted({claim.name for claims in judged.values() for claim in claims})
    rows = ["| Reading | " + " | ".join(names) + " |", "|---" * (len(names) + 1) + "|"]
    for reading, claims in judged.items():
        cells = {claim.name: f"{SIGNS[claim.verdict]}\u00a0{claim.here.value:z.2f}" for claim in claims}
        rows.append(f"| {reading} | " + " | ".join(cells.get(name, "") for name in names).replace("-", "−") + " |")
    return "\n".join(rows)


def summary(judged):
    """Where each claim is reproduced, and which readings come closest, in Markdown: judged {reading: [Claim, …]}."""
    by_reading = {reading: {claim.name: claim.verdict for claim in claims} for reading, claims in judged.items()}
    if any("no verdict" in verdicts.values() for verdicts in by_reading.values()):
        return "With so few runs there is nothing to sum up."
    lines = ["Each claim, and where it is reproduced:", ""]
    for name in dict.fromkeys(name for verdicts in by_reading.values() for name in verdicts):
        where = [reading for reading, verdicts in by_reading.items() if verdicts.get(name) == "reproduced"]
        lines.append(f"- **{name}** {STATEMENTS[name].text}: *{'; '.join(where) or 'none of these readings'}*.")
    score = {reading: tuple([*verdicts.values()].count(kind) for kind in ("reproduced", "partly"))
             for reading, verdicts in by_reading.items()}
    closest = [reading for reading in score if score[reading] == max(score.values())]
    return "\n".join([*lines, "", "Closest to the paper comes *{}*: {} of its claims are reproduced and {} partly. In "
                      "the default reading they are {} and {}.".format("*, *".join(closest), *max(score.values()),
                                                                   *score["default"])])


def store(page, claims=(), shares=None):
    """Keep what a page has found as JSON, with the digest of the source that it was computed with.

    claims: of `Claim`. shares: {name of a claim: {"holds", "undecided", "readings"}}, counts of readings. A bound that
    does not exist, as with a single run, is null.
    """
    kept = {claim.name: {"here": [each if np.isfinite(each) else None for each in claim.here], "runs": claim.runs,
                         "verdict": claim.verdict, "detail": claim.detail} for claim in claims}
    content = {"page": page, "source": source_digest(), "claims": kept, "shares": shares or {}}
    write_whole(folder() / "claims" / f"{page}.json", json.dumps(content, indent=1, allow_nan=False).encode())


def read(paths=None):
    """The records in JSON files, as one: {"claims": {name: …}, "shares": {name: …}}. By default all that are kept."""
    paths = sorted((folder() / "claims").glob("*.json")) if paths is None else paths
    records = [json.loads(path.read_text(encoding="utf-8")) for path in paths]
    return {what: {name: found for record in records for name, found in record[what].items()}
            for what in ("claims", "shares")}


def number(found):
    """Our number for a claim, with its interval, as text. found: a claim of a record."""
    return str(Estimate(*(np.nan if each is None else each for each in found["here"])))


def standing(record, names):
    """What became of some claims, in Markdown: a line for each verdict. record: as `read` has it."""
    lines = []
    for verdict in (*VERDICTS, NOT_COMPUTED):
        found = [f"{STATEMENTS[name].text} ({name})" for name in names
                 if record["claims"].get(name, {"verdict": NOT_COMPUTED})["verdict"] == verdict]
        if found:
            lines.append(f"- *{verdict.capitalize()}*: {'; '.join(found)}.")
    return "\n".join(lines)


def page(record):
    """The table of all claims for the book, in MyST Markdown."""
    rows = ["| Claim | Verdict | What it rests on |", "|---|---|---|"]
    for name, claim in STATEMENTS.items():
        found = record["claims"].get(name)
        verdict, evidence = NOT_COMPUTED, f"{claim.statistic}. Thesis ({claim.place}): {claim.thesis}."
        if found:
            verdict = f"**{found['verdict']}**"
            evidence += (f" Here: {number(found)}, {found['runs']} runs. {found['detail']} "
                         f"({{ref}}`Figure <{claim.figure}>`, {{ref}}`rule <{label(claim.rule)}>`)")
        rows.append(f"| **{name}** {claim.text} | {verdict}{_share(record, name)} | {evidence} |")
    return "\n".join(rows) + "\n"


def in_short(record):
    """The same table in short, in plain Markdown."""
    rows = ["| Claim | Thesis | Here | Verdict | Holds in |", "|---|---|---|---|---|"]
    for name, claim in STATEMENTS.items():
        found, share = (record[what].get(name) for what in ("claims", "shares"))
        rows.append(f"| {name} {claim.text} | {claim.thesis} | {number(found) if found else ''} | "
                    f"{found['verdict'] if found else NOT_COMPUTED} | "
                    f"{_percent(share['holds'], share['readings']) if share else ''} |")
    return "\n".join(rows) + "\n"


def label(rule):
    """The label under which the book shows the code of a rule."""
    return f"rule-{rule.replace('_', '-')}"


def _share(record, name):
    found = record["shares"].get(name)
    if not found:
        return ""
    holds, undecided = (_percent(found[kind], found["readings"]) for kind in ("holds", "undecided"))
    return f"; holds in {holds} of {found['readings']} readings, undecided in {undecided}"


def _percent(part, whole):
    return f"{100 * part / whole:.0f}\u00a0%"
