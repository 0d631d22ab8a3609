"""The agents of the thesis's papers, as values of `Agent`.

`choices` are other fields of `Agent` (learning, policy, own_cell, …) or, for all nodes, `weighting` of `Node` and
`tiled_fraction`: the central fraction of each axis's range that the maps of place cells divide into equal cells; values
beyond it belong to the outermost cells. `object_tiled_fraction` is that of object-vector cells; `object_state`,
`object_reach` and `object_beyond` are fields of their `Node`, and `object_centred` of its `Axis`. The defaults are
those of the calibrated reading, `CALIBRATED` and `GREEDY` of `neorl.agents.rules` among them; `TO_THE_LETTER` has those
of the reading to the letter: ``place_cells([5], **TO_THE_LETTER)``.

Every function raises ValueError for values that `Agent` and its parts refuse, and TypeError for an unknown choice.
"""

from collections.abc import Callable, Sequence
from dataclasses import fields, replace
from inspect import Parameter, signature
from typing import Any, TypeVar, get_type_hints

from neorl.agents import rules
from neorl.agents.agent import Agent, Desire, Node
from neorl.agents.rules import CALIBRATED, GREEDY, Learning, Policy
from neorl.common import checks
from neorl.core.modality import CARTESIAN_OBJECT_VECTOR_CELL, PLACE_CELL, Axis, Modality

Maker = TypeVar("Maker", bound=Callable[..., Agent])
LAYERS = (3, 7, 23)  # the resolutions of paper A's last experiment and of paper C
PRIMES = (2, 3, 5, 7, 11, 13)  # the resolutions of paper B
TILED_FRACTION = 1.0
OF_OBJECTS: dict[str, Any] = {"object_state": "per object", "object_reach": 0.0, "object_tiled_fraction": 0.5,
              "object_beyond": "none", "object_centred": False}
PLACE_GAIN, SCALE = 2.0, 36.16  # of place cells in paper B; of the desire vectors of paper C, in board widths
OF_NODES = ("weighting", "tiled_fraction", *OF_OBJECTS)  # choices that are no field of `Agent`
# `choices` of the reading to the letter, and the scale of its desire vectors. What the text prints or pins, and where
# it leaves more, the simplest or the middle of a prior, see `notebooks/companion/thesis/pins.toml`.
TO_THE_LETTER: dict[str, Any] = {
    "learning": rules.TO_THE_LETTER, "shared_cell": "once", "resets": "unnoticed", "weighting": "resolution",
    "object_state": "self", "object_reach": 0.0, "object_tiled_fraction": 1.0, "object_beyond": "outermost",
    "object_centred": False}
LITERAL_SCALE = 10.0
CHOICES = (*OF_NODES, *(each.name for each in fields(Agent)[2:]))
HINTS = get_type_hints(Agent)


def paper_agent(function: Maker) -> Maker:
    """Mark a function as one that a file may name to describe an agent (`neorl.description`)."""
    own = list(signature(function).parameters.values())
    names = [each.name for each in own if each.kind is not Parameter.VAR_KEYWORD]
    names += CHOICES if len(names) < len(own) else ()
    made: Any = function
    made.makes, made.takes = Agent, {name: (HINTS.get(name, object), None) for name in names}
    return function


@paper_agent
def place_cells(resolutions: Sequence[int] = PRIMES, valence_green: float = 1.0,
                valence_red: float = -1.0, **choices: Any) -> Agent:
    """The agent of paper A, and PC of paper B: one node of place cells that desires green creeps and fears red ones.

    resolutions: integers ≥ 1. valence_green, valence_red: of a creep, numbers. choices: see the module.
    """
    return _network([("PC", PLACE_CELL, 1.0)], resolutions, _creeps("PC", valence_green, valence_red), choices)


@paper_agent
def brownian() -> Agent:
    """The control: every action is random (ε = 1), so the agent performs Brownian motion (paper A, fig. 6).

    It has one cell and no desire, and acts in any world.
    """
    return Agent([Node("PC", Modality("place cell", [Axis("position")]), [1])], policy=Policy(exploration=1.0))


@paper_agent
def object_vector_cells(resolutions: Sequence[int] = PRIMES, valence_green: float = 1.0,
                        valence_red: float = -1.0, **choices: Any) -> Agent:
    """OVC of paper B (fig. 4B): one node of object-vector cells in the Cartesian emulation.

    resolutions, valence_green, valence_red, choices: as in `place_cells`.
    """
    desires = _creeps("OVC", valence_green, valence_red)
    return _network([("OVC", CARTESIAN_OBJECT_VECTOR_CELL, 1.0)], resolutions, desires, choices)


@paper_agent
def multimodal(resolutions: Sequence[int] = PRIMES, place_gain: float = PLACE_GAIN, object_gain: float = 1.0,
               **choices: Any) -> Agent:
    """PC + OVC of paper B (fig. 5): both nodes desire the creeps, and their values add.

    resolutions, choices: as in `place_cells`. place_gain, object_gain: the gains of the two nodes.
    """
    return _network(_both(place_gain, object_gain), resolutions, _creeps("PC") + _creeps("OVC"), choices)


@paper_agent
def network_a(resolutions: Sequence[int] = LAYERS, scale: float = SCALE, signed: bool = False,
              **choices: Any) -> Agent:
    """Agent A of paper C (fig. 4a): place cells merge all creeps into one desire, on which object-vector cells act.

    resolutions, choices: as in `place_cells`. scale, signed: of the desire between the nodes, see `Desire`.
    """
    desires = (Desire("PC", "OVC", scale=scale, signed=signed),)
    return _network(_both(0.0, 1.0), resolutions, _creeps("PC") + desires, choices)


@paper_agent
def network_b(resolutions: Sequence[int] = LAYERS, scale: float = SCALE, signed: bool = False,
              **choices: Any) -> Agent:
    """Agent B of paper C (fig. 4b): one desire for the green creeps, and one for the red.

    resolutions, scale, signed, choices: as in `network_a`.
    """
    return network_c(resolutions, scale, signed, place_gain=0.0, **choices)


@paper_agent
def network_c(resolutions: Sequence[int] = LAYERS, scale: float = SCALE, signed: bool = False,
              place_gain: float = 1.0, object_gain: float = 1.0, **choices: Any) -> Agent:
    """Agent C of paper C (fig. 4c): as B, and the values of both nodes add.

    resolutions, scale, signed, choices: as in `network_a`. place_gain, object_gain: the gains of the two nodes.
    """
    desires = tuple(Desire("PC", "OVC", of=(colour,), scale=scale, signed=signed) for colour in ("green", "red"))
    return _network(_both(place_gain, object_gain), resolutions, _creeps("PC") + desires, choices)


@paper_agent
def network_d(resolutions: Sequence[int] = LAYERS, recursion: float = -1.0, scale: float = SCALE,
              signed: bool = False, place_gain: float = 1.0, object_gain: float = 1.0, **choices: Any) -> Agent:
    """Agent D of paper C (fig. 4d): as C, and object-vector cells receive their own previous desire, with valence r.

    recursion: r, a finite number, which is negative in the thesis.
    resolutions, scale, signed, place_gain, object_gain, choices: as in `network_c`.
    Raises ValueError for anything else.
    """
    without = network_c(resolutions, scale, signed, place_gain, object_gain, **choices)
    recurring = Desire("OVC", "OVC", valence=checks.real("recursion", recursion), scale=scale, signed=signed)
    return replace(without, desires=(*without.desires, recurring))


def _both(place_gain, object_gain):
    return [("PC", PLACE_CELL, checks.real("place_gain", place_gain)),
            ("OVC", CARTESIAN_OBJECT_VECTOR_CELL, checks.real("object_gain", object_gain))]


def _creeps(node, valence_green=1.0, valence_red=-1.0):
    for name, valence in (("valence_green", valence_green), ("valence_red", valence_red)):
        if not isinstance(valence, str):  # it may be learned
            checks.real(name, valence)
    return Desire("green", node, valence_green), Desire("red", node, valence_red)


def _network(nodes, resolutions, desires, choices):
    for name in set(choices) - set(CHOICES):
        of = next((f", it is a field of {kind.__name__}: {field}={kind.__name__}({name}=…)"
                   for field, kind in (("learning", Learning), ("policy", Policy))
                   if name in (each.name for each in fields(kind))), "")
        raise TypeError(f"{name} must be a choice of this agent, {checks.either(CHOICES)}, but is not{of}")
    weighting = choices.pop("weighting", Node.weighting)
    tiled_fraction = checks.positive("tiled_fraction", choices.pop("tiled_fraction", TILED_FRACTION))
    own = {name.removeprefix("object_"): choices.pop(name, value) for name, value in OF_OBJECTS.items()}
    centred = checks.flag("object_centred", own.pop("centred"))
    of_objects = checks.positive("object_tiled_fraction", own.pop("tiled_fraction"))
    nodes = tuple(Node(name, _covering(tiled_fraction, modality), resolutions, weighting, gain)
                  if modality is PLACE_CELL else
                  Node(name, _covering(of_objects, modality, centred), resolutions, weighting, gain, **own)
                  for name, modality, gain in nodes)
    return Agent(nodes, desires, **{"learning": CALIBRATED, "policy": GREEDY} | choices)


def _covering(share, modality, centred=False):
    """The modality with the ranges of its axes reduced to their central fraction `share`, and `centred`."""
    margin = (1 - share) / 2
    cut = [margin * (axis.high - axis.low) for axis in modality.axes]
    return replace(modality, axes=[replace(axis, low=axis.low + each, high=axis.high - each, centred=centred)
                                   for axis, each in zip(modality.axes, cut)])
