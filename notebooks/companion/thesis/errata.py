"""Errata of the source: errors of the thesis that may mislead a reader, with corrections.

Slips of the pen are not listed.
"""

from typing import NamedTuple


class Erratum(NamedTuple):
    """One error of the thesis (Leikanger 2022)."""

    place: str
    says: str
    right: str


ERRATA = (
    Erratum("paper A, Results, Multiple resolutions; section 4.3.1",
            "“The almost 6-fold increase in the number of states (from 7² = 49 to 3² + 7² + 23² = 290 states)”",
            "3² + 7² + 23² = 587, as the Experiments of the same paper say (“587 learners”): twelvefold"),
    Erratum("paper A, Interaction learning by RL in AI",
            "Boltzmann addition and multiplication are cited as “(Wiener, 1948)”",
            "they are of Wiering and van Hasselt (2008), whom the next sentence names; Wiener's book has neither"),
    Erratum("paper A, WaterWorld", "“the environment is listed as unsolved (OpenAI, 2020)”",
            "the reference given is for another environment, Snake v0"),
    Erratum("paper C, caption of figure 4b; caption of figure 4.7b",
            "the two desire vectors for red and green come “from ξ^OVC”",
            "from ξ^PC, as section 2 of the paper and their names say"),
    Erratum("paper C, section 1", "“Operant Value-function Components (OVC)”",
            "everywhere else these are operant (or orthogonal) value functions, OVF, and OVC is the object-vector "
            "cell, also in the ξ^OVC of the same paper"),
    Erratum("paper C, section 1", "“Thorndike's law-an-effect”, and operant conditioning “from E. C. Skinner”",
            "the law of effect; B. F. Skinner, as in section 2.1.1"),
    Erratum("section 4.1.3", "“Skinner's discriminatory stimuli S^R – the pre-condition for the inference”",
            "S^D, as in section 2.1.1; S^R is the conditioning signal that comes after, as the same sentence says"),
    Erratum("section 2.1.1", "“negatively reinforcing, decreasing the drive for choosing action R”",
            "what decreases it is punishment; negative reinforcement strengthens an action that ends something "
            "unpleasant"),
    Erratum("section 2.1.2", "Tolman and Honzik “measured the time it took for rats to escape a maze”",
            "figure 2.2 shows errors: entries into blind alleys"),
    Erratum("section 2.1.2 and figure 2.2; paper B, figure 1; paper C, section 1",
            "the experiment with food from day 11 on is cited as “Degrees of hunger, reward and non-reward, and maze "
            "learning in rats”",
            "it is in another paper by Tolman and Honzik of 1930, “Introduction and removal of reward, and maze "
            "performance in rats”"),
    Erratum("section 2.2", "a membrane “that is impermeable to electrons”",
            "to ions: the membrane potential is a difference in their concentrations, which the ion pumps sustain"),
    Erratum("section 2.2", "“Some neurotransmitters activate voltage-gated channels”",
            "ligand-gated channels; voltage opens the channels along the axon"),
    Erratum("caption of table 2.1",
            "the vector cells “respond to conditions that combine the current heading with distance”",
            "an allocentric direction with a distance, as the table itself says; heading is coded by head-direction "
            "cells"),
    Erratum("section 4.1.1, equation 4.2",
            "Kolmogorov's paper of 1956 is cited for the sum of functions of one variable",
            "it is in his paper of 1957, “On the representation of continuous functions of many variables by "
            "superposition of continuous functions of one variable and addition”"),
    Erratum("section 4.3.1",
            "maps in the brain “steadily increase in resolution along the dorsal-to-ventral axis of the hippocampus”",
            "they decrease: fields grow from the dorsal to the ventral end"),
    Erratum("paper B, section 3", "“(on average) 1.5 points per reset”",
            "1.5 is the expected number of green creeps among three (3 × ½); on a board with one at least it is 12/7. "
            "As a creep taken is replaced by a green one with a probability of ½, the points from one reset to the "
            "next are on average twice that, 24/7, whatever the agent does"),
    Erratum("paper C, section 1", "“Edward C. Tolman (1866-1959)”", "1886–1959, as in section 2.1.2"),
)
