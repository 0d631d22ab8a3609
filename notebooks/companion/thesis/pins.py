"""What the text of the thesis fixes, sentence by sentence, and what it leaves open.

1. A `Pin` is one choice in building the agents, with the sentence of the thesis that bears on it.
2. A choice is *pinned* if the sentence excludes a value, which a `companion.thesis.reading.Reading` then may not have,
   or if it is the same in every reading. Otherwise it is *open*, also if there is no such sentence.
3. A choice pinned by several sentences has several pins, and a reading has to obey all of them.
4. Only the text decides. Pins are written down before the readings that they judge are run. The first list pinned or
   omitted some choices that the text leaves open: the state of an object-vector map, how ties are broken, what memory
   holds, and the valence and the unit of a desire vector. This list replaced it before the present calibration.

They are data, in `pins.toml`.
"""

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from importlib import resources


@dataclass(frozen=True)
class Pin:
    """One choice, and the sentence of the thesis that bears on it; `pins.toml` says what its fields are."""

    choice: str
    follows: str
    fields: Sequence[str] = ()
    quotation: str = ""
    place: str = ""
    only: Mapping = field(default_factory=dict)
    excludes: Mapping = field(default_factory=dict)

    @property
    def status(self):
        """ "pinned" or "open"."""
        return "pinned" if self.only or self.excludes or not self.fields else "open"

    def allows(self, reading):
        """Whether a reading obeys the sentence."""
        made = reading.choices
        return (all(made[name] in values for name, values in self.only.items())
                and not any(made[name] in values for name, values in self.excludes.items()))


def broken(reading):
    """The pins that a `Reading` breaks: a list, empty if it is within the text."""
    return [pin for pin in PINS if not pin.allows(reading)]


def in_words(reading):
    """That a reading is within the text, or the sentences that it breaks."""
    return "; ".join(f"{pin.choice}: “{pin.quotation}” ({pin.place})" for pin in broken(reading)) or "within the text"


PINS = tuple(Pin(choice, **entry) for choice, entry in
             tomllib.loads((resources.files(__package__) / "pins.toml").read_text("utf-8")).items())
