"""The agent of the part beyond the thesis, as a value of `Agent`, like those of `neorl.agents.papers`."""

from collections.abc import Sequence

from neorl import checks
from neorl.agents.agent import LEARNED, Agent, Desire, Node
from neorl.agents.papers import paper_agent
from neorl.agents.rules import Contacts
from neorl.core.modality import Axis, Modality

FASTEST = 2.5  # of the velocities that are told apart, in sizes of the world per second


def foveated_cells(foveated: bool = True, velocity: bool = True, mirrored: bool = True) -> Modality:
    """Conjunctive cells of an object vector and the agent's velocity in the plane.

    foveated: whether receptive fields grow with distance. velocity: whether the cells know the agent's velocity.
    mirrored: whether mirror images share a cell. Ranges are twice as wide if not, so a map of 2N − 1 has the receptive
        fields that one of N has if so.
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
    """One node of foveated cells at several resolutions, whose goals are contacts.

    resolutions: integers ≥ 1 that grow. valence_green, valence_red: what a creep is worth, a number or "learned".
    contacts: how it learns.
    """
    return Agent([Node("OVC × V", foveated_cells(), resolutions, goals="contacts")],
                 [Desire("green", "OVC × V", valence_green), Desire("red", "OVC × V", valence_red)], contacts=contacts)
