"""The claims of the thesis: each with its place, the sentence that is judged, and the thesis's own number.

*Demonstrations* stand beside them: experiments of this book on sentences that ask for something and report no result.

Nothing here is computed. `neorl.evidence.claims` judges the claims. Quotations are from the thesis (Leikanger 2022),
shortened where there is a "…".
"""

import math
import operator
from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Bounds:
    """The interval of an estimate that agrees with a claim.

    low, high: its ends, which may be infinite. number: the thesis's own, if it gives one. open: without its ends.
    """

    low: float = -math.inf
    high: float = math.inf
    number: float | None = None
    open: bool = False

    def hold(self, found):
        """Whether the interval of an `Estimate` lies within."""
        return self._below(self.low, found.low) and self._below(found.high, self.high)

    def allow(self, found):
        """Whether the interval of an `Estimate` reaches inside, so that more runs might show the claim."""
        return self._below(self.low, found.high) and self._below(found.low, self.high)

    def _below(self, one, other):
        return (operator.lt if self.open else operator.le)(one, other)

    def __str__(self):
        if math.isinf(self.high):
            text = f"more than {self.low:g}" if self.open else f"{self.low:g} or more"
        elif math.isinf(self.low):
            text = f"less than {self.high:g}" if self.open else f"{self.high:g} or less"
        else:
            text = f"from {self.low:g} to {self.high:g}"
        return text.replace("-", "−")


POSITIVE, NEGATIVE = Bounds(low=0.0, open=True), Bounds(high=0.0, open=True)


@dataclass(frozen=True)
class Statement:
    """One claim, as stated before any result."""

    place: str  # of the quotation, in the thesis
    quotation: str  # the words that the rule judges
    text: str  # the claim in our words
    statistic: str
    thesis: str  # its number, in words
    figure: str  # the label of the figure of this book that shows it
    rule: str  # the function of `neorl.evidence.claims` that judges it
    bounds: Bounds = POSITIVE  # of our number
    also: Mapping[str, Bounds] = field(default_factory=dict)  # of other numbers that the rule compares, by name
    demonstration: bool = False  # an experiment of this book, shown beside the claims and not counted among them


ONE_MAP, MAPS = "paper A, Results, Single layer", "paper A, Results, Multiple resolutions"
GENERAL, BOTH = "paper B, section 3.1", "paper B, section 3.2"
NETWORKS = "paper C, section 3"

STATEMENTS = {
    "A1": Statement(
        ONE_MAP,
        "Brownian motion seems incapable of achieving a single board reset since the accumulated score fluctuates "
        "around 0 for the length of the experiment.",
        "Brownian motion scores about 0 and never resets the board",
        "Accumulated score of the control in 150,000 steps",
        "0", "fig-accumulated", "judge_single_layer",
        Bounds(-5.0, 5.0, number=0.0),  # less than a single reset pays, since the absence of resets is inferred from it
        also={"resets": Bounds(high=1.0)}),
    "A2": Statement(
        ONE_MAP,
        "All neoRL agents perform better than control.",
        "Every single resolution beats Brownian motion",
        "Smallest lead over the control in reward per second",
        "> 0", "fig-accumulated", "judge_single_layer"),
    "A3": Statement(
        ONE_MAP,
        "Agents based on lower NRES resolution initially learn quicker … However, neoRL agents based on lower NRES "
        "resolutions seem to saturate at a lower proficiency.",
        "Coarse maps learn faster at first and saturate lower",
        "Rank correlation of N with the final reward per second",
        "> 0, and < 0 early", "fig-accumulated", "judge_single_layer",
        also={"rise to that of fine maps": Bounds(high=0.5), "rise to own level": Bounds(high=0.1)}),
    "A4": Statement(
        ONE_MAP,
        "For these particular runs, with 8 creeps and during a 150,000 time step interval, the N50 representation "
        "appears to achieve the highest score.",
        "N50 accumulates most in 150,000 steps",
        "Lead of N50 over the best other in reward per second",
        "> 0", "fig-accumulated", "judge_single_layer"),
    "A5": Statement(
        ONE_MAP,
        "it is worth noting how all neoRL agents are comparable in learning speed.",
        "All single resolutions learn about equally fast, though N70 has 49 times the states of N10",
        "Shortest time in which a resolution reaches half of its own final level, divided by the longest",
        "comparable", "fig-accumulated", "judge_single_layer", Bounds(low=0.5), also={"N70 to N10": Bounds(0.5, 2.0)}),
    "A6": Statement(
        MAPS,
        "the multi-res neoRL agent learns quicker, to higher proficiency, than the sum of its parts.",
        "3, 7 and 23 together learn quicker and earn more than the sum of the three alone",
        "Final reward per second together, less the sum of the three alone",
        "> 0", "fig-proficiency", "judge_multiple_layers"),
    "A7": Statement(
        MAPS,
        "The almost 6-fold increase in the number of states … resulted in a 3.5-factor increase in received reward "
        "without increasing training time.",
        "Together they earn 3.5 times as much as N7 and learn at least as fast",
        "Final reward per second together, divided by that of N7",
        "3.5", "fig-proficiency", "judge_multiple_layers",
        Bounds(2.5, 5.0, number=3.5),  # within a factor of the square root of 2
        also={"share of a run sooner": Bounds(low=-1 / 40)}),
    "A8": Statement(
        "section 4.3.1",
        "The multi-resolution neoRL agent across multiple NRES sets performed better than single-resolution neoRL "
        "agents on all accounts such that the agent learned quicker and attained higher proficiency",
        "Several resolutions learn quicker and earn more than each of them alone",
        "Smallest lead, in minutes, of 3, 7 and 23 together at half the final level of the best one alone",
        "> 0", "fig-proficiency", "judge_multiple_layers"),
    "A9": Statement(
        "section 4.4",
        "Online navigation autonomy is possible by combining OVF scaled by elements-of-interest valence, allowing for "
        "marginally improved navigation capabilities over Brownian motion in the WaterWorld environment.",
        "Single maps improve on Brownian motion, but little beside several",
        "Mean final lead of single maps over Brownian motion, divided by that of 3, 7 and 23 together",
        "marginal", "fig-accumulated", "judge_margin", Bounds(high=0.5), also={"lead": POSITIVE}),
    "B1": Statement(
        GENERAL,
        "There is no loss in sample efficiency when utilizing the OVC modality compared to PC modality.",
        "Object-vector agents match place-cell agents",
        "Final reward per second of object-vector cells, divided by that of place cells",
        "comparable", "fig-modal", "judge_modalities", Bounds(0.8, 1.25), also={"whole run": Bounds(low=0.8)}),
    "B2": Statement(
        GENERAL,
        "The multi-res neoRL agent performs better than mono-res neoRL agents for both the PC and the OVC modality.",
        "Several resolutions beat each one, in both modalities",
        "Lead of all maps over the best single one in final reward per second, in the modality where it is less",
        "> 0", "fig-place", "judge_resolutions"),
    "B3": Statement(
        BOTH,
        "The final proficiency of the multi-modal neoRL agent approaches 0.55 [R/s] while the PC neoRL agent barely "
        "reaches 0.29 [R/s].",
        "Both modalities earn 0.55 per second, place cells alone 0.29",
        "Final reward per second of both modalities",
        "0.55, and 0.29 of place cells", "fig-modal", "judge_modalities",
        Bounds(0.44, 0.69, number=0.55), also={"place cells": Bounds(0.23, 0.36, number=0.29)}),  # a factor of 1.25
    "B4": Statement(
        BOTH,
        "The multi-modal neoRL agent reaches final proficiency after 15 min, whereas the PC neoRL agent uses more "
        "than 160 min.",
        "Agents with both modalities reach their final level after 15 minutes, place cells after more than 160",
        "Simulated minutes until the mean of both reaches nine tenths of its final level",
        "15", "fig-modal", "judge_pace",
        Bounds(high=30.0, number=15.0),  # a factor of 2
        also={"place cells": Bounds(low=80.0, number=160.0), "both, less": NEGATIVE}),
    "B5": Statement(
        "paper B, section 3",
        "the agent must catch the last green in a board full of red before the board can be reset and continue beyond "
        "(on average) 1.5 points per reset.",
        "A board of three creeps yields 1.5 points per reset",
        "Green creeps less red ones, taken between resets",
        "1.5", "fig-points", "judge_points", Bounds(1.35, 1.65, number=1.5)),
    "B6": Statement(
        "paper B, section 4",
        "neoRL navigation learns quicker, to higher proficiency, when more information is available to an agent.",
        "Agents with both modalities learn quicker and earn more than with either one",
        "Smallest lead, in minutes, of both modalities at half the final level of the better one alone",
        "> 0", "fig-modal", "judge_modalities"),
    "B7": Statement(
        "chapter 5, on paper B",
        "The neoRL framework is general across NRES modalities, compositional and incremental by additional neoRL "
        "modules",
        "A modality added half-way helps, and costs nothing already learned",
        "Final lead in reward per second over agents without it",
        "> 0", "fig-joining", "judge_joining", also={"kept": Bounds(low=0.9)}, demonstration=True),
    "C1": Statement(
        NETWORKS,
        "The neoRL network from illustration 4a improves navigational proficiency over time; however … a single "
        "desire vector … becomes too simple for proficient navigation.",
        "Network A improves over time but stays weak",
        "Final reward per second of A, less its early one",
        "> 0", "fig-proficiency-networks", "judge_networks", also={"A / C": Bounds(high=0.5)}),
    "C2": Statement(
        NETWORKS,
        "Experiment b demonstrates the effect of separating desires according to valence, resulting in the increased "
        "performance by the neoRL navigational agent.",
        "One desire per colour (B) beats one for all (A)",
        "Lead of B over A in final reward per second",
        "> 0", "fig-proficiency-networks", "judge_networks"),
    "C3": Statement(
        NETWORKS,
        "Agents extracting purpose from multiple depths of the neoRL network, as illustrated in 4c, becomes better "
        "navigators than more superficial agents.",
        "Values from both nodes (C) beat those of the last one (A, B)",
        "Lead of C over the better of A and B in final reward per second",
        "> 0", "fig-proficiency-networks", "judge_networks"),
    "C4": Statement(
        NETWORKS,
        "recursive desires drastically improve the agent's navigational proficiency.",
        "Recursion (D) improves on C drastically",
        "Final reward per second of D, divided by that of C",
        "≫ 1", "fig-proficiency-networks", "judge_networks", Bounds(low=1.5)),
    "C5": Statement(
        NETWORKS,
        "no comparison has been made with alternative approaches for control … Still, any attempt on finding RL or AI "
        "solutions capable of allocentric Euclidean navigation in real-time has failed.",
        "No other method of reinforcement learning or AI navigates this board in real time",
        "Final reward per second of the best alternative, divided by that of the thesis's best agent",
        "none succeeds", "fig-alternatives-curves", "judge_alternatives",
        Bounds(high=1.0), also={"failing": Bounds(low=0.5), "over it": Bounds(high=1.0)}),
    "T1": Statement(
        "paper A, The Control Problem by Superposition",
        "In the neoRL approach, moving rewards or changing agent priorities during an agent's life-time does not "
        "require retraining the agent.",
        "Moving or revaluing elements needs no retraining",
        "Red creeps per minute in the fortieth of the run after they become desired, divided by the same agents' "
        "final rate",
        "1", "fig-revalued", "judge_changes", Bounds(low=0.8),
        also={"rise": POSITIVE, "moved": Bounds(low=0.8), "ignorant, less": POSITIVE}),
    "T2": Statement(
        "section 4.4",
        "Assessing additional NRES maps in the same agent … only results in a linear increase in computation.",
        "Cost grows linearly with maps",
        "Cost of all maps together, divided by the sum of their separate costs",
        "1", "fig-cost", "judge_cost", Bounds(high=1.1, number=1.0)),
    "T3": Statement(
        "section 3.4.2, observation 1",
        "Let a temporal mechanism require knowledge about system states at L separate time steps … The full set of "
        "Markov states required to represent the temporal dynamics becomes O(Ψ^L)",
        "The number of Markov states grows exponentially with the steps that matter, which is true by counting; no "
        "state can be spared",
        "Smallest share of its reward above chance that an agent loses by remembering one step less",
        "> 0", "fig-3-window", "judge_temporality", Bounds(low=0.1)),
    "T4": Statement(
        "section 3.1",
        "Learning the full transition model increases the task according to |S|²·|A|, while Q-learning only requires "
        "the value for each state-action pairs, |S|·|A|.",
        "Q-learning learns S·A values, a transition model S²·A, which is true by counting",
        "Exponent of S in the number of entries of the model",
        "2, and 1 for Q-learning", "fig-3-tables", "judge_tables",
        Bounds(1.9, 2.1, number=2.0), also={"values": Bounds(0.9, 1.1, number=1.0)}),
    "T5": Statement(
        "paper B, section 3",
        "All execution runs smoothly on a single CPU core",
        "One core keeps up with real time, under the load that the machine has besides",
        "Share of a core at 50 steps per second",
        "< 1", "fig-4-realtime", "judge_real_time", Bounds(high=1.0, open=True), also={"steps late": Bounds(high=2.0)}),
    "T6": Statement(
        "section 4.4",
        "Assessing additional NRES maps in the same agent improves navigational capabilities significantly, does not "
        "degrade learning performance",
        "More maps never slow learning",
        "Smallest lead, in minutes, of agents with more maps at half the final level of the best agent with fewer",
        "≥ 0", "fig-more-maps", "judge_more_maps", also={"share of a run sooner": Bounds(low=-1 / 40)}),
    "T7": Statement(
        "chapter 4, introduction",
        "following a school other than temporal-difference learning is required for neoRL.",
        "Persistence is needed: learning at every step fails",
        "Gain of learning at every step over Brownian motion, divided by the gain of learning at changes of cell, of "
        "the agents for which it is greatest",
        "0", "fig-persistence", "judge_persistence", Bounds(high=0.1)),
    "T8": Statement(
        "section 4.4",
        "the direct relation between larger receptive fields and a slower time scale is prominent.",
        "Larger receptive fields go with a slower time scale",
        "Exponent with which the stay in a field grows with its width",
        "direct relation", "fig-time-scale", "judge_time_scale", Bounds(low=0.5),
        also={"longer in the next coarser map": POSITIVE}),
    "T9": Statement(
        "section 4.3.1",
        "Directed exploration is proposed as a plausible explanation for improved learning when navigating according "
        "to additional information.",
        "Several maps explore more of the board than each of them alone, and than Brownian motion",
        "Squares of a 90 × 90 board in which 3, 7 and 23 together are in the first tenth of a run, divided by those of "
        "the best of them alone",
        "> 1", "fig-explored", "judge_exploration", Bounds(low=1.0, open=True)),
    "G1": Statement(
        "paper B, section 1",
        "Navigation has to be efficient (require few interactions for learning new behaviors)",
        "Efficient: after one trial at a new place, agents find it again sooner than Q-learning on the same cells",
        "Seconds of the second trial at a new place in a water maze, divided by those of Q-learning",
        "few", "fig-spaces-pool", "judge_efficiency",
        Bounds(high=0.5), also={"partly": Bounds(high=1.0, open=True), "seconds less than at random": POSITIVE},
        demonstration=True),
    "G2": Statement(
        "paper B, section 3",
        "it is crucial that NRES-oriented navigation can operate based on different Euclidean spaces",
        "General: with one learning rule, agents beat chance in every other space that was tried",
        "Smallest probability, over the worlds, that a run of the agent beats a run of random actions",
        "> 0.5", "fig-spaces-all", "judge_generality", Bounds(low=0.5, open=True), demonstration=True),
    "G3": Statement(
        "paper B, section 3",
        "NeoRL navigation must be … compositional across conceptual components, without any significant decline in "
        "learning efficiency.",
        "Compositional: a map for each feature reaches any combination as directly as one map of both",
        "Steps to a point of a space of two features with a map for each, divided by those with one map of both",
        "1", "fig-spaces-birds", "judge_composition",
        Bounds(high=1.25), also={"partly": Bounds(high=2.0), "random agents": Bounds(low=1.0, open=True)},
        demonstration=True),
    "G4": Statement(
        "chapter 5, on paper B",
        "The neoRL framework is general across NRES modalities, compositional and incremental by additional neoRL "
        "modules",
        "Incremental: a second map added half-way helps a vessel, and costs nothing already learned",
        "Final lead in reward per minute over agents without it",
        "> 0", "fig-spaces-vessel", "judge_extension", also={"kept": Bounds(low=0.9)}, demonstration=True),
    "H1": Statement(
        "section 2.1.2, on figure 2.2",
        "When later motivated by food, however, the rats in the initially unrewarded group started to perform better "
        "than all other subjects.",
        "Latent learning: animals first rewarded on day 11 overtake those rewarded throughout",
        "Errors per day after the first reward, less those of animals rewarded throughout",
        "fewer", "fig-2-errors", "judge_latent_learning",
        NEGATIVE, also={"level": Bounds(high=0.1)}, demonstration=True),
}

CLAIMS = tuple(name for name, statement in STATEMENTS.items() if not statement.demonstration)
DEMONSTRATIONS = tuple(name for name, statement in STATEMENTS.items() if statement.demonstration)
