"""Kinds of cells that represent places, objects and directions, as defined by the modalities of this book.

`THESIS` is the thesis's table 2.1, after Bicanski and Burgess (2020): whether the locality and the direction of a
kind are allocentric, a distance or neither, and what the kind concerns.
"""

from lib.shared import wording
from neorl.core.modality import CARTESIAN_OBJECT_VECTOR_CELL, MODALITIES

THESIS = {
    "head-direction cell": ("–", "allocentric", "head direction"),
    "place cell": ("allocentric", "–", "agent position"),
    "border cell": ("allocentric", "–", "location of borders"),
    "boundary-vector cell": ("[distance]", "allocentric", "location of boundaries"),
    "object-vector cell": ("[distance]", "allocentric", "location of objects"),
    "landmark-vector cell": ("[distance]", "allocentric", "location of landmarks"),
}
CONCERNS = {("position", "margin"): "location of borders", ("position", "component"): "agent position",
            ("velocity", "direction"): "head direction", ("velocity", "length"): "agent speed"}


def kinds():
    """These entries for each modality: {kind: (locality, direction, concern)}, without the emulation of paper B."""
    return {each.name: (_locality(each), "allocentric" if "direction" in each.names else "–",
                        CONCERNS.get((each.follows, each.axes[0].feature), f"location of {each.follows}"))
            for each in MODALITIES if each != CARTESIAN_OBJECT_VECTOR_CELL}


def as_in_thesis(found):
    """The number of kinds of `THESIS` with the same three entries in `found`. found: as returned by `kinds`."""
    return sum(found.get(kind) == entries for kind, entries in THESIS.items())


def kinds_table(found):
    """The kinds as a Markdown table. found: as returned by `kinds`."""
    return wording.table(["Cell", "Locality", "Direction", "Concern"],
                         [[kind, *entries] for kind, entries in found.items()])


def _locality(modality):
    if modality.follows == "position":
        return "allocentric"
    return "[distance]" if "distance" in modality.names else "–"
