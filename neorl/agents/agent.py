"""A neoRL agent as data: a network of nodes, what they desire, and the rules by which they learn and choose.

A *node* holds the maps of one modality at several resolutions (paper C, section 1 and figure 3). *Desires* are the
edges of the network. Each makes an element of interest of something for one node: of the things of one kind, of a place
or a point of the node's own space, or of what another node wants, or the node itself wanted a step ago. An agent knows
no world: the names of kinds get their meaning when it meets one. What the thesis leaves open is a field, as in
`neorl.agents.rules`. Nothing here runs.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from graphlib import CycleError, TopologicalSorter

from neorl import checks
from neorl.agents.rules import Contacts, Learning, Policy
from neorl.core.choices import Weighting
from neorl.core.description import Described
from neorl.core.horde import OWN_CELL
from neorl.core.maps import NresMap
from neorl.core.modality import Modality

WEIGHTINGS = tuple(Weighting.__members__)
MOST_PARTS = 4_096  # nodes, or desires, whose number squared is looked at
GOALS = ("cells", "contacts")
LEARNED, FIRST_WORTH = "learned", 1.0  # what is not yet known is worth a meeting


@dataclass(frozen=True)
class Node(checks.Final):
    """The maps of one modality, which learn side by side and add up their values (paper A, experiment 2).

    name: a string that is no kind of thing in the worlds it is to live in. resolutions: one integer ≥ 1 or more.
    weighting: of the maps in the sum. "equal"; "resolution", by N; "cells", by N². The weights add up to 1.
    gain: of the node's values in the agent's; with 0 only the node's desires count.
    goals: what the node learns to reach: all "cells", the Horde of the thesis, or "contacts" with things alone, see
        `Contacts`. Its modality is then of objects, its resolutions grow, and its weighting has no effect.

    Raises ValueError for anything else.
    """

    name: str
    modality: Modality
    resolutions: Sequence[int]
    weighting: str = "cells"
    gain: float = 1.0
    goals: str = "cells"

    def __post_init__(self):
        checks.instance("modality", self.modality, Modality)
        checks.assign(self, name=str(checks.instance("name", self.name, str)),
                     resolutions=checks.several("resolutions", self.resolutions))
        if not self.resolutions:
            raise ValueError("resolutions is (), allowed are one integer or more")
        checks.assign(self, resolutions=tuple(each.resolution for each in self.maps),
                     weighting=checks.one_of("weighting", self.weighting, WEIGHTINGS),
                     gain=checks.real("gain", self.gain), goals=checks.one_of("goals", self.goals, GOALS))
        if self.goals == "contacts" and self.modality.follows != "objects":
            raise ValueError(f"goals is 'contacts', allowed for {self.modality.name}s is 'cells': they follow no "
                             "objects")
        if self.goals == "contacts" and any(fine <= coarse for coarse, fine in zip(self.resolutions,
                                                                                   self.resolutions[1:])):
            raise ValueError(f"resolutions is {self.resolutions}, allowed for contacts are integers that grow")
        if self.goals == "cells" and self.modality.mirrored:
            raise ValueError(f"goals is 'cells', allowed for {self.modality.name}s, which are mirrored, is 'contacts'")

    @property
    def maps(self) -> tuple[NresMap, ...]:
        """An `NresMap` for each resolution."""
        return tuple(NresMap(resolution, self.modality) for resolution in self.resolutions)


@dataclass(frozen=True, init=False)
class Place(checks.Final):
    """A place in the world, an element of interest that stays where it is: `Place(x, y)` in the plane.

    coordinates: a finite number for each axis of the world, in units of its size; in WaterWorld and the arena, board
        widths from the upper left corner, 0 … 1.

    Raises ValueError for anything else; for a place that is not on the board, as soon as the world is known.
    """

    coordinates: tuple[float, ...]

    def __init__(self, *coordinates: float) -> None:
        if not coordinates:
            raise ValueError("coordinates is (), allowed are a number for each axis of the world")
        checks.assign(self, coordinates=tuple(checks.real("coordinates", each) for each in coordinates))

    @classmethod
    def of_fields(cls, coordinates: Sequence[float]) -> "Place":
        """The place with these coordinates, in one tuple. Raises ValueError for anything else."""
        return cls(*checks.several("coordinates", coordinates))

    def __repr__(self):
        return f"Place{self.coordinates}"


@dataclass(frozen=True)
class Desire(checks.Final):
    """One edge of a network: `source` as an element of interest of the node `target`.

    source: a kind of the world's things, such as "green"; a `Place`, like a thing that does not move; a point in the
        target's space, which whatever the node follows is to reach; or the name of a node, whose desire vector
        Σ |w| (Q_E − Q_W, Q_S − Q_N) over its elements (in other worlds: the pushes of all actions, times their values),
        times `scale`, says where the element lies from the agent, in sizes of the world (paper C, section 1), or in a
        space of velocities is the one desired. A node's desire of itself is that of the step before: recursion.
    valence: how much an element matters, and its sign. For a desire between nodes None stands for the sum of the
        valences that the vector comes from; recursion needs a number, the weight r. "learned" stands for a number that
        is learned from reward alone, for a kind of thing; it begins with 1.
    of: the names of the sources that the vector of a node comes from; () stands for all its elements.
    scale: units of the world's size for a vector of length 1, ≥ 0. signed: sum w instead of |w|.

    Raises ValueError for anything else.
    """

    source: str | Place | Sequence[float]
    target: str
    valence: float | str | None = None
    of: Sequence[str] = ()
    scale: float = 1.0
    signed: bool = True

    def __post_init__(self):
        if isinstance(self.source, str):
            checks.assign(self, source=str(self.source))  # and no subclass, such as NumPy's
        elif not isinstance(self.source, Place):
            point = checks.several("source", self.source)
            checks.assign(self, source=tuple(checks.real("source", value) for value in point))
        checks.assign(self, target=str(checks.instance("target", self.target, str)))
        if isinstance(self.valence, str) and self.valence == LEARNED:
            if not isinstance(self.source, str):
                raise ValueError(f"valence is 'learned', allowed for the source {self.source!r} are numbers: it is "
                                 "learned for kinds of things")
            checks.assign(self, valence=LEARNED)
        elif self.valence is not None:
            checks.assign(self, valence=checks.real("valence", self.valence))
        checks.assign(self, of=tuple(str(checks.instance("of", each, str)) for each in checks.several("of", self.of)),
                     scale=checks.real("scale", self.scale, 0), signed=checks.flag("signed", self.signed))

    def __str__(self):
        return f"{self.source!r} → {self.target!r}"


@dataclass(frozen=True)
class Agent(Described, checks.Final):
    """One neoRL agent: a network of nodes. Its value of an action is the sum of those of its nodes, times their gains.

    nodes: one `Node` or more, each name once. desires: any number of `Desire`. Of either 4,096 at most.
    learning: how its maps learn, a `Learning`. policy: how it chooses, a `Policy`.
    contacts: how those of nodes learn whose goals are contacts, a `Contacts`.
    own_cell: whether an element in the cell that it is to be reached from is "silent", its desire met, or "counts".

    Raises ValueError for anything else, and for a network that cannot be evaluated: a desire from or to a node that
    there is not, of elements that its node does not have, in a space where it has no meaning, or in a cycle of nodes.
    """

    nodes: Sequence[Node]
    desires: Sequence[Desire] = ()
    learning: Learning = field(default_factory=Learning)
    policy: Policy = field(default_factory=Policy)
    own_cell: str = "counts"
    contacts: Contacts = field(default_factory=Contacts)

    def __post_init__(self):
        for name, kind, fewest in (("nodes", Node, 1), ("desires", Desire, 0)):
            checks.assign(self, **{name: checks.several(name, getattr(self, name))})
            for each in getattr(self, name):
                checks.instance(name, each, kind)
            if not fewest <= len(getattr(self, name)) <= MOST_PARTS:
                raise ValueError(f"{name} are {len(getattr(self, name))}, allowed are {fewest} to {MOST_PARTS}, each a "
                                 f"{kind.__name__}")
        names = [node.name for node in self.nodes]
        if len(set(names)) < len(names):
            raise ValueError(f"nodes are {', '.join(map(repr, names))}, allowed is each name once")
        checks.instance("learning", self.learning, Learning)
        checks.instance("policy", self.policy, Policy)
        checks.instance("contacts", self.contacts, Contacts)
        checks.assign(self, own_cell=checks.one_of("own_cell", self.own_cell, OWN_CELL))
        for desire in self.desires:
            self._check_desire(desire)
        self.evaluation_order  # which raises ValueError for a cycle

    def _check_desire(self, desire):
        nodes = {node.name: node for node in self.nodes}
        if desire.target not in nodes:
            raise ValueError(f"desire {desire}: there is no node {desire.target!r}, allowed are "
                             f"{', '.join(map(repr, nodes))}")
        if desire.valence is None and (desire.source not in nodes or desire.source == desire.target):
            raise ValueError(f"valence of the desire {desire} is None, allowed are finite numbers unless it comes from "
                             f"another node, {', '.join(map(repr, nodes))}")
        if desire.of and desire.source not in nodes:
            raise ValueError(f"of is {desire.of!r}, allowed for the desire {desire} is (): it comes from no node")
        if desire.valence == LEARNED and desire.source in nodes:
            raise ValueError(f"valence of the desire {desire} is 'learned', allowed for that of a node are numbers and "
                             "None")
        if isinstance(desire.source, tuple) and nodes[desire.target].goals == "contacts":
            raise ValueError(f"desire {desire}: a point is no goal of the node, allowed are kinds of things, places "
                             "and nodes: it learns of contacts alone")
        modality = nodes[desire.target].modality
        if isinstance(desire.source, str | Place) and desire.source not in nodes and not modality.takes_places:
            raise ValueError(f"desire {desire}: what lies at a place has no point among {modality.name}s, allowed are "
                             f"points of their own space")
        if isinstance(desire.source, tuple) and len(desire.source) != len(modality.axes):
            raise ValueError(f"desire {desire}: allowed for {modality.name}s are points of {len(modality.axes)} "
                             f"coordinates: {', '.join(modality.names)}")
        inputs = {other.source for other in self.desires if other.target == desire.source}
        for source in desire.of:
            if source not in inputs:
                raise ValueError(f"desire {desire}: {source!r} is no element of the node {desire.source!r}, allowed "
                                 f"are {', '.join(map(repr, inputs)) or 'none'}")

    def comes_from_node(self, desire: Desire) -> bool:
        """Whether a `Desire` comes from a node, and not from something in the world.

        desire: one of the agent's. Raises ValueError for anything but a `Desire`.
        """
        checks.instance("desire", desire, Desire)
        return any(desire.source == node.name for node in self.nodes)

    @property
    def evaluation_order(self) -> tuple[str, ...]:
        """The names of the nodes, each after those that it takes desires from."""
        before: dict[str, list[str]] = {node.name: [] for node in self.nodes}
        for desire in self.desires:
            if desire.source in before and desire.source != desire.target:
                before[desire.target].append(desire.source)
        try:
            return tuple(TopologicalSorter(before).static_order())
        except CycleError as error:
            source, target = error.args[1][:2]
            raise ValueError(f"desire {source!r} → {target!r}: it closes the cycle {' → '.join(error.args[1])}, "
                             "allowed is recursion of a node to itself alone") from None

    @property
    def maps(self) -> tuple[NresMap, ...]:
        """The maps of all nodes, one node after the other."""
        return tuple(nres_map for node in self.nodes for nres_map in node.maps)
