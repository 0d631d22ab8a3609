"""What the thesis claims: each claim, where it stands, what is measured here, and the thesis's own number.

Nothing here is computed. `neorl.claims` judges the claims, `neorl.ledger` tells what was found.
"""

from typing import NamedTuple


class Statement(NamedTuple):
    """One claim in our words, before anybody has computed anything."""

    place: str  # in the thesis
    text: str
    statistic: str
    thesis: str  # its number
    figure: str = ""  # the label of the figure of this book that shows it
    rule: str = ""  # the function of `neorl.claims` that judges it
    borders: tuple[float, ...] = (0.0,)  # where the rule divides our number


SINGLE, LAYERS = "paper A, Results, single layer, and figure 6", "paper A, Results, multiple resolutions, and figure 7"
EITHER, BOTH = "paper B, section 3.1 and figure 4", "paper B, section 3.2 and figure 5"
NETWORKS = "paper C, section 3 and figure 4e"

STATEMENTS = {
    "A1": Statement(SINGLE, "Brownian motion scores about 0", "Reward per second of the control", "about 0",
                    "fig-accumulated", "judge_single_layer"),
    "A2": Statement(SINGLE, "Every single resolution beats Brownian motion",
                    "Smallest lead over the control in reward per second", "> 0", "fig-accumulated",
                    "judge_single_layer"),
    "A3": Statement(SINGLE, "Coarse maps learn faster at first and saturate lower",
                    "Rank correlation of N with the final reward per second", "> 0, and < 0 early", "fig-accumulated",
                    "judge_single_layer"),
    "A4": Statement(SINGLE, "N50 accumulates most in 150,000 steps",
                    "Lead of N50 over the best other in reward per second", "> 0", "fig-accumulated",
                    "judge_single_layer"),
    "A5": Statement(SINGLE, "N70 learns about as fast as N10, with 49 times the states",
                    "Reward accumulated by N70, divided by that of N10", "comparable", "fig-accumulated",
                    "judge_single_layer", (0.5, 2.0)),
    "A6": Statement(LAYERS, "3, 7 and 23 together beat the sum of the three alone",
                    "Final reward per second together, less the sum of the three alone", "> 0", "fig-proficiency",
                    "judge_multiple_layers"),
    "A7": Statement(LAYERS, "Together they make 3.5 times as much as N7, and learn at least as fast",
                    "Final reward per second together, divided by that of N7", "3.5", "fig-proficiency",
                    "judge_multiple_layers", (3.5,)),
    "B1": Statement(EITHER, "Object-vector agents match place-cell agents",
                    "Final reward per second of object-vector cells, divided by that of place cells", "comparable",
                    "fig-modal", "judge_modalities", (0.5, 2.0)),
    "B2": Statement(EITHER, "Several resolutions beat each one, in both modalities",
                    "Lead of all maps over the best single one in final reward per second, in the modality where it is "
                    "less", "> 0", "fig-place", "judge_modalities"),
    "B3": Statement(BOTH, "Both modalities make 0.55 a second, place cells alone 0.29",
                    "Final reward per second of both, divided by that of place cells", "1.9", "fig-modal",
                    "judge_modalities", (1.9,)),
    "B4": Statement(BOTH, "Both make their final level after 15 minutes, place cells after more than 160",
                    "Simulated minutes that both take", "15", "fig-modal", "judge_pace", (30.0,)),
    "C1": Statement(NETWORKS, "Network A improves over time but stays weak",
                    "Final reward per second of A, less its early one", "> 0", "fig-proficiency-networks",
                    "judge_networks"),
    "C2": Statement(NETWORKS, "A desire for each colour (B) beats one for all (A)",
                    "Lead of B over A in final reward per second", "> 0", "fig-proficiency-networks", "judge_networks"),
    "C3": Statement(NETWORKS, "Values from both nodes (C) beat those of the last one (B)",
                    "Lead of C over B in final reward per second", "> 0", "fig-proficiency-networks", "judge_networks"),
    "C4": Statement(NETWORKS, "Recursion (D) improves on C drastically",
                    "Final reward per second of D, divided by that of C", "≫ 1", "fig-proficiency-networks",
                    "judge_networks", (1.5,)),
    "T1": Statement("section 4.1.2", "Moving or revaluing elements needs no retraining",
                    "Red creeps a minute in the fortieth of the run after they come to be wanted, less what agents "
                    "take that have wanted them from the start", "≥ 0", "fig-revalued", "judge_revaluing"),
    "T2": Statement("section 4.4", "Cost grows linearly with maps",
                    "What all maps cost together, divided by the sum of what each costs alone", "1", "fig-cost",
                    "judge_cost", (1.1,)),
    "T3": Statement("section 3.4.2, observation 1", "The states that a Markov process needs grow exponentially with "
                    "the steps that matter", "Power of Ψ by which the states met grow with each step L that matters, "
                    "in the alphabet where it is furthest from the thesis's", "1, as in Ψ^L", "fig-3-states",
                    "judge_temporality", (0.9, 1.1)),
    "T4": Statement("section 3.1", "Q-learning learns S·A values where a model of the transitions has S²·A",
                    "Power of S by which the entries of the model grow", "2, and 1 for Q-learning", "fig-3-tables",
                    "judge_tables", (1.9, 2.1)),
    "T5": Statement("paper A, Experiments, and paper B, section 3", "One core keeps up with real time",
                    "Share of a core at 50 steps a second", "< 1", "fig-4-realtime", "judge_real_time", (1.0,)),
    "H1": Statement("section 2.1.2, figure 2.2", "Latent learning: who is rewarded from day 11 on overtakes who was "
                    "throughout", "Errors a day after the first reward, less those of who was rewarded throughout",
                    "fewer", "fig-2-errors", "judge_latent_learning"),
}
