"""What a reading drawn at random reproduces, beside the calibrated one and the one to the letter: a histogram as SVG.

All numbers are from the stored table of `companion.study.base_rate`.
"""

import numpy as np
from companion.study.base_rate import DRAWN, RUNS, agreeing, read
from companion.study.calibration_targets import CLAIMS as FITTED
from companion.thesis.reading import NAMES
from companion.thesis.statements import AGENTS

WIDTH, HEIGHT = 420, 130  # of the bars, in units of the drawing
RIGHT, SCALE, ROW = 80, 28, 16  # beside them, for names; below them, and for each marked reading


def finding(rows):
    """What a random reading, the one to the letter and the calibrated one agree with, in a sentence."""
    found, claims = agreeing(rows)
    low, middle, high = np.quantile(found[DRAWN], [0.025, 0.5, 0.975], method="inverted_cdf")
    marked = ", and ".join(
        f"{_words(kind)} with {found[kind].mean():.3g}, more than {_share(found, kind)} of those drawn"
        for kind in ("letter", "calibrated"))
    return (f"Of {claims} claims about agents a reading drawn at random agrees with {middle} [{low}, {high}]; "
            f"{marked}.")


def section(rows=None):
    """The histogram and its caption, which ends in the finding, in MyST Markdown. rows: by default the stored ones."""
    rows = rows or read()
    found, claims = agreeing(rows)
    others, left = agreeing(rows, [name for name in AGENTS if name not in FITTED])
    return (f"{_histogram(found, claims)}\n\nHow many claims does a reading agree with by chance? Bars: "
            f"{len(found[DRAWN])} readings drawn evenly within the text, by the number of claims with which they "
            "agree. Marks: the calibrated reading and the one to the letter, repeated "
            f"{len(found['letter'])} times with other seeds, the mean and the least and greatest number. All have "
            f"{RUNS} runs of each condition, which give no verdicts: a claim agrees if every number that its rule asks "
            "for is within its bounds, whatever the interval. The calibrated reading was chosen by some of these "
            f"claims; of the {left} others a random reading agrees with {others[DRAWN].mean():.2g} on average, and "
            f"the calibrated one with {others['calibrated'].mean():.2g}. {finding(rows)}")


def _words(kind):
    return f"the reading {NAMES[kind]}" if kind == "letter" else f"the {NAMES[kind]} one"


def _share(found, kind):
    """How many of the draws agree with fewer claims than a reading does on average, in words."""
    share = (found[DRAWN] < found[kind].mean()).mean()
    return "all" if share == 1 else f"{100 * share:.0f}\u00a0%"


def _histogram(found, claims):
    step, number = WIDTH / (claims + 1), np.bincount(found[DRAWN], minlength=claims + 1)
    height = HEIGHT / number.max()

    def across(count):
        return f"{step * (count + 0.5):.1f}"

    bars = "".join(f'<rect x="{step * (count + 0.1):.1f}" y="{HEIGHT - height * each:.1f}" width="{0.8 * step:.1f}" '
                   f'height="{height * each:.1f}"/>' for count, each in enumerate(number) if each)
    scale = "".join(f'<text x="{across(count)}" y="{HEIGHT + 14}">{count}</text>' for count in range(0, claims + 1, 5))
    marks = ""
    for row, kind in enumerate(("letter", "calibrated")):
        y, of_kind = HEIGHT + SCALE + ROW * row, found[kind]
        marks += (f'<g class="{kind}"><path d="M{across(of_kind.min())} {y}H{across(of_kind.max())}"/>'
                  f'<circle cx="{across(of_kind.mean())}" cy="{y}" r="4"/>'
                  f'<text x="{float(across(of_kind.max())) + 8}" y="{y}" dy="0.35em">{NAMES[kind]}</text></g>')
    title = f"Readings drawn at random, by the number of claims of {claims} with which they agree"
    return (f'<div class="recorded"><svg class="base-rate" viewBox="0 0 {WIDTH + RIGHT} {HEIGHT + SCALE + 2 * ROW}" '
            f'role="img" aria-label="{title}">{bars}{scale}{marks}</svg></div>')
