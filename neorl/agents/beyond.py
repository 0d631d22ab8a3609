"""The agent that goes beyond the thesis, as a value of `Agent`, like those of `neorl.agents.papers`."""

from collections.abc import Sequence

from neorl import checks
from neorl.agents.agent import LEARNED, Agent, Desire, Node
from neorl.agents.papers import paper_agent
from neorl.agents.rules import GREEDY, Contacts
from neorl.core.modality import Axis, Modality

FASTEST = 2.5  # highest speed along an axis that cells resolve, in sizes of the world per second


def foveated_cells(foveated: bool = True, velocity: bool = True, mirrored: bool = True) -> Modality:
    """Conjunctive cells of an object vector and the agent's velocity in the plane.

    foveated: whether receptive fields grow with distance. velocity: whether cells are also tuned to the velocity.
    mirrored: whether mirror images share a cell. If not, ranges are twice as wide, so that a map of 2N − 1 has the
        receptive fields of a mirrored map of N.
    Raises ValueError for anything but flags.
    """
    foveated, velocity = checks.flag("foveated", foveated), checks.flag("velocity", velocity)
    mirrored = checks.flag("mirrored", mirrored)
    feature, low = ("foveated" if foveated else "component"), (0.0 if mirrored else -1.0)
    reach = FASTEST if mirrored else 2 * FASTEST
    axes = [Axis("objects", feature, along, low, 1.0) for along in (0, 1)]
    axes += [Axis("velocity", "component", along, -reach, reach) for along in (0, 1)] if velocity else []
    return Modality("foveated object-vector cell", axes, mirrored=mirrored)


@paper_agent
def forager(resolutions: Sequence[int] = (5, 9, 15, 25), valence_green: float | str = LEARNED,
            valence_red: float | str = LEARNED, contacts: Contacts = Contacts()) -> Agent:
    """One node of foveated cells at several resolutions, with contacts as goals.

    resolutions: increasing integers ≥ 1. valence_green, valence_red: of a creep, a number or "learned".
    contacts: how it learns, a `Contacts`. Raises ValueError for anything else.
    """
    return Agent([Node("OVC × V", foveated_cells(), resolutions, goals="contacts")],
                 [Desire("green", "OVC × V", valence_green), Desire("red", "OVC × V", valence_red)], policy=GREEDY,
                 contacts=contacts)
