"""A reading of the thesis: a value for every choice, the agents and experiments that follow, and their judgement.

1. A `Reading` makes every choice that the text pins or leaves open (`notebooks/companion/thesis/pins.toml`).
2. Its *conditions* are the experiments of the papers under it, in groups, cheap ones first.
3. The rules of `companion.thesis.claims` judge it, on every claim for which the available conditions suffice.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import Annotated, Any

from neorl.agents import papers
from neorl import CALIBRATED, GREEDY, Agent, Condition, Learning, Node, Policy, WaterWorld
from neorl.common import checks
from neorl.common.checks import OneOf
from companion.thesis import claims
from companion.thesis.statements import STATEMENTS

SINGLE, LAYERS, PRIMES = (10, 30, 50, 70, 90), papers.LAYERS, papers.PRIMES
VECTORS = ("by size", "signed")
PAPER_FPS = 50  # steps per second at which lengths are given
LENGTHS = {"A": 150_000, "B": 600_000, "C": 300_000}  # of the papers' runs, in steps
LONGER = 16  # times as long are the runs that measure the time to the final level
BLOCKS = 8  # times as long as paper A's are the runs that show where single maps end
CONTROLS = 8  # times as many runs of Brownian motion, which most readings share

# What network C is made of: its two nodes, and both side by side, with the names that pages give them.
NODES = {"places": "places alone", "objects": "object vectors alone", "one layer": "both in one layer"}
A_LITTLE = 0.02  # share of actions at random, of networks that may stand at a wall for ever
PASTS = ("none", "green", "papers")  # what agents desired while they learned: nothing, green, or green and no red

# The conditions of each group.
GROUPS = {
    "layers": (("brownian", 8), *(("layer", n) for n in LAYERS), "layers"),
    "single": (("brownian", 8), *(("single", n) for n in SINGLE)),
    "modal": (("brownian", 3), ("place", "all"), ("objects", "all"), "both"),
    "networks": (("brownian", 3), *(("network", name) for name in "ABCD"), *(("node", name) for name in NODES)),
    "exploring": tuple(("exploring", name) for name in ("C", "D", *NODES)),
    "revaluing": (("brownian", 3), "revalued", "frozen", "wanting"),
    "resolutions": (("brownian", 3), *((modality, n) for modality in ("place", "objects") for n in PRIMES)),
    "pace": (("brownian", 3), ("pace", "place"), ("pace", "both")),
    "long": tuple(("long", n) for n in SINGLE),
    "grown": tuple((modality, f"first {k}") for modality in ("place", "objects") for k in range(2, len(PRIMES))),
    "wanted": (("brownian", 3), "revalued", "frozen", "removed", "removed, frozen",
               *(("past", *pair) for pair in product(PASTS, ("papers", "both")) if pair != ("papers", "both"))),
}
RECORDED_ALONE = ("long", "exploring", "grown", "wanted")  # groups that no page runs, since they would take it minutes

# The choices that the parts of a reading make, by the names of their fields.
PARTS = {
    "learning": ("learning_rate", "discount", "credit", "absent_decay", "absent_form", "memory", "activity",
                 "bootstrap", "terminal"),
    "policy": ("exploration", "when_indifferent"),
    "world": ("fps", "contact"),
}


@dataclass(frozen=True)
class Reading:
    """A value for every choice in building the agents; the defaults are those of the book.

    learning, policy: of all its agents. `when_indifferent` counts as "random" if `exploration` is 0, since the agent
        would otherwise never move. With temporal difference the state of object vectors counts as "object".
    world: its tank, in which each paper sets the creeps and the reward for the last green one.
    paper_a_fps: steps per second of paper A's boards; those of papers B and C have that of the world.
    tiled_fraction, object_tiled_fraction: shares of their range that maps of places and of object vectors cover.
    object_state, object_reach, object_beyond, object_centred: of object vectors, see `neorl.agents.papers`.
    place_gain, network_gain: of place cells, relative to object-vector cells, in papers B and C.
    vectors: whether the valence of an element is in the vector of a desire ("signed") or not ("by size"), see `Desire`.
    network_resolutions: of the maps of paper C.

    The other fields are as in `Agent`, `Node` and `Desire`. Raises ValueError for invalid parts, vectors, resolutions
    or recursion; its agents and conditions check the other fields.
    """

    learning: Learning = CALIBRATED
    own_cell: str = Agent.own_cell
    shared_cell: str = Agent.shared_cell
    resets: str = Agent.resets
    tiled_fraction: float = papers.TILED_FRACTION
    object_state: str = papers.OF_OBJECTS["object_state"]
    object_reach: float = papers.OF_OBJECTS["object_reach"]
    object_tiled_fraction: float = papers.OF_OBJECTS["object_tiled_fraction"]
    object_beyond: str = papers.OF_OBJECTS["object_beyond"]
    object_centred: bool = papers.OF_OBJECTS["object_centred"]
    weighting: str = Node.weighting
    policy: Policy = GREEDY
    place_gain: float = papers.PLACE_GAIN
    network_gain: float = 1.0
    vectors: Annotated[str, OneOf(VECTORS)] = "by size"
    scale: float = papers.SCALE
    recursion: float = -1.0
    network_resolutions: tuple[int, ...] = LAYERS
    world: WaterWorld = WaterWorld()
    paper_a_fps: int = 30

    def __post_init__(self):
        checks.check_fields(self)
        checks.assign(self, network_resolutions=checks.several("network_resolutions", self.network_resolutions))

    @property
    def choices(self) -> dict[str, Any]:
        """Its value of every choice by name, including the choices of its parts."""
        found: dict[str, Any] = {}
        for name, value in vars(self).items():
            found |= {each: getattr(value, each) for each in PARTS[name]} if name in PARTS else {name: value}
        return found | ({"credit": "step"} if self.learning.update_on == "step" else {})

    def varied(self, **choices: Any) -> "Reading":
        """The same reading with other values of some `choices`.

        The credit "step" is temporal difference, of which the learning rate, the discount and `terminal` alone are
        choices. Raises ValueError for an unknown choice and for an invalid value.
        """
        wanted = self.choices
        for name, value in choices.items():
            wanted[checks.one_of("the name of a choice", name, wanted)] = value
        learning, policy, world = ({name: wanted.pop(name) for name in names} for names in PARTS.values())
        if learning["credit"] == "step":
            kept = ("learning_rate", "discount", "terminal")
            learning = {"update_on": "step", **{name: learning[name] for name in kept}}
        return replace(self, learning=Learning(**learning), policy=replace(self.policy, **policy),
                       world=replace(self.world, **world), **wanted)

    @property
    def agents(self):
        """The arguments that are common to all its agents, for the functions that make them."""
        policy = self.policy if self.policy.exploration else replace(self.policy, when_indifferent="random")
        state = "object" if self.learning.update_on == "step" else self.object_state
        of_agent = {name: getattr(self, name) for name in ("own_cell", "shared_cell", "resets", *papers.OF_NODES)}
        return {"learning": self.learning, "policy": policy, **of_agent, "object_state": state,
                "object_reach": self.object_reach if state == "object" else 0.0}


# What the text prints or pins; where it leaves more, the simplest or the middle of a prior, as the pins say.
TO_THE_LETTER = Reading(**papers.TO_THE_LETTER, place_gain=1.0, scale=papers.LITERAL_SCALE, paper_a_fps=PAPER_FPS)
READINGS = {"calibrated": Reading(), "letter": TO_THE_LETTER}  # by the names of a page's parameter
NAMES = {"calibrated": "calibrated", "letter": "to the letter"}  # of these


def named(reading: Reading) -> str:
    """The name in `READINGS` of the reading whose agents are made alike. Raises StopIteration if none is."""
    return next(name for name, other in READINGS.items() if other.agents == reading.agents)


def changed(reading: Reading, changes: Mapping[str, Mapping[str, Any]]) -> dict[str, Reading]:
    """Variants of a reading by name, but for those equal to it. changes: {name: {choice: value}}."""
    made = {name: reading.varied(**change) for name, change in changes.items()}
    return {name: variant for name, variant in made.items() if variant != reading}


def conditions(reading: Reading, steps: int, runs: int, seed: int = 0,
               groups: Sequence[str] = tuple(GROUPS)) -> dict[Any, Condition]:
    """The conditions of the papers under a reading: {key: `Condition`}.

    steps: of a run at 50 steps per second, but no more than the paper's. At other rates runs of papers B and C last the
    same simulated time, and those of paper A have the same steps. For B4 runs are 16 times as long and half as many,
    but at least two, unless steps reach paper B's length. Brownian motion with 8 creeps always runs as long as in paper
    A, which reports no reset in that time. "revalued" wants red creeps too from half-time on, "frozen" does and learns
    no more from there, and "wanting" wants them from the start; "removed" no longer fears them. ("past", was, then)
    desires one of `PASTS` while it learns for half of the run, and then, without learning, what the papers do or both
    colours; ("past", "papers", "both") is "frozen". ("exploring", name) takes `A_LITTLE` of its actions at random.
    seed: integer ≥ 0. groups: names in `GROUPS`, which has the keys of each.
    Raises ValueError for anything else.
    """
    checks.instance("reading", reading, Reading)
    steps, runs = checks.integer("steps", steps, at_least=1), checks.integer("runs", runs, at_least=1)
    wanted = [key for group in checks.several("groups", groups)
              for key in GROUPS[checks.one_of("groups", group, tuple(GROUPS))]]
    made = _all_conditions(reading, steps, runs, seed)
    return {key: made[key] for key in wanted}


def _all_conditions(reading, steps, runs, seed):
    eight = replace(reading.world, n_creeps=8, win_reward=5.0, fps=reading.paper_a_fps)
    three = replace(reading.world, n_creeps=3, win_reward=0.0)
    each = reading.agents

    def condition(agent, paper, length=steps, runs=runs, blocks=1):
        world, length = (eight if paper == "A" else three), blocks * min(length, LENGTHS[paper])
        length = length if paper == "A" else max(1, round(length * reading.world.fps / PAPER_FPS))
        return Condition(agent, world, length, runs, seed)

    made = {("brownian", 8): condition(papers.brownian(), "A", LENGTHS["A"], CONTROLS * runs),
            ("brownian", 3): condition(papers.brownian(), "B", runs=CONTROLS * runs)}
    made |= {("layer", n): condition(papers.place_cells([n], **each), "A") for n in LAYERS}
    made["layers"] = condition(papers.place_cells(LAYERS, **each), "A")
    made |= {("single", n): condition(papers.place_cells([n], **each), "A") for n in SINGLE}
    made |= {("long", n): condition(papers.place_cells([n], **each), "A", blocks=BLOCKS) for n in SINGLE}
    for name, chosen in {**{n: [n] for n in PRIMES}, "all": PRIMES}.items():
        made["place", name] = condition(papers.place_cells(chosen, **each), "B")
        made["objects", name] = condition(papers.object_vector_cells(chosen, **each), "B")
    both = papers.multimodal(PRIMES, place_gain=reading.place_gain, **each)
    made["both"] = condition(both, "B")
    longer = {"length": LONGER * steps, "runs": max(2, runs // 2)} if steps < LENGTHS["B"] else {}
    made |= {("pace", name): condition(agent, "B", **longer) for name, agent in
             (("place", made["place", "all"].agent), ("both", both))}
    made |= {("network", name): condition(agent, "C") for name, agent in networks(reading).items()}
    made |= {("node", name): condition(agent, "C") for name, agent in nodes(reading).items()}
    exploring = reading.varied(exploration=A_LITTLE)
    made |= {("exploring", name): condition(agent, "C") for name, agent in
             {**networks(exploring), **nodes(exploring)}.items() if name not in "AB"}
    for k in range(2, len(PRIMES)):
        made["place", f"first {k}"] = condition(papers.place_cells(PRIMES[:k], **each), "B")
        made["objects", f"first {k}"] = condition(papers.object_vector_cells(PRIMES[:k], **each), "B")
    return made | _changing(made["both"])


def _changing(condition):
    """The conditions in which agents of both modalities come to desire something else at half-time."""
    def desiring(green, red, learning=True):
        desires = [replace(desire, valence={"green": green, "red": red}[desire.source]) for desire in agent.desires]
        rule = agent.learning if learning else replace(agent.learning, learning_rate=0.0)
        return replace(agent, desires=desires, learning=rule)

    def turned(was, then):
        return replace(condition, agent=was, changes=((condition.steps // 2, then),))

    agent, both = condition.agent, (1.0, 1.0)
    pasts = {"none": desiring(0.0, 0.0), "green": desiring(1.0, 0.0), "papers": agent}
    thens = {"papers": desiring(1.0, -1.0, learning=False), "both": desiring(*both, learning=False)}
    made = {("past", was, then): turned(pasts[was], thens[then]) for was in pasts for then in thens}
    return made | {
        "revalued": turned(agent, desiring(*both)), "frozen": made.pop(("past", "papers", "both")),
        "wanting": replace(condition, agent=desiring(*both)), "removed": turned(agent, desiring(1.0, 0.0)),
        "removed, frozen": turned(agent, desiring(1.0, 0.0, learning=False))}


def networks(reading: Reading) -> dict[str, Agent]:
    """Networks A to D of paper C under a reading: {name: `Agent`}. Raises ValueError unless it is a `Reading`."""
    checks.instance("reading", reading, Reading)
    shared = {"resolutions": reading.network_resolutions, "scale": reading.scale,
              "signed": reading.vectors == "signed", **reading.agents}
    adding = {"place_gain": reading.network_gain, **shared}
    return {"A": papers.network_a(**shared), "B": papers.network_b(**shared), "C": papers.network_c(**adding),
            "D": papers.network_d(recursion=reading.recursion, **adding)}


def nodes(reading: Reading) -> dict[str, Agent]:
    """The simplest agents beside networks C and D, which pass no desires: {name in `NODES`: `Agent`}.

    Raises ValueError unless it is a `Reading`.
    """
    checks.instance("reading", reading, Reading)
    chosen = {"resolutions": reading.network_resolutions, **reading.agents}
    return {"places": papers.place_cells(**chosen), "objects": papers.object_vector_cells(**chosen),
            "one layer": papers.multimodal(place_gain=reading.network_gain, **chosen)}


def judge(results):
    """Judge the claims for which the results of a reading's conditions suffice: {name: `Claim`}, in their order.

    results: {key: `Result`}, of all groups or of some; under "moved" the distances to places that move, for T1, see
        `judge_changes`.
    """
    by = {name: {key[1]: result for key, result in results.items() if key[0] == name}
          for name in ("brownian", "layer", "single", "long", "place", "objects", "pace", "network", "node")}

    def complete(*groups):
        return all(key in results for group in groups for key in GROUPS[group])

    judged = []
    if complete("single"):
        judged += claims.judge_single_layer(by["single"], by["brownian"][8], by["long"])
    if complete("layers"):
        judged += claims.judge_multiple_layers(by["layer"], results["layers"], by["brownian"][8])
    if complete("layers", "single"):
        judged += [claims.judge_several(by["layer"], by["single"], results["layers"], by["brownian"][8]),
                   claims.judge_margin(by["layer"] | by["single"], by["brownian"][8])]
    if complete("modal"):
        judged += claims.judge_modalities(by["place"]["all"], by["objects"]["all"], results["both"], by["brownian"][3])
    if complete("modal", "resolutions"):
        judged += [claims.judge_resolutions(by["place"], by["objects"], by["brownian"][3])]
    if complete("pace"):
        judged += [claims.judge_pace(**by["pace"], brownian=by["brownian"][3])]
    if complete("networks"):
        nodes = {of_page: by["node"][name] for name, of_page in NODES.items()}
        judged += claims.judge_networks({name: by["network"][name] for name in "ABCD"}, nodes, by["brownian"][3])
    if complete("revaluing") and "moved" in results:
        turned = {name: results[name] for name in ("revalued", "frozen", "wanting")}
        if ("past", "none", "both") in results:
            turned["random"] = results["past", "none", "both"]
        judged += [claims.judge_changes(turned, by["brownian"][3], results["moved"])]
    if complete("wanted"):
        turned = {"changed": (results["revalued"], results["frozen"]),
                  "removed": (results["removed"], results["removed, frozen"])}
        pasts = {then: {was: results["frozen"] if (was, then) == ("papers", "both") else results["past", was, then]
                        for was in PASTS} for then in ("papers", "both")}
        judged += [claims.judge_knowledge(turned, by["brownian"][3]), claims.judge_pasts(pasts, by["brownian"][3])]
    if complete("modal", "resolutions", "grown"):
        grown = {name: [results[key, PRIMES[0]], *(results[key, f"first {k}"] for k in range(2, len(PRIMES))),
                        results[key, "all"]] for key, name in (("place", "place cells"),
                                                               ("objects", "object-vector cells"))}
        judged += [claims.judge_scaling(grown, by["brownian"][3])]
    if complete("layers", "modal", "resolutions"):
        judged += [claims.judge_more_maps(additions(results))]
    order = [*STATEMENTS].index
    return {claim.name: claim for claim in sorted(judged, key=lambda claim: order(claim.name))}


def additions(results):
    """The comparisons of `judge_more_maps`: {what is added: (with more maps, {which: with fewer}, Brownian motion)}.

    results: {key: `Result`}, of at least the groups "layers", "modal" and "resolutions".
    """
    eight, three = results["brownian", 8], results["brownian", 3]
    place, objects = results["place", "all"], results["objects", "all"]

    def alone(name, resolutions):
        return {f"N{n}": results[name, n] for n in resolutions}

    return {"resolutions of paper A": (results["layers"], alone("layer", LAYERS), eight),
            "resolutions of place": (place, alone("place", PRIMES), three),
            "resolutions of object vectors": (objects, alone("objects", PRIMES), three),
            "a modality": (results["both"], {"place cells": place, "object-vector cells": objects}, three)}
