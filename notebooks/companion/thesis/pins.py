"""What the text of the thesis fixes, sentence by sentence, and what it leaves open.

1. A `Pin` is one choice in building the agents, with the sentence of the thesis that bears on it.
2. A choice is *pinned* if the sentence excludes a value; a test then says whether a `companion.thesis.reading.Reading`
   obeys it. Otherwise the choice is *open*, also if there is no such sentence.
3. A choice pinned by several sentences has several pins, and a reading has to obey all of them.
4. Only the text decides. Pins are written down before the readings that they judge are run. The first list pinned or
   omitted some choices that the text leaves open: the state of an object-vector map, how ties are broken, what memory
   holds, and the valence and the unit of a desire vector. This list replaced it before the present calibration.

Quotations are verbatim except for mathematics, which is set in plain characters; square brackets are the source's.
"""

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class Pin:
    """One choice, and the sentence of the thesis that bears on it.

    fields: the names of those `choices` of a `Reading`; () if it is the same in every reading. quotation, place: the
    sentence and its place in the thesis, "" if there is none. follows: what it excludes, or what it leaves open and
    which value is simplest. allows: whether a given reading obeys the sentence; None if the choice is open.
    """

    choice: str
    fields: tuple[str, ...]
    quotation: str
    place: str
    follows: str
    allows: Callable | None = None

    @property
    def status(self):
        """ "pinned" or "open"."""
        return "pinned" if self.allows else "open"


def broken(reading):
    """The pins that a `Reading` breaks: a list, empty if it is within the text."""
    return [pin for pin in PINS if pin.allows and not pin.allows(reading)]


def in_words(reading):
    """That a reading is within the text, or the sentences that it breaks."""
    return "; ".join(f"{pin.choice}: “{pin.quotation}” ({pin.place})" for pin in broken(reading)) or "within the text"


def _always(_):
    """The test of a pin that every reading obeys."""
    return True


POLICY_AND_MAPS = (
    Pin("policy", ("exploration",), "my epsilon-free exploration", "Acknowledgements",
        "ε = 0: the action of highest value is taken, as in a = argmax Q_tot(s, a) of paper A (The Control Problem by "
        "Superposition). Section 4.3.1, too, contrasts directed exploration with ε-greedy policies.",
        lambda reading: reading.policy.exploration == 0),
    Pin("ties", ("when_indifferent",),
        "Basal actions affect the agent by accelerating it in the cardinal directions, [N, S, E, W].",
        "paper A, WaterWorld",
        "How a tie of values is broken is open. A uniform draw is simplest: “Learning can be regarded as inserting "
        "bias into this stochastic process” (section 4.1.1). With ε = 0, an agent that takes no action while values "
        "add up to zero, as in the author's later code, never moves, and one that takes the first action is stuck at "
        "a wall; so only the draw is run."),
    Pin("range of place cells", ("tiled_fraction",), "Each axis is divided into N = 5 equal intervals",
        "paper B, figure 3",
        "Maps of places cut the whole board into equal cells, as in figure 2 and Results of paper A.",
        lambda reading: reading.tiled_fraction == 1),
    Pin("weight of a map", ("weighting",), "the contribution of each learner is inversely proportional to the size of "
        "its receptive field", "paper A, Experiments",
        "Weights are proportional to the resolution N if size means width, which is simplest, or to N² if it means "
        "area; equal weights are excluded. Paper B adopts this.",
        lambda reading: reading.weighting in ("resolution", "cells")),
    Pin("elements in the agent's own cell", ("own_cell",), "the set of NRES cells occupied by an element of interest",
        "paper A, equation 4; section 4.1.2, equation 4.4", "Every cell that holds an element counts, the agent's own "
        "included.", lambda reading: reading.own_cell == "counts"),
    Pin("elements that share a cell", ("shared_cell",), "the set of NRES cells occupied by an element of interest",
        "paper A, equation 4; section 4.1.2, equation 4.4", "The sum of equation 4.3 runs over that set, which holds "
        "a cell once however many elements of a kind are in it: this is what is printed. But its weight is “element "
        "i’s importance” (paper A, The Control Problem by Superposition), so that each element may count is open."),
    Pin("cells of a map", (), "N13 signifies a 13 × 13 tile set in ℝ²", "paper B, section 2.1",
        "The cells of an object-vector map tile the plane of o − s. Pairs of the agent's cell and the object's would be"
        " a tile set in four dimensions, and are excluded.", _always),
)

LEARNING = (
    Pin("driver of learning", ("credit",), "following a school other than temporal-difference learning is required for "
        "neoRL", "chapter 4, introduction",
        "A change of cell drives an update (equation 4.8), not every step. Only paper A says “If learners use "
        "Q-learning” (The Control Problem by Superposition); temporal difference is a comparison.",
        lambda reading: reading.choices["credit"] != "step"),
    Pin("credit of events that occurred", ("credit",), "Multiple occurrences of the same event should affect learning "
        "positively", "section 4.1.3, at equation 4.7",
        "ψ(N) is positive for all N ≥ 1, and may grow or not: “All events that happened while at s⁻ should be assigned "
        "equal weight”. Credit by activity adds nothing to section 4.4, and is simplest. Credit for the last event "
        "alone is excluded.",
        lambda reading: reading.choices["credit"] not in ("last", "step")),
    Pin("credit of events that did not occur", ("absent_decay",), "zero occurrences would affect learning negatively "
        "according the result of ψ(0)", "section 4.1.3, at equation 4.7", "ψ(0) < 0; its size is open.",
        lambda reading: reading.learning.absent_decay > 0 and reading.choices["credit"] != "step"),
    Pin("form of ψ(0)", ("absent_form",), "increasing the inference value for events that happened and decreasing the "
        "value otherwise", "section 4.1.3, at equation 4.8",
        "Equation 4.8 with a negative rate moves a value away from its target, which is simplest; a value that decays "
        "towards zero decreases, too."),
    Pin("memory", ("memory", "credit"), "assigning credit to events after each transition s⁻ → s⁺ as a leaky "
        "integrator", "section 4.1.3",
        "What leaks is open. How active an event is, or how often it occurred in the cell, is simplest: section 4.4 "
        "has “how active the corresponding event was before state transition”. Cells left earlier may be remembered "
        "with their events as well: “memory traces” (section 4.4); but no sentence gives credit to them, and their "
        "number is ours."),
    Pin("time constant of activity", ("activity",), "how active the corresponding event was before state transition",
        "section 4.4", "How active an event was may be a leaky integrator rather than its count in the cell. The time "
        "constant is open."),
    Pin("learning rate, α", ("learning_rate",), "is a ‘learning factor’", "section 4.1.3, equation 4.6",
        "No value is given."),
    Pin("discount, γ", ("discount",), "is the scalar discounting factor", "section 3.1, equation 3.2",
        "Between 0 and 1; no value is given. 1 is allowed: a goal reached later is then worth as much."),
    Pin("bootstrapping", ("bootstrap",), "it is still possible to utilize a transition-driven update by inference "
        "inversion", "section 4.1.3, equation 4.8",
        "Equation 4.8 prints γ max Q, so bootstrapping is simplest. A memory of cells does the same work, though, and "
        "whether there are both is open."),
    Pin("goal reached", ("terminal",), "Reaching s* results in a unitary reward R = +1.0", "section 4.1.2",
        "Whether more value can follow is open. Equation 4.8 prints R + γ max Q for every transition, including that "
        "into the goal, which is simplest; otherwise the goal is terminal and worth 1."),
)

OBJECTS = (
    Pin("state and goal of object vectors", ("object_state",),
        "with the self in the center and allocentric direction to external objects", "paper B, section 3",
        "Open, and decisive. The state is the self, always at the centre, and the goal is the object's cell, which is "
        "simplest: “the current parameter configuration of the agent” gives the state (paper A, figure 2), and "
        "the cell “occupied by an element of interest” the value function (paper A, equation 4). Or the same in the "
        "frame of each object. An agent then has to know from step to step which object is which; nothing in the text "
        "says that it does, and the author's later code reports two lists of positions, green and red. So this is "
        "possible, and not the plainest. Or the state is the object's cell and the goal the contact."),
    Pin("transition of object vectors", (), "after each transition s⁻ → s⁺", "section 4.1.3",
        "A state that is always the centre never changes. The self leaves the centre cell when it has moved by half a "
        "cell along an axis, and the map is then centred on it anew; a change of the object's cell if that is the "
        "state.", _always),
    Pin("goal of an object's cell", ("object_reach",), "When the agent encounters an object, it is replaced by a new "
        "object", "paper B, section 3",
        "If the state is the object's cell, the goal is the cell at o − s = 0, which is simplest, or every cell that "
        "the contact of the two overlaps."),
    Pin("range of object-vector cells", ("object_tiled_fraction",),
        "One can also compute a simple object vector cell (OVC) interpretation by vector subtraction",
        "paper B, section 3",
        "Differences of places lie between −1 and 1 board width. It is open whether the N intervals divide all of "
        "that, which is simplest, or less."),
    Pin("cell beyond the range", ("object_beyond",), "most OVC cells have a receptive field up to 30cm away in mice",
        "section 2.2, footnote 4", "An object beyond the range of a map belongs to the outermost cell, which is "
        "simplest, or to none."),
    Pin("grid of object vectors", ("object_centred",), "OVC is centered on the self with an allocentric representation "
        "of other objects", "paper B, figure 4",
        "With N even, the self lies where four cells meet, or the grid is shifted by half a cell, so that the self is "
        "in the middle of one. N equal intervals are simplest."),
    Pin("gain of place cells, paper B", ("place_gain",), "behavior can later be harvested as a weighted sum over the "
        "OVF’s according to priorities", "paper B, section 2.2",
        "Priorities of modalities are not given, and 1:1 is simplest, as in paper C. The author's later code has a "
        "factor for places, with the remark that object-vector values seem three times as high; a drawing on the "
        "author's site has 5."),
)

NETWORKS = (
    Pin("gain of place cells, paper C", ("network_gain",), "1:1 weight ratio between ξ^PC and ξ^OVC",
        "paper C, section 3", "A gain of 1. A drawing of network D on the author's site has 5.",
        lambda reading: reading.network_gain == 1),
    Pin("valence in desire vectors", ("vectors",), "represents the vector sum", "paper C, section 1",
        "Open: whether the Q-vectors that add up hold the valence of their elements. Without it is simplest, since the "
        "desire carries the valence as well; a red creep's would otherwise act twice, and red would attract."),
    Pin("where a desire lies", ("scale",), "e^out = d", "paper C, section 1",
        "At d itself, seen from the agent; no unit is given, and the one of the book is ours."),
    Pin("recursion, r", ("recursion",), "experiment [d] only explores a unitary feedback loop r = −1.0",
        "paper C, section 3", "A weight of −1.", lambda reading: reading.recursion == -1),
    Pin("resolutions, paper C", ("network_resolutions",), "The individual neoRL sub-nodes ξ³, ξ⁷, ξ²³ are trained by "
        "latent learning", "paper C, section 1",
        "The experiments name none. The paper shows nodes of N3, N7 and N23, which is simplest; paper B has primes up "
        "to 13."),
)

WORLD = (
    Pin("creeps and rewards, paper A", (), "the board is restarted with an accompanying [+5] reward. In all "
        "experiments, a constant number of 8 creeps have been used", "paper A, WaterWorld", "8 creeps, +5.", _always),
    Pin("rewards, paper B", (), "Any end-of-episode reward is disabled in the WaterWorld settings",
        "paper B, section 3", "Three objects, with +1 and −1 alone.", _always),
    Pin("objects and rewards, paper C", (), "Three objects move around in the Euclidean plane", "paper C, section 2",
        "As in paper B.", _always),
    Pin("resets of the board", ("resets",), "the board is restarted with an accompanying [+5] reward",
        "paper A, WaterWorld", "Nothing says that the agent is told, and the author's later code restarts the game and "
        "passes positions alone. So nothing happens in the agent, which is simplest, and the leap is one more "
        "transition. Or the agent notices, forgets how it came there, and learns nothing from the leap."),
    Pin("steps per second, paper A", ("paper_a_fps",), "with one run taking somewhat under one hour on a single CPU "
        "core", "paper A, Experiments", "A statement about computing, which need not take as long as what it "
        "simulates. 150,000 steps are 50 minutes at 50 per second, the rate of the author's later code, which is "
        "simplest; 42 at 60; and 83 at 30, the game's own default."),
    Pin("steps per second, papers B and C", ("fps",), "signifying the wall-clock time since the beginning of each run",
        "paper C, section 2", "Minutes on the clock are those of the simulation if it runs in real time. Its rate is "
        "not given, and need not be paper A's; 50 is simplest, as there."),
    Pin("contact", ("contact",), "", "", "Pygame compares whole pixels: rounded since version 2, which is "
        "simplest, and truncated before."),
)

PINS = POLICY_AND_MAPS + LEARNING + OBJECTS + NETWORKS + WORLD
