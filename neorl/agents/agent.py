"""A neoRL agent as data: a network of nodes, their desires, and the rules by which they learn and choose actions.

A *node* holds the maps of one modality at several resolutions (paper C, section 1 and figure 3). *Desires* are the
edges of the network. Each gives one node elements of interest: the things of one kind, a place, a point of the node's
own space, or the desire vector of another node, or of the node itself one step earlier. An agent is independent of any
world; kinds are matched by name when it enters one. Everything the thesis leaves open is a field, as in
`neorl.agents.rules`. This module holds data only; kernels elsewhere run it.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from graphlib import CycleError, TopologicalSorter
from typing import Annotated

from neorl.agents.rules import Contacts, Learning, Policy
from neorl.common import checks
from neorl.common.checks import NotNegative, OneOf
from neorl.core.choices import MapState, Weighting
from neorl.core.horde import OWN_CELL
from neorl.core.maps import NresMap
from neorl.core.modality import SEVERAL, Modality
from neorl.description import Described

MOST_PARTS = 4_096  # nodes, or desires; time and memory are quadratic in their number
STATES = tuple(name.replace("_", " ") for name in MapState.__members__)
SHARED_CELL = ("each", "once")
RESETS = ("noticed", "unnoticed")
LEARNED, FIRST_WORTH = "learned", 1.0  # optimistic, so that unknown things are approached


@dataclass(frozen=True)
class Node(checks.Final):
    """The maps of one modality, which learn in parallel and sum their values (paper A, experiment 2).

    name: a string that is not a kind of thing in the agent's worlds. modality: the `Modality` of its maps.
    resolutions: one or more integers ≥ 1.
    weighting: how the maps are weighted in the sum: "equal"; "resolution", by N; "cells", by N². The weights sum to 1.
    gain: weight of the node's values in the agent's; with 0 only the node's desires count.
    goals: what the node learns to reach: all "cells", the Horde of the thesis, or only "contacts" with things, see
        `Contacts`. With contacts, the modality must be of objects, the resolutions must increase, and the weighting
        has no effect.
    state: in a map of things relative to the agent, what its state and its goals are (paper B, section 3). "object":
        the state is the cell of a thing, and the goal is the contact, distance 0. "self": the state is the agent,
        always at the centre, and the goal is the cell of the thing; a value for each cell is all there is to learn,
        from the agent's own motion. "per object": the same, from the agent's motion as seen from each thing until it
        is met.
        For the last two, the modality must have one component along every axis of the world and no other axis.
    reach: with the state "object", half the side of the square around the agent that counts as contact, in units of the
        world's size, ≥ 0: every cell that it overlaps is a goal. 0 stands for the cell at distance 0.
    beyond: the cell of what lies beyond the range of a map: the "outermost", or "none".

    Raises ValueError for anything else.
    """

    name: str
    modality: Modality
    resolutions: Sequence[int]
    weighting: Annotated[str, OneOf(tuple(Weighting.__members__))] = "cells"
    gain: float = 1.0
    goals: Annotated[str, OneOf(("cells", "contacts"))] = "cells"
    state: Annotated[str, OneOf(STATES)] = "object"
    reach: NotNegative = 0.0
    beyond: Annotated[str, OneOf(("outermost", "none"))] = "outermost"

    def __post_init__(self):
        checks.check_fields(self)
        if not self.name:
            raise checks.error("name", "one character or more", self.name)
        checks.assign(self, resolutions=checks.several("resolutions", self.resolutions))
        if not self.resolutions:
            raise checks.error("resolutions", "one integer or more", ())
        checks.assign(self, resolutions=tuple(each.resolution for each in self.maps))
        if self.goals == "contacts" and self.modality.follows != "objects":
            raise checks.error(f"goals of {self.modality.name}s", "'cells'", self.goals, "they follow no objects")
        if self.goals == "contacts" and any(fine <= coarse for coarse, fine in zip(self.resolutions,
                                                                                   self.resolutions[1:])):
            raise checks.error("resolutions", "integers that grow, with contacts as goals", self.resolutions)
        if self.goals == "cells" and self.modality.mirrored:
            raise checks.error(f"goals of {self.modality.name}s", "'contacts', since they are mirrored", self.goals)

        if self.state != "object" or self.reach > 0:
            given = f"state is {self.state!r}" if self.state != "object" else f"reach is {self.reach}"
            if not self.modality.is_cartesian or self.modality.follows != "objects" or self.goals == "contacts":
                raise ValueError(f"state must be 'object' and reach 0 for {self.modality.name}s, but {given}; other "
                                 "states and reaches take one component of objects along every axis of the world, with "
                                 "cells as goals")
        if self.state != "object" and self.reach > 0:
            raise checks.error(f"reach with the state {self.state!r}", "0, since its goals are the cells of the things",
                               self.reach)
        if self.beyond == "none" and self.goals == "contacts":
            raise checks.error("beyond", "'outermost', with contacts as goals", self.beyond)

    @property
    def maps(self) -> tuple[NresMap, ...]:
        """An `NresMap` for each resolution."""
        return tuple(NresMap(resolution, self.modality) for resolution in self.resolutions)


@dataclass(frozen=True, init=False)
class Place(checks.Final):
    """A fixed place in the world as an element of interest: `Place(x, y)` in the plane.

    coordinates: a finite number for each axis of the world, in units of its size; in WaterWorld and the arena, board
        widths from the upper left corner, 0 … 1.

    Raises ValueError for anything else; for a place outside the board, once the world is known.
    """

    coordinates: tuple[float, ...]

    def __init__(self, *coordinates: float) -> None:
        if not coordinates:
            raise checks.error("coordinates", "a number for each axis of the world", ())
        checks.assign(self, coordinates=tuple(checks.real("coordinates", each) for each in coordinates))

    @classmethod
    def of_fields(cls, coordinates: Sequence[float]) -> "Place":
        """The place with these coordinates, given as one tuple. Raises ValueError for anything else."""
        return cls(*checks.several("coordinates", coordinates))

    def __repr__(self):
        return f"Place{self.coordinates}"


@dataclass(frozen=True)
class Desire(checks.Final):
    """One edge of a network: `source` as an element of interest of the node `target`.

    source: a kind of the world's things, such as "green"; a `Place`, like a thing that does not move; a point in the
        target's space, to be reached by the vector that the node follows; or the name of a node. Its desire vector
        Σ |w| (Q_E − Q_W, Q_S − Q_N) over its elements (in other worlds, the sum of the actions' pushes times their
        values), times `scale`, is the element's position relative to the agent, in units of the world's size (paper C,
        section 1), or, in a space of velocities, the desired velocity. A node's desire for itself uses the vector of
        the previous step: recursion.
    valence: the signed weight of an element. For a desire between nodes, None stands for the sum of the valences that
        the vector is computed from; recursion requires a number, the weight r. For a kind of thing, "learned" stands
        for a number learned from reward alone; its initial value is 1.
    of: the names of the sources from which the vector of a node is computed; () stands for all its elements.
    scale: units of the world's size for a vector of length 1, ≥ 0. signed: sum w instead of |w|.

    Raises ValueError for anything else.
    """

    source: str | Place | Sequence[float]
    target: str
    valence: float | str | None = None
    of: Sequence[str] = ()
    scale: NotNegative = 1.0
    signed: bool = True

    def __post_init__(self):
        if isinstance(self.source, str):
            checks.assign(self, source=str(self.source))  # not a subclass, such as NumPy's
        elif not isinstance(self.source, Place):
            point = checks.several("source", self.source)
            checks.assign(self, source=tuple(checks.real("source", value) for value in point))
        checks.check_fields(self)
        if isinstance(self.valence, str) and self.valence == LEARNED:
            if not isinstance(self.source, str):
                raise checks.error("valence", f"a number for the source {self.source!r}", LEARNED, "it is learned for "
                                   "kinds of things")
            checks.assign(self, valence=LEARNED)
        elif self.valence is not None:
            checks.assign(self, valence=checks.real("valence", self.valence))
        checks.assign(self, of=tuple(str(checks.instance("of", each, str)) for each in checks.several("of", self.of)))

    def __str__(self):
        return f"{self.source!r} → {self.target!r}"


@dataclass(frozen=True)
class Agent(Described, checks.Final):
    """One neoRL agent: a network of nodes, whose action values, times their gains, sum to the agent's.

    nodes: one `Node` or more, with distinct names. desires: any number of `Desire`. At most 4,096 of each.
    learning: how its maps learn, a `Learning`. policy: how it chooses actions, a `Policy`.
    contacts: how nodes with contacts as goals learn, a `Contacts`.
    own_cell: whether an element in the currently active cell is "silent", its desire being satisfied, or "counts".
    shared_cell: whether several things of one kind in the same cell of a map, be it a state or a goal, count "each", or
        "once", since S_R of eq. 4.4 is a set of cells. The valence of a desire sums over all things, and nodes with
        contacts as goals count each, in both cases.
    resets: whether the end of an episode is "noticed": memories are erased, and the leap to the next is not learned.
        When "unnoticed", nothing happens at a reset, and the leap is one more transition, which the agent learns when
        it perceives the outcome of its next action. What it has just met starts afresh, as it does without a reset.

    Raises ValueError for anything else, and for a network that cannot be evaluated: a desire from or to a node that
    does not exist, of elements that its node does not have, in a space where it has no meaning, or in a cycle of nodes.
    """

    nodes: Sequence[Node]
    desires: Sequence[Desire] = ()
    learning: Learning = field(default_factory=Learning)
    policy: Policy = field(default_factory=Policy)
    own_cell: Annotated[str, OneOf(OWN_CELL)] = "counts"
    contacts: Contacts = field(default_factory=Contacts)
    shared_cell: Annotated[str, OneOf(SHARED_CELL)] = "each"
    resets: Annotated[str, OneOf(RESETS)] = "noticed"

    def __post_init__(self):
        for name, kind, fewest in (("nodes", Node, 1), ("desires", Desire, 0)):
            checks.assign(self, **{name: checks.several(name, getattr(self, name))})
            for each in getattr(self, name):
                checks.instance(name, each, kind)
            if not fewest <= len(getattr(self, name)) <= MOST_PARTS:
                raise ValueError(f"{name} must be {fewest} to {MOST_PARTS}, each a {kind.__name__}, but are "
                                 f"{len(getattr(self, name))}")
        names = [node.name for node in self.nodes]
        if len(set(names)) < len(names):
            raise ValueError(f"nodes must have different names, but have {', '.join(map(repr, names))}")
        checks.check_fields(self)
        for node in self.nodes:
            if node.state != "object" and self.learning.update_on == "step":
                raise checks.error("update_on", f"'cell' for the node {node.name!r} with the state {node.state!r}",
                                   "step", "within a step, the self stays in the centre")
            if node.goals == "contacts" and self.contacts.efference > 0 and not any(
                    axis.of == "velocity" for axis in node.modality.axes):
                raise checks.error(f"efference with the node {node.name!r}", "0, since its cells have no axis of "
                                   "velocity, which a push would change", self.contacts.efference)
        for desire in self.desires:
            self._check_desire(desire)
        self.evaluation_order  # raises ValueError for a cycle

    def _check_desire(self, desire):
        nodes = {node.name: node for node in self.nodes}
        if desire.target not in nodes:
            raise checks.error(f"target of the desire {desire}", f"a node, {checks.either(nodes)}", desire.target)
        if desire.valence is None and (desire.source not in nodes or desire.source == desire.target):
            raise checks.error(f"valence of the desire {desire}", "a finite number, since it does not come from "
                               "another node", None)
        if desire.of and desire.source not in nodes:
            raise checks.error(f"of in the desire {desire}", "(), since its source is not a node", desire.of)
        if desire.valence == LEARNED and desire.source in nodes:
            raise checks.error(f"valence of the desire {desire}", "a number or None, since its source is a node",
                               LEARNED)
        if isinstance(desire.source, tuple) and nodes[desire.target].goals == "contacts":
            raise checks.error(f"source of the desire {desire}", "a kind of thing, a place or a node", desire.source,
                               f"{desire.target!r} learns only of contacts, of which a point has none")
        modality = nodes[desire.target].modality
        if not isinstance(desire.source, tuple) and len(modality.functions) == len(modality.axes):
            raise ValueError(f"desire {desire} must be for a point in the space of {modality.name}s: their only axes "
                             "are kernels of your own, which say where the agent is, not where something else is; "
                             f"use the coordinates of the point as its source, ({', '.join(modality.names)}), or "
                             "cells with an axis of a vector, such as Axis('position')")
        if isinstance(desire.source, str | Place) and desire.source not in nodes and not modality.takes_places:
            raise checks.error(f"source of the desire {desire}", f"a point in the space of {modality.name}s",
                               desire.source, "things and places have no coordinates there")
        if ((isinstance(desire.source, Place) or desire.source in nodes) and modality.functions
                and modality.follows in SEVERAL):
            raise checks.error(f"source of the desire {desire}", "a kind of thing, or a point in the space of "
                               f"{modality.name}s", desire.source, "kernels of your own locate nothing but things")
        if isinstance(desire.source, tuple) and len(desire.source) != len(modality.axes):
            raise checks.error(f"source of the desire {desire}", f"a point of {len(modality.axes)} coordinates, for "
                               f"{', '.join(modality.names)}", desire.source)
        inputs = {other.source for other in self.desires if other.target == desire.source}
        for source in desire.of:
            if source not in inputs:
                raise checks.error(f"of in the desire {desire}", f"among the sources of {desire.source!r}, "
                                   f"{checks.either(inputs)}", source)

    def comes_from_node(self, desire: Desire) -> bool:
        """Whether the source of a `Desire` is a node rather than something in the world.

        desire: one of the agent's. Raises ValueError for anything but a `Desire`.
        """
        checks.instance("desire", desire, Desire)
        return any(desire.source == node.name for node in self.nodes)

    @property
    def evaluation_order(self) -> tuple[str, ...]:
        """The names of the nodes, each after the nodes it receives desires from."""
        before: dict[str, list[str]] = {node.name: [] for node in self.nodes}
        for desire in self.desires:
            if desire.source in before and desire.source != desire.target:
                before[desire.target].append(desire.source)
        try:
            return tuple(TopologicalSorter(before).static_order())
        except CycleError as error:
            source, target = error.args[1][:2]
            raise ValueError(f"desires between nodes must not form a cycle, but {source!r} → {target!r} closes "
                             f"{' → '.join(error.args[1])}; only a node may desire from itself") from None

    @property
    def maps(self) -> tuple[NresMap, ...]:
        """The maps of all nodes, node by node."""
        return tuple(nres_map for node in self.nodes for nres_map in node.maps)
