"""An agent's choices as the flat arrays that the kernels take."""

import numpy as np

from neorl.agents.agent import Place
from neorl.core.choices import Attention, Capture, Credit, Source, UpdateOn, Weighting
from neorl.core.kernel import zeros
from neorl.core.modality import Vector
from neorl.core.plan import Plan, lay_out


def compiled(agent, world):
    """The `Plan` of an agent in a world."""
    choices, sizes = chosen(agent, world)
    plan = Plan(**zeros(Plan, sizes) | choices)
    lay_out(plan, world.n_creeps)
    return plan


def chosen(agent, world):
    """What `lay_out` makes a plan of: the chosen fields of a `Plan`, and the sizes of all."""
    nodes, desires, learning = agent.nodes, agent.desires, agent.learning
    names = [node.name for node in nodes]
    modalities = [node.modality for node in nodes]
    spaces = np.array([modality.space for modality in modalities])
    landmarks = [place for modality in modalities for place in modality.landmarks]
    elements = [[desire.source == other.target and (not desire.of or other.source in desire.of) for other in desires]
                for desire in desires]
    resolution = [n for node in nodes for n in node.resolutions]
    choices = dict(
        width=float(world.width),
        resolution=_integers(resolution),
        vector=_integers(Vector[modality.vector] for modality in modalities),
        tuning=_integers(spaces[:, 0]),
        low=spaces[:, [1, 3]],
        high=spaces[:, [2, 4]],
        weighting=_integers(Weighting[node.weighting] for node in nodes),
        gain=np.array([node.gain for node in nodes], float),
        first_map=_firsts([len(node.resolutions) for node in nodes]),
        first_landmark=_firsts([len(modality.landmarks) for modality in modalities]),
        order=_integers(names.index(name) for name in agent.evaluation_order),
        landmark=np.array(landmarks, float).reshape(-1, 2),
        source=_integers(_source(desire) for desire in desires),
        target=_integers(names.index(desire.target) for desire in desires),
        valence=np.array([desire.valence or 0.0 for desire in desires], float),
        sums_valence=np.array([desire.valence is None for desire in desires], np.bool_),
        scale=np.array([desire.scale for desire in desires], float),
        signed=np.array([desire.signed for desire in desires], np.bool_),
        elements=np.array(elements, np.bool_).reshape(len(desires), len(desires)),
        at=np.array([_at(desire, modalities[names.index(desire.target)]) for desire in desires], float).reshape(-1, 2),
        own_cell_counts=agent.own_cell == "counts",
        learning_rate=np.float32(learning.learning_rate),
        discount=np.float32(learning.discount),
        absent_decay=np.float32(learning.absent_decay),
        away=learning.absent_form == "away",
        update_on=int(UpdateOn[learning.update_on]),
        credit=int(Credit[learning.credit]),
        activity=_left_after_one(learning.activity * world.fps),
        terminal=learning.terminal,
        trace=learning.trace,
        memory_fade=_left_after_one(learning.memory * (world.fps if learning.memory_unit == "seconds" else 1)),
        memory_by_time=learning.memory_unit == "seconds",
        memory_discounts=learning.memory_value == "discounted",
        bootstrap=learning.bootstrap,
        own_causes=learning.causes == "own",
        capture=int(Capture[learning.capture]),
        attention=int(Attention[learning.attention]),
        exploration=float(agent.policy.exploration),
        indifferent_is_no_op=agent.policy.when_indifferent == "no-op")
    return choices, {"maps": len(resolution), "nodes": len(nodes), "landmarks": len(landmarks), "desires": len(desires)}


def _left_after_one(constant):
    """What is left after one step, or change, of what fades with a time constant of so many."""
    return np.float32(constant / (1.0 + constant))


def _integers(values):
    return np.array([int(value) for value in values], np.int64)


def _firsts(sizes):
    return np.concatenate([[0], np.cumsum(sizes)]).astype(np.int64)


def _source(desire):
    if isinstance(desire.source, Place):
        return Source.place
    if not isinstance(desire.source, str):
        return Source.point
    return Source.node if desire.between_nodes else Source[desire.source]


def _at(desire, modality):
    """The two numbers that say where a desire is, if it is at a fixed point."""
    if isinstance(desire.source, str):
        return 0.0, 0.0
    if isinstance(desire.source, Place):
        return desire.source.x, desire.source.y
    return modality.as_pairs(desire.source)[0]
