"""The two conclusions of the thesis (section 5.1), compared with the verdicts on its claims under two readings.

1. Each conclusion rests on some claims, and claims on other worlds and agents on none; all others are the ground of
   both.
2. A conclusion holds *in full* if all its claims are reproduced, *in part* if some are, *not at all* if none of those
   judged is; but it is *undecided* if none is and some cannot be tested, and *without a verdict* if none is judged.
3. ``verdicts`` are {reading: {name of a claim: its verdict}} for the readings `LETTER` and `CALIBRATED`, in the words
   of `neorl.evidence.report.verdict`.
"""

from neorl.evidence import report
from neorl.evidence.marks import html, leads
from neorl.evidence.report import CALIBRATED, LETTER, NOT_COMPUTED
from neorl.evidence.statements import CLAIMS, STATEMENTS
from neorl.evidence.verdict import VERDICTS

SUPERPOSITION = ("A2", "A3", "A4", "A6", "A7", "A8", "A9", "B1", "B2", "B3", "B4", "B6", "T6", "T9")
SEPARATION = ("T1", "T7", "C1", "C2", "C3", "C4")
BEYOND = ("C5",)  # judged by the pages beyond the thesis
GROUND = tuple(name for name in CLAIMS if name not in SUPERPOSITION + SEPARATION + BEYOND)
CONCLUSIONS = {"Superposition": SUPERPOSITION, "Learning apart from behaviour": SEPARATION}
JUDGED_ONCE = "judged only in the calibrated reading"  # or alike in both
WITHOUT = {"no verdict": "without a verdict"}  # the form within a sentence
OTHER_VERDICTS = {"partly": "Partly: {}; the page of claims gives the details.",
                  "not testable": "Not testable, because the agents have not learned: {}.",
                  NOT_COMPUTED: "Not computed when this page was built: {}."}


def verdicts_by_reading(record):
    """The verdicts under both readings. record: as `neorl.evidence.report.load` returns it."""
    records = {LETTER: {**record, "claims": record["letter"]}, CALIBRATED: record}
    return {reading: {name: report.verdict(found, name) for name in CLAIMS} for reading, found in records.items()}


def in_short(verdicts):
    """Number of claims with each verdict, and how far each conclusion holds, in a few sentences of Markdown."""
    once = {name: JUDGED_ONCE for name in CLAIMS if verdicts[LETTER][name] == NOT_COMPUTED
            and verdicts[CALIBRATED][name] in VERDICTS}
    tallies = f"{LETTER}, {_tally(verdicts[LETTER] | once)}; {CALIBRATED}, {_tally(verdicts[CALIBRATED])}"
    held = " ".join(f"**{title}**: {_held(verdicts[CALIBRATED], names)}." for title, names in CONCLUSIONS.items())
    return (f"The book lists {len(CLAIMS)} claims of the thesis, each judged by a rule that was fixed before the "
            f"results: {tallies}. In the calibrated reading the two conclusions hold as follows. {held}")


def _tally(found):
    """Number of claims with each verdict, with its symbol: "● 6 reproduced, ◐ 11 partly"."""
    counts = {each: len(_with(each, found)) for each in (*VERDICTS, JUDGED_ONCE, NOT_COMPUTED)}
    return ", ".join(f"{_symbol(each)}{count} {WITHOUT.get(each, each)}" for each, count in counts.items() if count)


def _symbol(verdict):
    """The symbol of a verdict and a space, to stand before a number; "" for a verdict without one."""
    return f"{html(verdict)}\u00a0" if verdict != JUDGED_ONCE and leads(verdict) else ""


def overview(verdicts):
    """How far each conclusion holds under each reading, as a Markdown list."""
    lines = [f"**{title}**: " + "; ".join(f"{reading}, {_held(found, names)}" for reading, found in verdicts.items())
             + "." for title, names in CONCLUSIONS.items()]
    return ("A conclusion holds *in full* if all its claims are reproduced, *in part* if some are, and *not at all* if "
            "none is; but it is *undecided* if none is and some cannot be tested.\n\n"
            + "\n".join(f"- {line}" for line in lines))


def _held(found, names):
    """How far a conclusion that rests on the claims `names` holds: which are reproduced, or what became of all."""
    judged = [name for name in names if found[name] in VERDICTS and found[name] != "no verdict"]
    kept = [name for name in judged if found[name] == "reproduced"]
    if not judged:
        return "*without a verdict*"
    if not kept:
        counts = {verdict: [found[name] for name in judged].count(verdict) for verdict in VERDICTS}
        held = "undecided" if counts["not testable"] else "not at all"
        return f"*{held}* ({', '.join(f'{count} {verdict}' for verdict, count in counts.items() if count)})"
    return (f"*{'in full' if len(kept) == len(names) else 'in part'}* (reproduced: {', '.join(kept)}, of {len(judged)} "
            "claims judged)")


def both_verdicts(verdicts):
    """The verdicts on each claim under both readings, in Markdown: {name: text}."""
    said = {name: [_said(verdicts, reading, name) for reading in (CALIBRATED, LETTER)] for name in CLAIMS}
    return {name: f"*{calibrated}* in both readings" if calibrated == letter else
            f"*{calibrated}* in the calibrated reading, *{letter}* to the letter"
            for name, (calibrated, letter) in said.items()}


def _said(verdicts, reading, name):
    return WITHOUT.get(verdicts[reading][name], verdicts[reading][name])


def what_did_not_hold(record, verdicts):
    """Claims not reproduced, claims reproduced under only one reading, and all others, in Markdown.

    record: as `neorl.evidence.report.load` returns it.
    """
    calibrated = verdicts[CALIBRATED]
    said = [_not_reproduced(record, _with("not reproduced", calibrated)), _differences(verdicts)]
    said += [sentence.format(", ".join(_with(verdict, calibrated))) for verdict, sentence in OTHER_VERDICTS.items()
             if _with(verdict, calibrated)]
    shares = {name: share for name, share in record["shares"].items() if name in CLAIMS}
    if shares:
        said.append(_in_short_runs(shares))
    return "\n\n".join(said)


def _not_reproduced(record, names):
    if not names:
        return "No claim was judged not reproduced in the calibrated reading, on the pages computed so far."
    lines = [f"- **{name}** {STATEMENTS[name].text}. *{STATEMENTS[name].statistic}.* Thesis: "
             f"{STATEMENTS[name].thesis}; here: {report.number(record['claims'][name])}. "
             f"{record['claims'][name]['detail']}" for name in names]
    return "Not reproduced in the calibrated reading:\n\n" + "\n".join(lines)


def _differences(verdicts):
    """Which claims are reproduced under only one reading, of those judged under both."""
    calibrated, letter = verdicts[CALIBRATED], verdicts[LETTER]
    judged = [name for name in CLAIMS if calibrated[name] in VERDICTS and letter[name] in VERDICTS]
    differ = [name for name in judged if calibrated[name] != letter[name]]
    here, there = ([name for name in differ if found[name] == "reproduced"] for found in (calibrated, letter))
    return (f"Reproduced in the calibrated reading but not to the letter: {_listed(here)}; to the letter but not in "
            f"the calibrated reading: {_listed(there)}.")


def _in_short_runs(shares):
    """Claims that hold under no reading, and claims that are undecided under most."""
    never = [name for name, share in shares.items() if not share["holds"]]
    unclear = [name for name, share in shares.items() if share["undecided"] > share["readings"] / 2]
    verb = "was" if len(unclear) == 1 else "were"
    readings = sorted({share["readings"] for share in shares.values()})
    span = f"{readings[0]} to {readings[-1]}" if len(readings) > 1 else str(readings[0])
    return (f"In short runs under {span} readings within the text, {_listed(never)} held under none that could be "
            f"decided; {_listed(unclear)} {verb} undecided under more than half of them.")


def _with(verdict, found):
    return [name for name, each in found.items() if each == verdict]


def _listed(names):
    return ", ".join(names) or "none"
