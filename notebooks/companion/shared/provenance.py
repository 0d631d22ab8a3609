"""The source of every constant: the thesis, the environment it used, the author's public code, or this book.

The values are read from the code that uses them, and the sources of a reading's choices from `companion.shared.pins`,
so the table always agrees with both.
"""

import re
from typing import NamedTuple

from companion.shared import wording
from companion.shared.pins import PINS
from companion.shared.priors import BEYOND, WITHIN
from companion.shared.smoothing import CUTOFF_PERIODS, FILTER_ORDER
from companion.thesis.reading import LAYERS, LENGTHS, PRIMES, SINGLE, Reading, conditions
from companion.thesis.statements import STATEMENTS
from neorl.experiments.run import BIN_SECONDS
from neorl.worlds import waterworld

PLE = "WaterWorld of the PyGame Learning Environment, rules confirmed against recordings of it"
AUTHOR = "the author's later public code"
OURS = "this book's choice"
CALIBRATED = "value by calibration"


class Constant(NamedTuple):
    """One constant: its value in words, and its source."""

    name: str
    value: str
    source: str


def constants():
    """Every `Constant` on which a result of the book depends."""
    default = conditions(Reading(), max(LENGTHS.values()), 1)
    eight, three = default["layers"].world, default["both"].world
    fixed = [
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
    return fixed + [Constant(choice.label, choice.words(Reading().choices[name]), source(name))
                    for name, choice in BEYOND.items()]


def source(name):
    """The source of the default of one of the `choices` of a `Reading`, in words."""
    places = []
    for pin in PINS:
        if pin.fields[:1] == (name,) and pin.place:
            if pin.status == "open":
                places.append(f"open in {pin.place}")
            else:
                places.append(pin.place if pin.allows(Reading()) else f"against {pin.place}")
    return "; ".join(dict.fromkeys([*places, CALIBRATED] if name in WITHIN else places))


def table():
    """The constants as a Markdown table."""
    return wording.table(["Constant", "Value", "From"], constants())


def of_pins(labels):
    """All pins as two Markdown tables, with other labels of fields, {field: name}."""
    parts = []
    for status in ("pinned", "open"):
        rows = [[_called(pin, labels), f"“{pin.quotation}” ({pin.place})" if pin.quotation else "–", pin.follows]
                for pin in PINS if pin.status == status]
        parts += [f"**{status.capitalize()}**", wording.table(["Choice", "What the text says", "What follows"], rows)]
    raised = re.sub(r"\^(\w+)", r"<sup>\1</sup>", "\n\n".join(parts))
    return re.sub(r"_(\w+)", r"<sub>\1</sub>", raised)


def _called(pin, labels):
    others = [labels[name] for name in pin.fields if labels.get(name, pin.choice) != pin.choice]
    return pin.choice + (f" (*{'*, *'.join(others)}*)" if others else "")


def _listed(resolutions):
    return ", ".join(f"N{n}" for n in resolutions)
