"""The multiverse of readings: every choice that the thesis leaves open, varied together, and what it makes of claims.

1. A *reading* chooses everything that is open. What is plausible is stated beforehand, as a prior for each choice: a
   distribution, or levels of which each is as likely as it is often listed. Choices are independent.
2. A design is a scrambled Sobol sequence through the priors, so that any power of two readings fills their space.
3. Every reading lives the conditions of all three papers and is judged by the rules of `neorl.claims`: a claim *holds*
   where its verdict is "reproduced", is *undecided* while it is open, and *fails* otherwise, also where agents have
   learned nothing to test it by.
"""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from scipy import stats
from scipy.stats import qmc
from sklearn.ensemble import RandomForestRegressor
from sklearn.inspection import permutation_importance
from sklearn.model_selection import KFold

from neorl import checks, papers
from neorl.agent import CREDITS, IDLE, WEIGHTINGS, Agent, Desire, Learning, Node, Policy
from neorl.claims import (judge_modalities, judge_multiple_layers, judge_networks, judge_pace, judge_revaluing,
                          judge_single_layer)
from neorl.horde import OWN_CELL
from neorl.statistics import Estimate, difference, estimate
from neorl.store import Condition
from neorl.waterworld import CONTACTS, WaterWorld

SINGLE, LAYERS, PRIMES = (10, 30, 50, 70, 90), (3, 7, 23), papers.PRIMES
VECTORS = ("by size", "signed", "incoming")
PAPER_FPS = 50  # at which lengths are told
LENGTHS = {"A": 150_000, "B": 600_000, "C": 300_000}  # of the papers' runs, in steps
LONGER = 16  # times as long do agents live whose time to their final level is taken
CONTROLS = 8  # times as many runs of Brownian motion, which most readings share


@dataclass(frozen=True)
class Reading:
    """One reading of all that the thesis leaves open; the defaults are those of the book.

    credit: one of `agent.CREDITS`, or "step" for temporal difference, to which `absence`, `trace` and `bootstrap` do
        not apply. bootstrap: always, where `trace` is 1 and nothing would be passed on otherwise. idle: always "random"
        where `exploration` is 0 and the agent would never move otherwise.
    coverage: share of their range that maps cover. place_gain: of place cells where object-vector cells have 1.
    vectors: what a desire vector adds up. "by size", "signed" (see `Desire`), or "incoming": by size, but for the one
        that recurs, which is signed and of what came in from other nodes alone.
    The other fields are those of `Learning`, `Policy`, `Node`, `Desire`, `Agent` and `WaterWorld` of the same names.
    """

    learning_rate: float = Learning.learning_rate
    discount: float = Learning.discount
    credit: str = Learning.credit
    absence: float = Learning.absence
    trace: int = Learning.trace
    bootstrap: bool = Learning.bootstrap
    terminal: bool = Learning.terminal
    own_cell: str = Agent.own_cell
    coverage: float = papers.COVERAGE
    weighting: str = Node.weighting
    exploration: float = Policy.exploration
    idle: str = Policy.idle
    place_gain: float = 1.0
    vectors: str = "by size"
    scale: float = Desire.scale
    recursion: float = -1.0
    fps: int = WaterWorld.fps
    contact: str = WaterWorld.contact

    @property
    def learning(self):
        """Its `Learning`."""
        rule = Learning(self.learning_rate, self.discount, terminal=self.terminal)
        if self.credit == "step":
            return replace(rule, driver="step")
        return replace(rule, credit=self.credit, absence=self.absence, trace=self.trace,
                       bootstrap=self.bootstrap or self.trace == 1)

    @property
    def agents(self):
        """The makers' arguments that all its agents share."""
        policy = Policy(self.exploration, self.idle if self.exploration else "random")
        return {"learning": self.learning, "policy": policy, "own_cell": self.own_cell, "coverage": self.coverage,
                "weighting": self.weighting}


PLAINEST = Reading(coverage=1.0, weighting="equal", exploration=0.0)  # nothing that the thesis does not ask for


class Choice(NamedTuple):
    """How a field of `Reading` is varied."""

    label: str
    prior: object  # levels, or a distribution of `scipy.stats`
    papers: str  # the first letters of the claims that depend on it

    @property
    def levels(self):
        """What it is chosen from, in words."""
        if isinstance(self.prior, tuple):
            return ", ".join(map(self.words, dict.fromkeys(self.prior)))
        return " … ".join(map(self.words, self.prior.support()))

    @staticmethod
    def words(value):
        """A value in words."""
        if isinstance(value, bool):
            return "yes" if value else "no"
        return value if isinstance(value, str) else f"{value:.3g}".replace("-", "−")

    def at(self, share):
        """The value below which a share in [0, 1) of the prior lies."""
        if isinstance(self.prior, tuple):
            return self.prior[int(share * len(self.prior))]
        return float(self.prior.ppf(share))

    def place(self, value):
        """Where a value lies between the ends of the prior, from 0 to 1."""
        if isinstance(self.prior, tuple):
            levels = list(dict.fromkeys(self.prior))
            return levels.index(value) / (len(levels) - 1)
        return float(self.prior.cdf(value))


CHOICES = {
    "learning_rate": Choice("learning rate, α", stats.loguniform(0.003, 0.3), "ABCT"),
    "discount": Choice("discount, γ", stats.uniform(0.5, 0.45), "ABCT"),
    "credit": Choice("credit, ψ", (*CREDITS, "step"), "ABCT"),
    "absence": Choice("fading, −ψ(0)", (0.0, 0.0, 0.1, 0.3), "ABCT"),
    "trace": Choice("cells in trace", (1, 1, 10, 100), "ABCT"),
    "bootstrap": Choice("bootstrapping", (True, False), "ABCT"),
    "terminal": Choice("goals terminal", (True, False), "ABCT"),
    "own_cell": Choice("own cell", OWN_CELL, "ABCT"),
    "coverage": Choice("map range", (1.0, 0.5), "ABCT"),
    "weighting": Choice("map weights", WEIGHTINGS, "ABCT"),
    "exploration": Choice("exploration, ε", (0.0, 0.0, 0.02, 0.1), "ABCT"),
    "idle": Choice("when idle", IDLE, "ABCT"),
    "place_gain": Choice("gain of place", (1.0, 1.0, 2.0, 5.0), "BCT"),
    "vectors": Choice("desire vectors", VECTORS, "C"),
    "scale": Choice("desire scale", stats.loguniform(0.5, 4.0), "C"),
    "recursion": Choice("recursion, r", (-3.0, -2.0, -1.0, -1.0, -1.0, -1.0, -0.5, 1.0), "C"),
    "fps": Choice("steps a second", (30, 50, 60), "ABCT"),
    "contact": Choice("contact", CONTACTS, "ABCT"),
}


def design(points, seed=0):
    """So many plausible readings, a list of `Reading`.

    Raises ValueError unless points is a power of two, of which any is a part of the next.
    """
    checks.integer("points", points, at_least=2)
    if points & (points - 1):
        raise ValueError(f"points is {points}, allowed are powers of two")
    shares = qmc.Sobol(len(CHOICES), rng=np.random.default_rng(seed)).random(points)
    return [Reading(**{name: choice.at(share) for (name, choice), share in zip(CHOICES.items(), row)})
            for row in shares]


def conditions(reading, steps, runs, seed=0):
    """The conditions that a reading is judged by: {name: `Condition`}.

    steps: of a run at 50 steps a second, but no more than the paper's; papers B and C live the same simulated time at
    any rate. For B4 agents live 16 times as long, half as many runs and at least two, unless paper B's are as long.
    """
    eight, three = (WaterWorld(n_creeps=n, win_reward=win, fps=reading.fps, contact=reading.contact)
                    for n, win in ((8, 5.0), (3, 0.0)))
    each = reading.agents

    def living(agent, paper, length=steps, runs=runs):
        world, length = (eight if paper == "A" else three), min(length, LENGTHS[paper])
        length = length if paper == "A" else max(1, round(length * reading.fps / PAPER_FPS))
        return Condition(agent, world, length, runs, seed)

    found = {("single", n): living(papers.place_cells([n], **each), "A") for n in SINGLE}
    found["brownian"] = living(papers.brownian(), "A", runs=CONTROLS * runs)
    found |= {("layer", n): living(papers.place_cells([n], **each), "A") for n in LAYERS}
    found["layers"] = living(papers.place_cells(LAYERS, **each), "A")
    for name, chosen in {**{n: [n] for n in PRIMES}, "all": PRIMES}.items():
        found["place", name] = living(papers.place_cells(chosen, **each), "B")
        found["objects", name] = living(papers.object_vector_cells(chosen, **each), "B")
    both = papers.multimodal(PRIMES, place_gain=reading.place_gain, **each)
    found["both"] = living(both, "B")
    longer = {"length": LONGER * steps, "runs": max(2, runs // 2)} if steps < LENGTHS["B"] else {}
    found |= {("pace", name): living(agent, "B", **longer)
              for name, agent in (("place", found["place", "all"].agent), ("both", both))}
    found |= {("network", name): living(agent, "C") for name, agent in networks(reading).items()}
    wanting = replace(both, desires=[replace(desire, valence=1.0) for desire in both.desires])
    found["throughout"] = replace(found["both"], agent=wanting)
    found["revalued"] = replace(found["both"], changes=((found["both"].steps // 2, wanting),))
    return found


def networks(reading):
    """Networks A to D of paper C under a reading: {name: `Agent`}."""
    shared = {"scale": reading.scale, "signed": reading.vectors == "signed", **reading.agents}
    adding = {"place_gain": reading.place_gain, **shared}
    made = {"A": papers.network_a(**shared), "B": papers.network_b(**shared), "C": papers.network_c(**adding),
            "D": papers.network_d(recursion=reading.recursion, **adding)}
    if reading.vectors == "incoming":
        *others, recurring = made["D"].desires
        made["D"] = replace(made["D"], desires=[*others, replace(recurring, of=("PC",), signed=True)])
    return made


def judge(results):
    """The claims under a reading, from the results of its conditions: {name of the claim: `Claim`}."""
    group = {name: {key[1]: result for key, result in results.items() if key[0] == name}
             for name in ("single", "layer", "place", "objects", "pace", "network")}
    judged = [*judge_single_layer(group["single"], results["brownian"]),
              *judge_multiple_layers(group["layer"], results["layers"]),
              *judge_modalities(group["place"], group["objects"], results["both"]),
              judge_pace(**group["pace"]),
              *judge_networks(*group["network"].values()),
              judge_revaluing(results["revalued"], results["throughout"])]
    return {claim.name: claim for claim in judged}


def outcome(claim):
    """Whether a claim "holds", is "undecided" or "fails"."""
    return "holds" if claim.outcome == "reproduced" else "undecided" if claim.open else "fails"


def shares(judged):
    """How often each claim holds: {name: {"holds", "undecided", "untestable", "readings"}}, counts of readings.

    judged: {name: `Claim`} for each reading.
    """
    found = {}
    for name in judged[0]:
        outcomes = [outcome(claims[name]) for claims in judged]
        found[name] = {"holds": outcomes.count("holds"), "undecided": outcomes.count("undecided"),
                       "untestable": sum(claims[name].outcome == "not testable" for claims in judged),
                       "readings": len(judged)}
    return found


def held(claims):
    """The names of those of the claims {name: `Claim`} that hold."""
    return [name for name, claim in claims.items() if outcome(claim) == "holds"]


class Support(NamedTuple):
    """How many claims hold at one level of a choice, and by how much that leads the level of the plainest reading."""

    choice: str
    level: str
    value: object
    is_plainest: bool
    held: float
    lead: Estimate


def support(readings, judged):
    """A `Support` for each level of each choice, the mean over all readings that have it.

    A choice without levels is cut into quarters of its prior, the value of each being its median. There is no support
    for a level that no reading has.
    """
    counts = np.array([len(held(claims)) for claims in judged])
    found = []
    for name, choice in CHOICES.items():
        if isinstance(choice.prior, tuple):
            values = list(dict.fromkeys(choice.prior))
            levels = list(map(choice.words, values))
            plainest, *at = [values.index(getattr(reading, name)) for reading in [PLAINEST, *readings]]
        else:
            values = [choice.at((2 * quarter + 1) / 8) for quarter in range(4)]
            ends = [choice.words(choice.prior.ppf(quarter / 4)) for quarter in range(5)]
            levels = [" … ".join(pair) for pair in zip(ends, ends[1:])]
            plainest, *at = [min(int(4 * choice.place(getattr(reading, name))), 3) for reading in [PLAINEST, *readings]]
        at = np.array(at)
        for level, (value, words) in enumerate(zip(values, levels)):
            if np.any(at == level) and np.any(at == plainest):
                lead = estimate(difference, counts[at == level], counts[at == plainest])
                found.append(Support(name, words, value, level == plainest, counts[at == level].mean(), lead))
    return found


def leading(supports):
    """The plainest reading but for each choice's level, the nearest to it in the prior, that clearly leads it."""
    levels = {each.choice: each.value for each in reversed(supports) if each.lead.low > 0}
    return replace(PLAINEST, **levels)


def importance(readings, judged, name, seed=0):
    """How much each choice matters for the number of a claim: ({name of the choice: importance}, R²).

    A random forest predicts the rank that the number has among all readings. Its importance is what the R² of the
    forest at readings that it has not seen loses when the values of one choice are shuffled (Breiman 2001), the mean
    over four folds of the readings (fewer if there are not two in each); R² is what there is to lose.
    """
    chosen = [key for key, choice in CHOICES.items() if name[0] in choice.papers]
    places = np.array([[CHOICES[key].place(getattr(reading, key)) for key in chosen] for reading in readings])
    ranks = stats.rankdata([claims[name].here.value for claims in judged]) / len(judged)
    lost, explained = [], []
    for learned, unseen in KFold(min(4, len(readings) // 2), shuffle=True, random_state=seed).split(places):
        forest = RandomForestRegressor(50, random_state=seed).fit(places[learned], ranks[learned])
        found = permutation_importance(forest, places[unseen], ranks[unseen], n_repeats=3, random_state=seed)
        lost.append(found.importances_mean)
        explained.append(forest.score(places[unseen], ranks[unseen]))
    return dict(zip(chosen, np.mean(lost, axis=0))), float(np.mean(explained))
