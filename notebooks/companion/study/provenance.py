"""What the text fixes and leaves open, choice by choice, and the source of every other constant, as Markdown tables.

Values are read from the code that uses them, and sentences from `companion.thesis.pins`, so the tables agree with both.
"""

import re
from typing import NamedTuple

from companion.page import wording
from companion.thesis.pins import PINS
from companion.thesis.priors import BEYOND, WITHIN
from companion.shared.smoothing import CUTOFF_PERIODS, FILTER_ORDER
from companion.thesis.reading import LAYERS, LENGTHS, PRIMES, SINGLE, TO_THE_LETTER, Reading, conditions
from companion.thesis.statements import STATEMENTS
from neorl.experiments.bins import BIN_SECONDS
from neorl.worlds import waterworld

PLE = "WaterWorld of the PyGame Learning Environment, rules confirmed against recordings of it"
AUTHOR = "the author's later public code"
OURS = "this book's choice"


class Constant(NamedTuple):
    """One constant: its value in words, and its source."""

    name: str
    value: str
    source: str


def constants():
    """Every `Constant` on which a result of the book depends, beside the choices of a reading."""
    default = conditions(Reading(), max(LENGTHS.values()), 1)
    eight, three = default["layers"].world, default["both"].world
    return [
        Constant("side of the tank", f"{three.width} pixels", AUTHOR),
        Constant("radius of agent and creeps", f"{three.radius} pixels", PLE),
        Constant("acceleration of an action", "a quarter of the width per second, each step", PLE),
        Constant("drag", f"{waterworld.DRAG} per step", PLE),
        Constant("speed of creeps", "up to a quarter of the width per second", PLE),
        Constant("creeps, paper A", f"{eight.n_creeps}", "paper A, WaterWorld (and the author's later public code)"),
        Constant("creeps, papers B and C", f"{three.n_creeps}", "paper B, section 3, and paper C, section 2"),
        Constant("reward for the last green creep, paper A", f"{eight.win_reward:g}", "paper A, WaterWorld"),
        Constant("the same reward, papers B and C", f"{three.win_reward:g}", "paper B, section 3; " + AUTHOR),
        Constant("valence of creeps", "+1 and −1", "paper B, section 3, and paper C, section 2"),
        Constant("resolutions of single maps, paper A", _listed(SINGLE), "paper A, figure 6"),
        Constant("resolutions together, paper A", _listed(LAYERS), "paper A, Experiments"),
        Constant("resolutions, paper B", _listed(PRIMES), "paper B, section 3"),
        Constant("steps of a run, paper A", f"{LENGTHS['A']:,}", "paper A, Experiments"),
        Constant("steps of a run, papers B and C", f"{LENGTHS['B']:,} and {LENGTHS['C']:,}",
                 f"{OURS}: paper B speaks of more than {STATEMENTS['B4'].also['place cells'].number:g} minutes"),
        Constant("exploration of the control", "1", "paper A, Experiments"),
        Constant("bins of reward", f"{BIN_SECONDS} s", "paper B, section 3, and " + AUTHOR),
        Constant("filter of paper B's curves", f"Butterworth, order {FILTER_ORDER}, {CUTOFF_PERIODS} periods per run",
                 "paper B, section 3; order and cutoff are " + OURS),
    ]


def table():
    """The constants."""
    return wording.table(["Constant", "Value", "From"], constants())


def choices(matters):
    """Every choice: the sentence that bears on it, what it may be, its value in two readings, and what it matters for.

    matters: {name of a choice: names of claims}. A choice with several sentences has its values beside the last.
    """
    last = {name: pin for pin in PINS for name in pin.fields[:1]}
    rows = []
    for pin in PINS:
        name = next((name for name in pin.fields[:1] if last[name] is pin), None)
        about = f"“{pin.quotation}” ({pin.place})" if pin.quotation else "–"
        rows.append([_called(pin), f"{about}<details><summary>What follows</summary>{pin.follows}</details>",
                     *_values(pin, name), ", ".join(matters.get(name, ()))])
    head = ["Choice", "What the text says", "May be", "To the letter", "Calibrated", "Matters for"]
    raised = re.sub(r"\^(\w+)", r"<sup>\1</sup>", wording.table(head, rows))
    return re.sub(r"_(\w+)", r"<sub>\1</sub>", raised)


def _values(pin, name):
    """What a choice may be, and its value to the letter and calibrated, in words; "" beside a sentence more."""
    if name is None:
        return "pinned" if pin.status == "pinned" else "", "", ""
    choice, letter = BEYOND[name], TO_THE_LETTER.choices[name]
    prior = WITHIN[name].prior if name in WITHIN else ()
    ours = "" if isinstance(prior, tuple) or letter == prior.apart else " (*ours*)"
    fixed = "pinned" if pin.status == "pinned" else "open, not varied"
    return (WITHIN[name].stated if name in WITHIN else fixed, f"{choice.words(letter)}{ours}",
            choice.words(Reading().choices[name]))


def _called(pin):
    """The name of a choice, and those of the same choice in figures where they differ."""
    labels = [BEYOND[name].label for name in pin.fields if BEYOND[name].label != pin.choice]
    return pin.choice + (f" (*{'*, *'.join(labels)}*)" if labels else "")


def _listed(resolutions):
    return ", ".join(f"N{n}" for n in resolutions)
