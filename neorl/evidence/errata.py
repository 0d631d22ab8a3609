"""Errata of the source: errors of the thesis that may mislead a reader, with corrections.

Slips of the pen are not listed, nor is anything that a claim of `neorl.evidence.statements` tests.
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
)
