"""Specification curves of claims as inline SVG: a claim's numbers under evenly drawn readings, sorted, a panel each.

Each point is a reading, a filled one where the number agrees with the thesis; dashed lines are the ends of what agrees.
Beside them stand the calibrated reading and the one to the letter. A number beyond the middle 95 % is at the edge.
"""

from html import escape

import numpy as np
from companion.study import sensitivity
from companion.study.calibration_targets import TARGETS

WIDTH, HEIGHT, LEFT, RIGHT, ABOVE = 360, 96, 42, 62, 6  # units of the drawing, about a pixel of a phone each
LETTERS = 11  # the least distance between lines of text


def panels(found, claim):
    """The specification curves of a claim, as HTML, "" if it was not varied. found: `sensitivity.Findings`."""
    names = [name for name, target in TARGETS.items() if target.claim == claim]
    rows = sensitivity.drawn(found.table, claim) if names else []
    if not rows:
        return ""
    readings = {"calibrated": found.calibrated, "letter": found.letter}
    drawn = []
    for name in names:
        marked = {label: row.statistics[name].value for label, row in readings.items() if row}
        drawn.append(_panel(name, np.sort([row.statistics[name].value for row in rows]), marked))
    return f'<div class="curves">{"".join(drawn)}</div>'


def _panel(name, values, marked):
    target = TARGETS[name]
    ends = [end for end in (target.low, target.high) if np.isfinite(end)]
    shown = [*np.quantile(values, [0.025, 0.975]), *ends, *marked.values()]
    low, high = min(shown), max(shown)
    high += high == low

    def up(value):
        return round(HEIGHT - ABOVE - (HEIGHT - 2 * ABOVE) * (min(max(value, low), high) - low) / (high - low), 1)

    across = LEFT + (np.arange(len(values)) + 0.5) * (WIDTH - LEFT - RIGHT) / len(values)
    points = {held: "".join(f"M{x:.0f} {up(value)}h0" for x, value in zip(across, values)
                            if target.holds(value) == held) for held in (True, False)}
    lines = "".join(f'<path class="end" d="M{LEFT} {up(end)}H{WIDTH - RIGHT}"/>' for end in ends)
    scale = "".join(_text(LEFT - 4, place, _number(value), "end") for value, place in _apart({
        value: up(value) for value in (low, high, *ends)}, (low, high)).items())
    names = "".join(f'<path class="mark" d="M{WIDTH - RIGHT} {up(marked[label])}h5"/>'
                    + _text(WIDTH - RIGHT + 7, place, label, "start")
                    for label, place in _spread({label: up(value) for label, value in marked.items()}).items())
    agree = sum(map(target.holds, values))
    title = f"{target.label[0].upper()}{target.label[1:]}: {agree} of {len(values)} readings agree"
    return (f'<figure><figcaption>{escape(title)}</figcaption><svg viewBox="0 0 {WIDTH} {HEIGHT}" role="img" '
            f'aria-label="{escape(title)}, their numbers in order">{lines}<path class="out" d="{points[False]}"/>'
            f'<path class="in" d="{points[True]}"/>{scale}{names}</svg></figure>')


def _text(x, y, text, anchor):
    return f'<text x="{x}" y="{y}" dy="0.35em" text-anchor="{anchor}">{escape(text)}</text>'


def _number(value):
    return f"{value:.2g}".replace("-", "−") if abs(value) < 100 else f"{value:.0f}".replace("-", "−")


def _apart(places, last):
    """Places of numbers on the scale, {number: place}, without those that would cover another; `last` yield."""
    kept = {}
    for value in sorted(places, key=lambda value: value in last):
        if all(abs(places[value] - place) >= LETTERS for place in kept.values()):
            kept[value] = places[value]
    return kept


def _spread(places):
    """Places of names, moved apart where one would cover another."""
    (first, upper), *rest = sorted(places.items(), key=lambda item: item[1])
    return {first: upper} | {name: max(place, upper + LETTERS) for name, place in rest}
