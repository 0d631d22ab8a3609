"""A neoRL agent as data: a network of nodes, how it learns, how it chooses, and what it desires.

A *node* holds the maps of one modality at several resolutions (paper C, section 1 and figure 3). *Desires* are the
edges of the network. Each makes an element of interest of something for one node: of the things of one kind, of a place
or a point of the node's own space, or of what another node wants, or the node itself wanted a step ago. An agent knows
no world: the names of kinds get their meaning when it meets one. Whatever the thesis
leaves open is a field. Its default is that of the calibrated reading, which of all readings within the text that were
run came nearest to the thesis's numbers (see `neorl.evidence.calibration`). Nothing here runs.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from graphlib import CycleError, TopologicalSorter

from neorl import checks
from neorl.core.choices import Attention, Capture, Credit, UpdateOn, Weighting
from neorl.core.description import Described
from neorl.core.horde import OWN_CELL
from neorl.core.kernel import check_kernel
from neorl.core.maps import NresMap
from neorl.core.modality import Modality
from neorl.core.policy import greedy

UPDATES_ON, CAPTURES, ATTENTIONS, WEIGHTINGS = (
    tuple(kind.__members__) for kind in (UpdateOn, Capture, Attention, Weighting))
CREDITS = tuple(name for name in Credit.__members__ if name != "own")
ABSENT_FORMS = ("decay", "away")
MEMORY_UNITS = ("cells", "seconds")
MEMORY_VALUES = ("reached", "discounted")
CAUSES = ("any", "own")
MOST_PARTS = 4_096  # nodes, or desires, whose number squared is looked at
GOALS = ("cells", "contacts")
FEARS = ("avoidance", "approach")
RIVALS = ("highest", "add")
LEARNED, FIRST_WORTH = "learned", 1.0  # what is not yet known is worth a meeting
WHEN_INDIFFERENT = ("random", "no-op")


@dataclass(frozen=True)
class Learning(checks.Final):
    """How the Horde learns (thesis section 4.1.3).

    learning_rate: α in [0, 1]. discount: γ in [0, 1] for each update. It has no effect unless something discounts:
        bootstrapping, a trace of several cells, or a memory with `memory_value` "discounted".
    update_on: what makes an update. "cell": a change of cell, inference inversion (eq. 4.7, 4.8); "step": every step,
        temporal difference (eq. 4.6), to which no field below but `terminal` applies: see `AT_EVERY_STEP`.
    credit: ψ of an event in the cell just left. "share": the share of the steps there on which it occurred;
        "happened": 1 if it occurred at all; "count": the number of steps on which it occurred, α ψ being 1 at most;
        "activity": how active it was at the end, see `activity`; "last": 1 for the last event only. Or a
        `neorl.kernel` ``(count, steps, last, activity) → ψ``: on how many of the steps in the cell it occurred, out of
        how many; whether it was the last; how active it was. A ψ below 0 counts as 0, and α ψ is 1 at most.
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
    attention: which things they follow: "each", the "nearest", or the one "wanted", the nearest of the kind that the
        world names first: in WaterWorld, green.

    Raises ValueError for anything else.
    """

    learning_rate: float = 0.0157
    discount: float = 0.9045
    update_on: str = "cell"
    credit: str | Callable = "happened"
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
            credit=(check_kernel("credit", self.credit) if callable(self.credit) else
                    checks.one_of("credit", self.credit, CREDITS)),
            activity=checks.real("activity", self.activity, 0),
            absent_decay=checks.real("absent_decay", self.absent_decay, 0, 1),
            absent_form=checks.one_of("absent_form", self.absent_form, ABSENT_FORMS),
            terminal=checks.flag("terminal", self.terminal),
            trace=checks.integer("trace", self.trace, at_least=1, at_most=checks.MOST),
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
class Contacts(checks.Final):
    """How nodes learn whose goals are contacts alone, see `neorl.core.contacts`: beyond the thesis.

    The defaults are the best of what `neorl.chapters.beyond_agents.search` has tried.

    horizon: seconds > 0, the time constant by which what is to come is discounted.
    learning_rate: α in [0, 1], the least; after n visits it is n^(−3/4) or this.
    familiarity: ≥ 0. What a finer map knows of an action counts n / (n + familiarity) after n visits.
    first_value: in [0, 1], of the approach of what has not been tried: optimism in place of ε.
    trace_rate: in [0, 1], at which actions learn that they have led to a contact; 0 without a trace.
    caution: ≥ 0, what harm weighs against the best approach.
    fear: what the value of harm is: "avoidance", of a contact to an agent that would flee, or "approach", as the
        superposition of the thesis has it (eq. 4.4).
    rivals: of several things of positive worth, the approach that is worth the "highest" counts alone, or all "add" up.

    Raises ValueError for anything else.
    """

    horizon: float = 0.389
    learning_rate: float = 0.0262
    familiarity: float = 6.15
    first_value: float = 0.31
    trace_rate: float = 0.215
    caution: float = 0.309
    fear: str = "avoidance"
    rivals: str = "highest"

    def __post_init__(self):
        checks.assign(
            self,
            horizon=checks.positive("horizon", self.horizon),
            learning_rate=checks.real("learning_rate", self.learning_rate, 0, 1),
            familiarity=checks.real("familiarity", self.familiarity, 0),
            first_value=checks.real("first_value", self.first_value, 0, 1),
            trace_rate=checks.real("trace_rate", self.trace_rate, 0, 1),
            caution=checks.real("caution", self.caution, 0),
            fear=checks.one_of("fear", self.fear, FEARS),
            rivals=checks.one_of("rivals", self.rivals, RIVALS))


@dataclass(frozen=True)
class Policy(checks.Final):
    """How the agent chooses: the action of highest value, ties broken at random (paper A, The Control Problem).

    exploration: ε in [0, 1], the share of steps on which the action is drawn instead.
    when_indifferent: what to do while every action is worth exactly 0: "random", that is to choose as ever, or "no-op",
        to be idle.
    choose: a `neorl.kernel` (value, stream) → action: `neorl.greedy`, `neorl.softmax` of a temperature, or the user's
        own; see `neorl.core.policy`. A number that is none of an action counts as the nearest that is.

    Raises ValueError for anything else.
    """

    exploration: float = 0.0
    when_indifferent: str = "random"
    choose: Callable = greedy

    def __post_init__(self):
        checks.assign(self, exploration=checks.real("exploration", self.exploration, 0, 1),
                     when_indifferent=checks.one_of("when_indifferent", self.when_indifferent, WHEN_INDIFFERENT),
                     choose=check_kernel("choose", self.choose))


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
