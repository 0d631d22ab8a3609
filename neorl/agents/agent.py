"""A neoRL agent as data: a network of nodes, how it learns, how it chooses, and what it desires.

A *node* holds the maps of one modality at several resolutions (paper C, section 1 and figure 3). *Desires* are the
edges of the network. Each makes an element of interest of something for one node: of the green or the red creeps, of a
point of the node's own space, or of what another node wants, or the node itself wanted a step ago. Whatever the thesis
leaves open is a field. Its default is that of the calibrated reading, which of all readings within the text that were
run came nearest to the thesis's numbers (see `neorl.evidence.calibration`). Nothing here runs.
"""

from dataclasses import dataclass, field
from graphlib import CycleError, TopologicalSorter

from neorl import checks
from neorl.core.choices import N_EVENTS, Attention, Capture, Credit, UpdateOn, Weighting
from neorl.core.horde import OWN_CELL
from neorl.core.maps import NresMap
from neorl.core.modality import Modality

UPDATES_ON, CREDITS, CAPTURES, ATTENTIONS, WEIGHTINGS = (
    tuple(kind.__members__) for kind in (UpdateOn, Credit, Capture, Attention, Weighting))
ABSENT_FORMS = ("decay", "away")
MEMORY_UNITS = ("cells", "seconds")
MEMORY_VALUES = ("reached", "discounted")
CAUSES = ("any", "own")
WHEN_INDIFFERENT = ("random", "no-op")
COLOURS = ("green", "red")


@dataclass(frozen=True)
class Learning:
    """How the Horde learns (thesis section 4.1.3).

    learning_rate: α in [0, 1]. discount: γ in [0, 1] for each update. It has no effect unless something discounts:
        bootstrapping, a trace of several cells, or a memory with `memory_value` "discounted".
    update_on: what makes an update. "cell": a change of cell, inference inversion (eq. 4.7, 4.8); "step": every step,
        temporal difference (eq. 4.6), to which no field below but `terminal` applies: see `AT_EVERY_STEP`.
    credit: ψ of an event in the cell just left. "share": the share of the steps there on which it occurred;
        "happened": 1 if it occurred at all; "count": the number of steps on which it occurred, α ψ being 1 at most;
        "activity": how active it was at the end, see `activity`; "last": 1 for the last event only.
    activity: seconds > 0, the time constant of the leaky integrator of the credit "activity". It is 1 for an event
        that has occurred on every step for long; below 0.01 it counts as 0 (section 4.4).
    absent_decay: −ψ(0) in [0, 1]: the values of events that did not occur sink at the rate α · absence.
    absent_form: towards zero, "decay", or "away" from the target as eq. 4.8 has it with a negative rate; values then
        stay within 0 and the highest that there can be.
    terminal: a goal reached is worth 1; otherwise 1 plus the discounted value of reaching it again.
    trace: how many of the cells left most recently learn that the cell now entered is where they led to, the k-th
        before the last at γ^k times its rate. 1 is the cell just left alone.
    memory: a leaky integrator over all cells left, ≥ 0. They all learn that the cell now entered is where they led to,
        at rates that fade with time or with each cell left since. 0 is none. It takes the place of a trace.
    memory_unit: "seconds", a time constant: rates fade at each step. "cells": they fade by memory / (1 + memory) at
        each change of cell, so that `memory` is the mean number of earlier cells remembered.
    memory_value: what the goal is worth to a cell left k cells ago: 1, "reached", or γ^k, "discounted".
    bootstrap: the cell just left also learns about all other goals from the cell entered (the γ max Q of eq. 4.8).
    causes: of changes of cell that things as seen from the agent learn from. "any", or "own": those that would have
        occurred had the thing stood still.
    capture: what the capture of a thing is to them: "contact", arrival at distance 0; "leap", a change to the cell of
        the fresh thing like any other; "silent", nothing. They begin anew with the fresh thing, but for a leap.
    attention: which things they follow: "each", the "nearest", or the one "wanted", the nearest green one.

    Raises ValueError for anything else.
    """

    learning_rate: float = 0.0157
    discount: float = 0.9045
    update_on: str = "cell"
    credit: str = "happened"
    activity: float = 3.331
    absent_decay: float = 0.1101
    absent_form: str = "away"
    terminal: bool = True
    trace: int = 1
    memory: float = 4.396
    memory_unit: str = "seconds"
    memory_value: str = "reached"
    bootstrap: bool = False
    causes: str = "own"
    capture: str = "leap"
    attention: str = "wanted"

    def __post_init__(self):
        checks.assign(
            self,
            learning_rate=checks.real("learning_rate", self.learning_rate, 0, 1),
            discount=checks.real("discount", self.discount, 0, 1),
            update_on=checks.one_of("update_on", self.update_on, UPDATES_ON),
            credit=checks.one_of("credit", self.credit, CREDITS),
            activity=checks.real("activity", self.activity, 0),
            absent_decay=checks.real("absent_decay", self.absent_decay, 0, 1),
            absent_form=checks.one_of("absent_form", self.absent_form, ABSENT_FORMS),
            terminal=checks.flag("terminal", self.terminal),
            trace=checks.integer("trace", self.trace, at_least=1),
            memory=checks.real("memory", self.memory, 0),
            memory_unit=checks.one_of("memory_unit", self.memory_unit, MEMORY_UNITS),
            memory_value=checks.one_of("memory_value", self.memory_value, MEMORY_VALUES),
            bootstrap=checks.flag("bootstrap", self.bootstrap),
            causes=checks.one_of("causes", self.causes, CAUSES),
            capture=checks.one_of("capture", self.capture, CAPTURES),
            attention=checks.one_of("attention", self.attention, ATTENTIONS))
        if self.update_on == "step":
            for name, value in AT_EVERY_STEP.items():
                if getattr(self, name) not in (value, getattr(Learning, name)):
                    raise ValueError(f"{name} is {getattr(self, name)!r}, allowed with update_on 'step' is {value!r}")
                checks.assign(self, **{name: value})
        if self.memory > 0 and self.trace > 1:
            raise ValueError(f"trace is {self.trace}, allowed with memory, here {self.memory}, is 1")


# What temporal difference leaves no choice of, and what stands in place of the defaults with it.
AT_EVERY_STEP = {"credit": "share", "absent_decay": 0.0, "trace": 1, "memory": 0.0, "bootstrap": True, "causes": "any",
                 "capture": "contact", "attention": "each"}


@dataclass(frozen=True)
class Policy:
    """How the agent chooses: the action of highest value, ties broken at random (paper A, The Control Problem).

    exploration: ε in [0, 1], the share of steps on which the action is drawn instead.
    when_indifferent: what to do while every action is worth exactly 0: "random" or "no-op".
    """

    exploration: float = 0.0
    when_indifferent: str = "random"

    def __post_init__(self):
        checks.assign(self, exploration=checks.real("exploration", self.exploration, 0, 1),
                     when_indifferent=checks.one_of("when_indifferent", self.when_indifferent, WHEN_INDIFFERENT))


@dataclass(frozen=True)
class Node:
    """The maps of one modality, which learn side by side and add up their values (paper A, experiment 2).

    name: any but "green" and "red". resolutions: one integer ≥ 1 or more.
    weighting: of the maps in the sum. "equal"; "resolution", by N; "cells", by N². The weights add up to 1.
    gain: of the node's values in the agent's; with 0 only the node's desires count.

    Raises ValueError for anything else.
    """

    name: str
    modality: Modality
    resolutions: tuple[int, ...]
    weighting: str = "cells"
    gain: float = 1.0

    def __post_init__(self):
        if not isinstance(self.name, str) or self.name in COLOURS:
            raise ValueError(f"name is {self.name!r}, allowed are strings other than {COLOURS}")
        checks.instance("modality", self.modality, Modality)
        checks.assign(self, resolutions=checks.several("resolutions", self.resolutions))
        if not self.resolutions:
            raise ValueError("resolutions is (), allowed are one integer or more")
        checks.assign(self, resolutions=tuple(each.resolution for each in self.maps),
                     weighting=checks.one_of("weighting", self.weighting, WEIGHTINGS),
                     gain=checks.real("gain", self.gain))

    @property
    def maps(self):
        """An `NresMap` for each resolution."""
        return tuple(NresMap(resolution, self.modality) for resolution in self.resolutions)


@dataclass(frozen=True)
class Place:
    """A place in the arena, in board widths from its upper left corner: an element of interest that stays where it is.

    Raises ValueError unless both are finite numbers.
    """

    x: float
    y: float

    def __post_init__(self):
        checks.assign(self, x=checks.real("x", self.x), y=checks.real("y", self.y))


@dataclass(frozen=True)
class Desire:
    """One edge of a network: `source` as an element of interest of the node `target`.

    source: "green" or "red", the creeps of that colour; a `Place`, like a creep that does not move; a point in the
        target's space, which whatever the node follows is to reach; or the name of a node, whose desire vector
        Σ |w| (Q_E − Q_W, Q_S − Q_N) over its elements, times `scale`, says where, as seen from the agent in board
        widths, the element lies (paper C, section 1). A node that desires of itself does so by its desire vector of
        the step before: recursion.
    valence: how much an element matters, and its sign. For a desire between nodes None stands for the sum of the
        valences that the vector comes from; recursion needs a number, the weight r.
    of: the names of the sources that the vector of a node comes from; () stands for all its elements.
    scale: board widths for a vector of length 1, ≥ 0. signed: sum w instead of |w|.

    Raises ValueError for anything else.
    """

    source: str | Place | tuple[float, ...]
    target: str
    valence: float | None = None
    of: tuple[str, ...] = ()
    scale: float = 1.0
    signed: bool = True

    def __post_init__(self):
        if not isinstance(self.source, str | Place):
            point = checks.several("source", self.source)
            checks.assign(self, source=tuple(checks.real("source", value) for value in point))
        checks.instance("target", self.target, str)
        if not self.between_nodes or self.source == self.target or self.valence is not None:
            if self.valence is None:
                raise ValueError(f"valence of the desire {self} is None, allowed are finite numbers")
            checks.assign(self, valence=checks.real("valence", self.valence))
        checks.assign(self, of=tuple(checks.instance("of", each, str) for each in checks.several("of", self.of)),
                     scale=checks.real("scale", self.scale, 0), signed=checks.flag("signed", self.signed))
        if self.of and not self.between_nodes:
            raise ValueError(f"of is {self.of!r}, allowed for the desire {self} is (): it comes from no node")

    def __str__(self):
        return f"{self.source!r} → {self.target!r}"

    @property
    def between_nodes(self):
        """Whether it comes from a node."""
        return isinstance(self.source, str) and self.source not in COLOURS


@dataclass(frozen=True)
class Agent:
    """One neoRL agent: a network of nodes. Its value of an action is the sum of those of its nodes, times their gains.

    nodes: one `Node` or more, each name once. desires: any number of `Desire`.
    own_cell: whether an element in the cell that it is to be reached from is "silent", its desire met, or "counts".

    Raises ValueError for anything else, and for a network that cannot be evaluated: a desire from or to a node that
    there is not, of elements that its node does not have, in a space where it has no meaning, or in a cycle of nodes.
    """

    nodes: tuple[Node, ...]
    desires: tuple[Desire, ...] = ()
    learning: Learning = field(default_factory=Learning)
    policy: Policy = field(default_factory=Policy)
    own_cell: str = "counts"

    def __post_init__(self):
        for name, kind, fewest in (("nodes", Node, 1), ("desires", Desire, 0)):
            checks.assign(self, **{name: checks.several(name, getattr(self, name))})
            for each in getattr(self, name):
                checks.instance(name, each, kind)
            if len(getattr(self, name)) < fewest:
                raise ValueError(f"{name} is (), allowed are one {kind.__name__} or more")
        names = [node.name for node in self.nodes]
        if len(set(names)) < len(names):
            raise ValueError(f"nodes are {', '.join(map(repr, names))}, allowed is each name once")
        checks.instance("learning", self.learning, Learning)
        checks.instance("policy", self.policy, Policy)
        checks.assign(self, own_cell=checks.one_of("own_cell", self.own_cell, OWN_CELL))
        for desire in self.desires:
            self._check_desire(desire)
        self.evaluation_order  # which raises ValueError for a cycle

    def _check_desire(self, desire):
        nodes = {node.name: node for node in self.nodes}
        for name in (desire.source, desire.target) if desire.between_nodes else (desire.target,):
            if name not in nodes:
                raise ValueError(f"desire {desire}: there is no node {name!r}, allowed are "
                                 f"{', '.join(map(repr, nodes))}")
        modality = nodes[desire.target].modality
        if isinstance(desire.source, str | Place) and not modality.takes_places:
            raise ValueError(f"desire {desire}: what lies at a place has no point among {modality.name}s, allowed are "
                             f"points of their own space")
        if isinstance(desire.source, tuple) and len(desire.source) != len(modality.axes):
            raise ValueError(f"desire {desire}: allowed for {modality.name}s are points of {len(modality.axes)} "
                             f"coordinates: {', '.join(modality.axes)}")
        inputs = {other.source for other in self.desires if other.target == desire.source}
        for source in desire.of:
            if source not in inputs:
                raise ValueError(f"desire {desire}: {source!r} is no element of the node {desire.source!r}")

    @property
    def evaluation_order(self):
        """The names of the nodes, each after those that it takes desires from."""
        before = {node.name: [] for node in self.nodes}
        for desire in self.desires:
            if desire.between_nodes and desire.source != desire.target:
                before[desire.target].append(desire.source)
        try:
            return tuple(TopologicalSorter(before).static_order())
        except CycleError as error:
            source, target = error.args[1][:2]
            raise ValueError(f"desire {source!r} → {target!r}: it closes the cycle {' → '.join(error.args[1])}, "
                             "allowed is recursion of a node to itself alone") from None

    @property
    def maps(self):
        """The maps of all nodes, one node after the other."""
        return tuple(nres_map for node in self.nodes for nres_map in node.maps)

    @property
    def n_values(self):
        """How many Q values a run holds; each takes four bytes."""
        return sum(N_EVENTS * nres_map.cells**2 for nres_map in self.maps)
