"""What the text of the thesis fixes, sentence by sentence, and what it leaves open.

1. A `Pin` is one choice in building the agents, with the sentence of the thesis that bears on it.
2. A choice is *pinned* if the sentence excludes a value, and then a test says whether a
   `neorl.evidence.reading.Reading` obeys it. Otherwise it is *open*, also if there is no such sentence.
3. A choice that several sentences pin has several pins, and a reading has to obey each.
4. Only the text decides. The pins were written down before any reading was judged by them, and results change none.

Quotations are verbatim, but for mathematics, which is set in plain characters; square brackets are the source's.
"""

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class Pin:
    """One choice, and the sentence of the thesis that bears on it.

    fields: of `Reading`, that make the choice; () for what holds in every reading. quotation, place: the sentence and
    where it stands, "" if there is none. follows: what it excludes, or what it leaves open and which value is plainest.
    allows: of a reading, whether it obeys the sentence; None if the choice is open.
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


@dataclass(frozen=True)
class Agreement:
    """Whether a reading obeys the text: true if it breaks no pin. `broken` are those that it breaks."""

    broken: tuple[Pin, ...]

    def __bool__(self):
        return not self.broken

    def __str__(self):
        if not self.broken:
            return "within the text"
        return "; ".join(f"{pin.choice}: “{pin.quotation}” ({pin.place})" for pin in self.broken)


def agreement(reading):
    """The `Agreement` of a `Reading` with the text."""
    return Agreement(tuple(pin for pin in PINS if pin.allows and not pin.allows(reading)))


def table():
    """All pins as a Markdown table, what is pinned first."""
    rows = ["| Choice | What the text says | Where | So | Status |", "|---|---|---|---|---|"]
    for status in ("pinned", "open"):
        rows += [f"| {pin.choice} | {f'“{pin.quotation}”' if pin.quotation else '–'} | {pin.place or '–'} | "
                 f"{pin.follows} | {status} |" for pin in PINS if pin.status == status]
    return "\n".join(rows)


def _always(_):
    """The test of what no reading can choose otherwise."""
    return True


POLICY_AND_MAPS = (
    Pin("policy", ("exploration",), "my epsilon-free exploration", "Acknowledgements",
        "ε = 0: the action of highest value is taken, as in a = argmax Q_tot(s, a) of paper A (The Control Problem by "
        "Superposition). Section 4.3.1, too, sets directed exploration against ε-greedy policies.",
        lambda reading: reading.exploration == 0),
    Pin("action when idle", ("when_indifferent",),
        "Basal actions affect the agent by accelerating it in the cardinal directions, [N, S, E, W].",
        "paper A, WaterWorld",
        "The no-op is no action of the agent, and equal values are a tie. The draw among them is uniform: “Learning "
        "can be regarded as inserting bias into this stochastic process” (section 4.1.1). With ε = 0 the agent would "
        "otherwise rest where it starts for good, and no event would occur to learn from. The author's later code does "
        "nothing while values add up to zero.",
        lambda reading: reading.when_indifferent == "random"),
    Pin("range of place cells", ("tiled_fraction",), "Each axis is divided into N = 5 equal intervals",
        "paper B, figure 3",
        "Maps of places cut the whole board into equal cells; so do figure 2 and Results of paper A.",
        lambda reading: reading.tiled_fraction == 1),
    Pin("weight of a map", ("weighting",), "the contribution of each learner is inversely proportional to the size of "
        "its receptive field", "paper A, Experiments",
        "Weights are proportional to the resolution N if a size is a width, the plainest, or to N² if it is an area; "
        "equal weights are excluded. Paper B takes this over.",
        lambda reading: reading.weighting in ("resolution", "cells")),
    Pin("elements in the agent's own cell", ("own_cell",), "the set of NRES cells occupied by an element of interest",
        "paper A, equation 4; section 4.1.2, equation 4.4", "Every cell that holds an element counts, the agent's own "
        "included.", lambda reading: reading.own_cell == "counts"),
    Pin("state of a map", (), "N13 signifies a 13 × 13 tile set in ℝ²", "paper B, section 2.1",
        "The state of object-vector cells is a cell of the plane of o − s. Pairs of the agent's cell and the object's "
        "would be a tile set in four dimensions, and are excluded.", _always),
)

LEARNING = (
    Pin("driver of learning", ("credit",), "following a school other than temporal-difference learning is required for "
        "neoRL", "chapter 4, introduction",
        "A change of cell drives an update (equation 4.8), and not every step. Paper A alone says “If learners use "
        "Q-learning” (The Control Problem by Superposition); temporal difference is a comparison.",
        lambda reading: reading.credit != "step"),
    Pin("credit of events that occurred", ("credit",), "Multiple occurrences of the same event should affect learning "
        "positively", "section 4.1.3, at equation 4.7",
        "ψ(N) is positive for all N ≥ 1, and grows or not. The plainest is equal: “All events that happened while at "
        "s⁻ should be assigned equal weight”. Credit for the last event alone is excluded.",
        lambda reading: reading.credit not in ("last", "step")),
    Pin("credit of events that did not occur", ("absent_decay",), "zero occurrences would affect learning negatively "
        "according the result of ψ(0)", "section 4.1.3, at equation 4.7", "ψ(0) < 0; its size is open.",
        lambda reading: reading.absent_decay > 0 and reading.credit != "step"),
    Pin("form of ψ(0)", ("absent_form",), "increasing the inference value for events that happened and decreasing the "
        "value otherwise", "section 4.1.3, at equation 4.8",
        "Equation 4.8 with a negative rate moves a value away from its target, which is the plainest; a value that "
        "decays towards zero decreases, too."),
    Pin("memory", ("memory", "credit"), "assigning credit to events after each transition s⁻ → s⁺ as a leaky "
        "integrator", "section 4.1.3",
        "Either the cells left earlier are remembered with their events, or how active an event was, or both. "
        "Section 4.4 has “an update rule based on the persistence school and memory traces”. How long is open; the "
        "plainest remembers cells.",
        lambda reading: (reading.memory > 0 or reading.credit == "activity") and reading.credit != "step"),
    Pin("time of memory", ("memory_unit",), "assigning credit to events after each transition", "section 4.1.3",
        "Memory fades with each transition, the plainest, or with time."),
    Pin("value in memory", ("memory_value",), "inferences are updated according to how active the corresponding event "
        "was before state transition", "section 4.4",
        "Earlier cells learn at a faded rate: towards 1, which is the plainest, or towards γ^k if left k cells ago."),
    Pin("time constant of activity", ("activity",), "how active the corresponding event was before state transition",
        "section 4.4", "How active an event was may be a leaky integrator, and not its count in the cell. The time "
        "constant is open."),
    Pin("learning rate, α", ("learning_rate",), "is a ‘learning factor’", "section 4.1.3, equation 4.6",
        "No value is given."),
    Pin("discount, γ", ("discount",), "is the scalar discounting factor", "section 3.1, equation 3.2",
        "Between 0 and 1; no value is given."),
    Pin("bootstrapping", ("bootstrap",), "it is still possible to utilize a transition-driven update by inference "
        "inversion", "section 4.1.3, equation 4.8",
        "Equation 4.8 prints γ max Q, so the plainest bootstraps. A memory of cells does the same work, though, and "
        "whether both are there is open."),
    Pin("goal reached", ("terminal",), "Reaching s* results in a unitary reward R = +1.0", "section 4.1.2",
        "Whether more can follow is open. Equation 4.8 prints R + γ max Q for every transition, also into the goal, "
        "which is the plainest; otherwise the goal is terminal and worth 1."),
)

OBJECTS = (
    Pin("range of object-vector cells", ("object_tiled_fraction",),
        "One can also compute a simple object vector cell (OVC) interpretation by vector subtraction",
        "paper B, section 3",
        "Differences of places lie between −1 and 1 board width. Whether N intervals divide all of that, the plainest, "
        "or less, and what lies beyond belongs to the outermost, is open."),
    Pin("transitions of object vectors", ("causes",), "the learning agent should look for the cause of the "
        "transition rather than delving into one’s own actions", "section 4.1.2",
        "Each change of an object's cell is a transition to learn from, which is the plainest, or only one that the "
        "agent's own motion is a cause of."),
    Pin("capture", ("capture",), "When the agent encounters an object, it is replaced by a new object",
        "paper B, section 3",
        "To encounter an object is to be where it is, so the plainest is an arrival at o − s = 0; or its vector leaps "
        "to the new object's, which is learned like any change of cell; or neither is learned."),
    Pin("objects with a vector", ("attention",), "OVC is centered on the self with an allocentric representation of "
        "other objects", "paper B, figure 4", "Each object has a vector to learn from, which is the plainest, or one "
        "at a time: the nearest, or the nearest green one."),
    Pin("gain of place cells, paper B", ("place_gain",), "behavior can later be harvested as a weighted sum over the "
        "OVF’s according to priorities", "paper B, section 2.2",
        "Priorities of modalities are not given, and the plainest is 1 : 1, as in paper C. The author's later code has "
        "a factor for places; a drawing on the author's site has 5."),
)

NETWORKS = (
    Pin("gain of place cells, paper C", ("network_gain",), "1:1 weight ratio between ξPC and ξOVC",
        "paper C, section 3", "A gain of 1. A drawing of network D on the author's site has 5.",
        lambda reading: reading.network_gain == 1),
    Pin("desire vector", ("vectors",), "represents the vector sum", "paper C, section 1",
        "Q-vectors add up as they are, with the sign of each element's valence.",
        lambda reading: reading.vectors == "signed"),
    Pin("where a desire lies", ("scale",), "e^out = d", "paper C, section 1",
        "At d itself, seen from the agent: a scale of 1. The unit of length is ours, the width of the board.",
        lambda reading: reading.scale == 1),
    Pin("recursion, r", ("recursion",), "experiment [d] only explores a unitary feedback loop r = −1.0",
        "paper C, section 3", "A weight of −1.", lambda reading: reading.recursion == -1),
    Pin("resolutions, paper C", ("network_resolutions",), "The individual neoRL sub-nodes ξ³, ξ⁷, ξ²³ are trained by "
        "latent learning", "paper C, section 1",
        "The experiments name none. The paper shows nodes of N3, N7 and N23, the plainest; paper B has primes up to "
        "13."),
)

WORLD = (
    Pin("creeps and rewards, paper A", (), "the board is restarted with an accompanying [+5] reward. In all "
        "experiments, a constant number of 8 creeps have been used", "paper A, WaterWorld", "8 creeps, +5.", _always),
    Pin("rewards, paper B", (), "Any end-of-episode reward is disabled in the WaterWorld settings",
        "paper B, section 3", "Three objects, +1 and −1 alone.", _always),
    Pin("objects and rewards, paper C", (), "Three objects move around in the Euclidean plane", "paper C, section 2",
        "As in paper B.", _always),
    Pin("steps per second", ("fps",), "with one run taking somewhat under one hour on a single CPU core",
        "paper A, Experiments", "150,000 steps are 50 minutes at 50 per second, the plainest; 83 at 30; 42 at 60."),
    Pin("contact", ("contact",), "", "", "Pygame compares whole pixels: rounded since version 2, the plainest, and "
        "truncated before."),
)

PINS = POLICY_AND_MAPS + LEARNING + OBJECTS + NETWORKS + WORLD
