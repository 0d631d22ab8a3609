"""The answer on the page of claims: three sentences, a figure with a row for each claim, what decides, and what fails.

1. Verdicts are those of the record. Shares of readings, and the choices that decide, are from the table of readings
   that were run at the papers' lengths (`companion.study.sensitivity`).
2. `answers.toml` has each claim in a few words, and why some fail; all else is computed.
"""

import tomllib
from collections import Counter
from html import escape
from pathlib import Path

from companion.page import marks, opening, report
from companion.page.opening import anchor
from companion.page.wording import table
from companion.study import sensitivity
from companion.study.calibration_targets import CLAIMS as FITTED
from companion.thesis.pins import PINS
from companion.thesis.priors import WITHIN
from companion.thesis.reading import TO_THE_LETTER, Reading
from companion.thesis.statements import AGENTS, APART, CLAIMS, STATEMENTS
from companion.thesis.verdict import FAILED, RUNS_FOR_A_VERDICT

ANSWERS = tomllib.loads((Path(__file__).parents[1] / "answers.toml").read_text(encoding="utf-8"))
NOT_FITTED = tuple(name for name in AGENTS if name not in FITTED)
BLOCKS = {"Used to choose the calibrated reading": FITTED, "Not used": NOT_FITTED,
          "By proof or counting, about our code, or a report": APART}
DECIDING = 5  # choices that are listed
PULLING = 5  # pairs of claims
NEVER = "None of the readings drawn evenly within the text agrees."
CAPTION = ("Bars: the share of readings, drawn evenly within the text and run twice at the papers’ lengths, in which "
           "the means agree with the thesis; they were counted for the claims used for the fit. A claim leads to its "
           "line below.")


def headline(record):
    """What is reproduced, to the letter and calibrated, in two sentences. record: see `report.load`, or committed."""
    if not {report.verdict(record, name) for name in AGENTS} - {"no verdict", report.NOT_COMPUTED}:
        return (f"This book judges the thesis’s {len(AGENTS)} claims about agents. Verdicts need {RUNS_FOR_A_VERDICT} "
                "runs of each condition, and this build has fewer.")
    letter, calibrated = (_reproduced(record[part], AGENTS) for part in ("letter", "claims"))
    return (f"With every gap of the text filled by what it prints, or by the simplest value (“to the letter”), "
            f"{letter} of the thesis’s {len(AGENTS)} claims about agents {'is' if letter == 1 else 'are'} reproduced "
            f"({runs(record)} runs of each condition). With {_departing()} of the {len(WITHIN)} gaps filled by other "
            f"values, which fit best (“calibrated”), {calibrated} are: {_reproduced(record['claims'], FITTED)} of the "
            f"{len(FITTED)} claims that were used for the fit, and {_reproduced(record['claims'], NOT_FITTED)} of the "
            f"other {len(NOT_FITTED)}.")


def runs(record):
    """The number of runs behind claims about agents that are run, "10" or "100 to 1,000", "0" if none was judged."""
    numbers = {record["claims"][name]["runs"] for name in AGENTS if name in record["claims"] and name != "A10"} or {0}
    return " to ".join(f"{number:,}" for number in sorted({min(numbers), max(numbers)}))


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
        lost = _listed([_link(name) for name in found.flips[deciding[0]].lost]) or "none"
        others = f"; next, on {_listed([_called(name) for name in deciding[1:3]])}" if deciding[1:] else ""
        parts.append(f"Most depends on {_called(deciding[0])}: without its calibrated value, all else unchanged, "
                     f"{lost} would be lost{others}.")
    return " ".join([*parts, rate_of_paper_a(record)]).strip()


def rate_of_paper_a(record):
    """Which verdicts depend on paper A's steps per second, in a sentence; "" if a record has one rate alone."""
    if "paper A at 50" not in record:
        return ""
    other = {name: each for name, each in record["paper A at 50"].items()
             if each["verdict"] != report.verdict(record, name)}
    changed = _listed([f"{_link(name)} would be {each['verdict']} ({report.number(each)})"
                       for name, each in other.items()]) or "no verdict would change"
    return ("Paper A runs at 30 steps per second in the calibrated reading, and papers B and C at 50: with 50 for all, "
            f"{changed}.")


def figure(record):
    """A row for each claim in three blocks, as an HTML table: the share of readings that agree, and two verdicts."""
    heads = "".join(f'<th scope="col">{head}</th>' for head in ("Claim", "Readings that agree", "To the letter",
                                                                "Calibrated"))
    parts = [f'<table class="answer"><thead><tr>{heads}</tr></thead>']
    for title, names in BLOCKS.items():
        ordered = sorted(names, key=lambda name: -_share(record, name)) if names is FITTED else names
        rows = "".join(_row(record, name) for name in ordered)
        parts.append(f'<tbody><tr><th colspan="4" scope="rowgroup">{title}</th></tr>{rows}</tbody>')
    return "".join([*parts, "</table>"])


def summary(record):
    """The figure, small: in each block the verdicts of its claims as symbols, under both readings, as an HTML table."""
    heads = "".join(f'<th scope="col">{head}</th>' for head in ("Claims", "To the letter", "Calibrated"))
    rows = []
    for title, names in BLOCKS.items():
        cells = []
        for found in (record["letter"], record["claims"]):
            count = counts({"claims": found}, [name for name in names if name in found])
            symbols = "".join(f'<span class="{marks.MARKS[each].css}">{marks.symbol(each) * count[each]}</span>'
                              for each in count)
            words = ", ".join(f"{number} {verdict}" for verdict, number in count.items())
            shown = f'<span role="img" aria-label="{words}" title="{words}">{symbols}</span>' if count else ""
            cells.append(f"<td>{shown}</td>")
        rows.append(f'<tr><th scope="row"><a href="claims.html">{title}</a></th>{"".join(cells)}</tr>')
    return f'<table class="summary"><thead><tr>{heads}</tr></thead><tbody>{"".join(rows)}</tbody></table>'


def counts(record, names):
    """The number of some claims with each verdict: {verdict: count}, without verdicts that none has."""
    found = Counter(report.verdict(record, name) for name in names)
    return {verdict: found[verdict] for verdict in marks.MARKS if found[verdict]}


def _row(record, name):
    share, cell = _share(record, name), ""
    if share >= 0:
        count = record["shares"][name]
        title = f"{count['agrees']} of {count['measured']} readings"
        cell = (f'<span class="bar" title="{title}"><span style="width:{100 * share:.0f}%"></span></span>'
                f"<span>{100 * share:.0f}\u00a0%</span>")
    verdicts = [marks.html(found[name]["verdict"]) if name in found else ""
                for found in (record["letter"], record["claims"])]
    return (f'<tr><th scope="row"><a href="#{anchor(name)}"><b>{name}</b> {escape(ANSWERS["short"][name])}</a></th>'
            f'<td class="share">{cell}</td>{"".join(f"<td>{verdict}</td>" for verdict in verdicts)}</tr>')


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
              and (name in ANSWERS["why"] or name in both and _share(record, name) == 0)]
    lines = [f"- **{_link(name)}** {STATEMENTS[name].text}. Thesis: {STATEMENTS[name].thesis}; here "
             f"{report.number(record['claims'][name])}. {ANSWERS['why'].get(name, NEVER)}" for name in always]
    others = [_link(name) for name in both if name not in always]
    return "\n".join([*lines, f"\nContradicted under the two readings of the figure as well: {_listed(others)}."
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
            f"they come to agree. Of the {_departing()} choices that depart from the letter, {len(found.flips)} were "
            f"set back, in {_runs_set_back(found)} runs of each condition, fewer than the record has. "
            "[All choices](chapters/assumptions.ipynb) are on the next page.", decides(found)),
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


def _departing():
    """The number of open choices in which the calibrated reading departs from the letter."""
    return sum(Reading().choices[name] != TO_THE_LETTER.choices[name] for name in WITHIN)


def _deciding(found):
    """The choices that flip claims, those that flip most first: a list of names."""
    return [name for name, each in found.flips.items() if any(each)]


def _share(record, name):
    """The share of evenly drawn readings that agree with a claim, −1 if it was not measured."""
    share = record["shares"].get(name, {})
    return share["agrees"] / share["measured"] if share.get("measured") else -1


def _reproduced(found, names):
    return sum(found[name]["verdict"] == "reproduced" for name in names if name in found)


def _link(name):
    return opening.link(name, page="")


def _lower(name):
    text = ANSWERS["short"][name]
    return text if text[1].isdigit() or text.startswith("Q-") else text[0].lower() + text[1:]


def _called(choice):
    return f"*{WITHIN[choice].label.split(',')[0]}*"


def _listed(words):
    if not words:
        return ""

    *first, last = words
    return f"{', '.join(first)} and {last}" if first else last
