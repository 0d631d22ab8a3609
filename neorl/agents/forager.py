"""The agent that goes beyond the thesis, as a value of `Agent`, like those of `neorl.agents.papers`."""

from collections.abc import Sequence
from typing import Any

from neorl.agents.agent import LEARNED, Agent, Desire, Node
from neorl.agents.papers import paper_agent
from neorl.agents.rules import GREEDY, Contacts
from neorl.core.modality import Axis, Modality

FASTEST = 2.5  # highest speed along an axis that cells resolve, in sizes of the world per second
# Mirrored cells of an object vector, with fields that grow with distance, and of the agent's velocity in the plane.
FOVEATED_CELL = Modality("foveated object-vector cell", [
    *(Axis("objects", "foveated", along) for along in (0, 1)),
    *(Axis("velocity", "component", along, -FASTEST, FASTEST) for along in (0, 1))], mirrored=True)

# For WaterWorld, where a push adds a quarter of the board's width per second to the velocity: values of after-states, a
# look ahead, and maps so many that some field is of the right size wherever a creep is.
AFTER_STATES: dict[str, Any] = {
    "resolutions": (4, 5, 6, 7, 9, 11, 13, 15, 18, 22, 26, 31),
    "contacts": Contacts(familiarity=30.0, rivals=0.3, efference=0.25, lookahead=2)}


@paper_agent
def forager(resolutions: Sequence[int] = (5, 9, 15, 25), valence_green: float | str = LEARNED,
            valence_red: float | str = LEARNED, contacts: Contacts = Contacts()) -> Agent:
    """One node of foveated cells at several resolutions, with contacts as goals.

    resolutions: increasing integers ≥ 1. valence_green, valence_red: of a creep, a number or "learned".
    contacts: how it learns, a `Contacts`. Raises ValueError for anything else.

    ``forager(**AFTER_STATES)`` earns more in WaterWorld. It supposes that the agent knows what its own push does to its
    velocity, see `Contacts.efference`, and what this does to its position, see `Contacts.lookahead`.
    """
    return Agent([Node("OVC × V", FOVEATED_CELL, resolutions, goals="contacts")],
                 [Desire("green", "OVC × V", valence_green), Desire("red", "OVC × V", valence_red)], policy=GREEDY,
                 contacts=contacts)
