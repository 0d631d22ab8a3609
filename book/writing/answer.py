"""The answer on the page of claims, but for its figure: what is reproduced, what decides, and what fails.

1. Verdicts are those of the record. Shares of readings, and the choices that decide, are from the table of readings
   that were run at the papers' lengths (`companion.study.sensitivity`).
2. Claims in a few words, and why some fail, are with their statements; all else is computed.
"""

import json

from companion.page import answers, counts, opening, recorded, report
from companion.page.wording import enumerated, table
from companion.study import sensitivity
from companion.study.calibration_targets import CLAIMS as FITTED
from companion.thesis.pins import PINS
from companion.thesis.priors import WITHIN
from companion.thesis.reading import TO_THE_LETTER
from companion.thesis.statements import AGENTS, CLAIMS, STATEMENTS
from companion.thesis.verdict import FAILED

from writing import base_rate
from writing.rules import BEFORE

NOT_FITTED = tuple(name for name in AGENTS if name not in FITTED)
INDEPENDENT = "A10", "T1", "T10", "T11"  # of these, whose rules read no condition that the search ran
BLOCKS = {f"{counts.KINDS['agents']}, by which the calibrated reading was chosen": FITTED,
          f"{counts.KINDS['agents']}, not used for that": NOT_FITTED,
          **counts.by_kind(name for name in STATEMENTS if name not in AGENTS)}
USUAL = 100  # runs, or more
DECIDING = 5  # choices that are listed
PULLING = 5  # pairs of claims
NEVER = "None of the readings drawn evenly within the text agrees."
REPRODUCED = "Claims", "Reproduced to the letter", "Reproduced calibrated"


def headline(record):
    """What is reproduced of the claims about agents, in a few sentences. record: see `report.record`."""
    letter, _ = counts.reproduced(record["letter"], AGENTS)
    calibrated, fitted, others, independent = (counts.reproduced(record["claims"], names)[0]
                                               for names in (AGENTS, FITTED, NOT_FITTED, INDEPENDENT))
    return (f"The thesis makes {len(AGENTS)} claims about its agents. With every gap of its text filled by the "
            f"plainest choice (“to the letter”), {letter} of them {'is' if letter == 1 else 'are'} reproduced; with "
            f"{answers.choices()['departing']} of the gaps filled otherwise, as fits best (“calibrated”), "
            f"{calibrated} are: {fitted} of the {len(FITTED)} by which these choices were made, and {others} of the "
            f"other {len(NOT_FITTED)}. Of these others only "
            f"{enumerated(INDEPENDENT)} rest on conditions that took no part in the choice "
            f"({independent} of {len(INDEPENDENT)}). {versions(record)} "
            f"{base_rate.finding(base_rate.read())} {runs(record)}")


def versions(record):
    """What the rules before their last change reproduced, and the range over both versions, in two sentences."""
    letter, calibrated = (_versions(record, part) for part in ("letter", "claims"))
    return (f"By the rules before their last change it was {letter[0]} to the letter and {calibrated[0]} calibrated. "
            f"An honest range is {letter[1]} to {letter[2]}, and {calibrated[1]} to {calibrated[2]}: from the claims "
            "that every version of their rule reproduces to those that any does, or that are undecided now.")


def _versions(record, part):
    """How many claims about agents are reproduced by the former rules, by all versions, and by any or perhaps."""
    former = {name: (each["present runs"] or each["earlier runs"])["verdict"]
              for name, each in json.loads(BEFORE.read_text(encoding="utf-8"))[part].items()}
    found = [(former.get(name), record[part].get(name, {}).get("verdict")) for name in AGENTS]
    return (sum(before == "reproduced" for before, _ in found),
            sum({*each} - {None} == {"reproduced"} for each in found),
            sum("reproduced" in each or each[1] == "undecided" for each in found))


def turned(record):
    """What agents do when red is wanted all at once, in a sentence; "" without it."""
    found = recorded.finding(record, "T1")
    return f"{found[0].upper()}{found[1:]}." if found else ""


def runs(record):
    """How many runs claims rest on, and which on fewer than usual, in a sentence; "" if none was judged."""
    fewer = {}
    for name, found in record["claims"].items():
        fewer.setdefault(found["runs"], []).append(name)
    usual = [fewer.pop(number) and number for number in sorted(fewer) if number >= USUAL]
    many = " to ".join(f"{number:,}" for number in sorted({*usual[:1], *usual[-1:]}))
    parts = [f"Claims rest on {many} runs of each condition, or more"] if usual else []
    parts += [f"{enumerated(names)} on {number}" for number, names in sorted(fewer.items())]
    return f"{'; '.join(parts)}." if parts else ""


def dependence(record, found):
    """What depends on what, in a sentence or two. found: `companion.study.sensitivity.Findings`."""
    shares = {name: _share(record, name) for name in FITTED if _share(record, name) >= 0}
    parts = []
    if shares:
        first, last = max(shares, key=shares.get), min(shares, key=shares.get)
        parts.append(f"Of readings drawn evenly within the text {100 * shares[first]:.0f}\u00a0% agree with "
                     f"{_link(first)}, the most robust of the claims used for the fit, and {100 * shares[last]:.0f}"
                     f"\u00a0% with {_link(last)}, the most fragile.")
    if deciding := _deciding(found):
        lost = enumerated([_link(name) for name in found.flips[deciding[0]].lost]) or "none"
        others = f"; next, on {enumerated([_called(name) for name in deciding[1:3]])}" if deciding[1:] else ""
        parts.append(f"Most depends on {_called(deciding[0])}: without its calibrated value, all else unchanged, "
                     f"{lost} would be lost{others}.")
    return " ".join([*parts, rate_of_paper_a(record)]).strip()


def rate_of_paper_a(record):
    """Which verdicts depend on paper A's steps per second, in a sentence; "" if a record has one rate alone."""
    if "paper A at 50" not in record:
        return ""
    other = {name: each for name, each in record["paper A at 50"].items()
             if each["verdict"] != report.verdict(record, name)}
    changed = enumerated([f"{_link(name)} would be {each['verdict']} ({report.number(each)})"
                       for name, each in other.items()]) or "no verdict would change"
    return ("Paper A runs at 30 steps per second in the calibrated reading, and papers B and C at 50: with 50 for all, "
            f"{changed}.")


def reproduced(record):
    """How many claims of each block are reproduced, of those that a reading judges: rows below `REPRODUCED`."""
    return [[title, *("{} of {}".format(*counts.reproduced(record[part], names)) for part in ("letter", "claims"))]
            for title, names in BLOCKS.items()]


def summary(record):
    """`reproduced` as an HTML table, which leads to the claims."""
    heads = "".join(f'<th scope="col">{head}</th>' for head in REPRODUCED)
    rows = "".join(f'<tr><th scope="row"><a href="claims.html">{title}</a></th>'
                   f"{''.join(f'<td>{cell}</td>' for cell in cells)}</tr>" for title, *cells in reproduced(record))
    return f'<table class="summary"><thead><tr>{heads}</tr></thead><tbody>{rows}</tbody></table>'


def decides(found):
    """The choices that flip most claims when they are set back to the letter, as a Markdown table; "" if none does."""
    pins = {name: pin for pin in PINS if pin.status == "open" for name in pin.fields}
    lines = []
    for name in _deciding(found)[:DECIDING]:
        pin, choice = pins[name], WITHIN[name]
        sentence = f"<br>“{pin.quotation}” ({pin.place})" if pin.quotation else ""
        lines.append([f"**{choice.label}**{sentence}", choice.words(TO_THE_LETTER.choices[name]),
                      choice.words(found.calibrated.reading.choices[name]),
                      *(", ".join(map(_link, each)) or "–" for each in found.flips[name])])
    return table(["Choice, and the sentence that leaves it open", "To the letter", "Calibrated", "Lost when set back",
                  "Gained"], lines) if lines else ""


def fails(record):
    """The claims that fail under both readings and must fail under others, as list items with reasons."""
    both = [name for name in CLAIMS if all(name in found and found[name]["verdict"] in FAILED
                                           for found in (record["claims"], record["letter"] or record["claims"]))]
    always = [name for name in CLAIMS if report.verdict(record, name) in FAILED
              and (STATEMENTS[name].why or name in both and _share(record, name) == 0)]
    lines = [f"- **{_link(name)}** {STATEMENTS[name].text}. {recorded.expected(name)}; here "
             f"{report.number(record['claims'][name])}. "
             f"{recorded.said(record['claims'][name], STATEMENTS[name].why or NEVER)}" for name in always]
    others = [_link(name) for name in both if name not in always]
    return "\n".join([*lines, f"\nContradicted under the two readings of the figure as well: {enumerated(others)}."
                      if others else ""])


def pull_apart(found):
    """The pairs of claims that agree together clearly less often than if they were independent, as list items."""
    return "\n".join(
        f"- **{_link(one)} and {_link(other)}:** {_lower(one)}; {_lower(other)}. Both agree in {both:,}, expected in "
        f"{expected:,.0f}."
        for one, other, both, expected in found.apart[:PULLING])


def sections(record, found):
    """What decides, what always fails, and what pulls apart, as Markdown with headings, those that have anything."""
    parts = {
        "What decides": (
            "Each row sets one choice of the calibrated reading back to the letter and runs the papers again. A claim "
            "is lost if its means no longer agree with the thesis, by more than two standard errors, and gained if "
            f"they come to agree. Of the {answers.choices()['departing']} choices that depart from the letter, "
            f"{len(found.flips)} were set back, in {_runs_set_back(found)} runs of each condition, fewer than the "
            f"record has; the table has the {DECIDING} that flip most claims. "
            "[All choices](chapters/assumptions.ipynb) are on the next page.",
            decides(found)),
        "Fails in any reading, and why": (
            "However the gaps are filled, these do not come out as stated.", fails(record)),
        "Which claims pull apart": (
            "These agree together less often than if they were independent, in all rows of the table of readings. "
            "Luck only adds agreements, so a pair that hardly ever agrees is strong evidence.", pull_apart(found))}
    return [part for title, (about, text) in parts.items() if text.strip() for part in (f"## {title}", about, text)]


def _runs_set_back(found):
    """The fewest and the most runs with which choices were set back, as text."""
    numbers = {row.runs for row in sensitivity.setbacks(found.table, found.calibrated.reading).values()} or {0}
    return " to ".join(map(str, sorted({min(numbers), max(numbers)})))


def _deciding(found):
    """The choices that flip claims, those that flip most first: a list of names."""
    return [name for name, each in found.flips.items() if any(each)]


def _share(record, name):
    """The share of evenly drawn readings that agree with a claim, −1 if it was not measured."""
    share = record["shares"].get(name, {})
    return share["agrees"] / share["measured"] if share.get("measured") else -1


def _link(name):
    return opening.link(name, page="")


def _lower(name):
    text = STATEMENTS[name].short
    return text if text[1].isdigit() or text.startswith("Q-") else text[0].lower() + text[1:]


def _called(choice):
    return f"*{WITHIN[choice].label.split(',')[0]}*"
