"""An agent's choices as the flat arrays that the kernels take."""

import numpy as np

from neorl.agents.agent import Place
from neorl.core.choices import Attention, Capture, Credit, Source, UpdateOn, Vector, Weighting
from neorl.core.kernel import execute, new_tuple
from neorl.core.parameters import Parameters, derive


def compiled(agent, world):
    """The `Parameters` of an agent in a world."""
    choices, sizes = chosen(agent, world)
    parameters = new_tuple(Parameters, sizes, choices)
    execute(derive, parameters, world.n_creeps)
    return parameters


def chosen(agent, world):
    """The chosen `Parameters`, a dict for a tuple within, from which `derive` makes the others; and all sizes."""
    names = [node.name for node in agent.nodes]
    n_maps = sum(len(node.resolutions) for node in agent.nodes)
    choices = {
        "width": float(world.width), "own_cell_counts": agent.own_cell == "counts",
        "maps": {"resolution": _integers(n for node in agent.nodes for n in node.resolutions)},
        "nodes": _nodes(agent.nodes) | {"order": _integers(names.index(name) for name in agent.evaluation_order)},
        "desires": _desires(agent.desires, names, [node.modality for node in agent.nodes]),
        "learning": _learning(agent.learning, world.fps),
        "policy": {"exploration": agent.policy.exploration,
                   "indifferent_is_no_op": agent.policy.when_indifferent == "no-op"}}
    return choices, {"maps": n_maps, "nodes": len(names), "landmarks": len(choices["nodes"]["landmark"]),
                     "desires": len(agent.desires)}


def _nodes(nodes):
    modalities = [node.modality for node in nodes]
    spaces = np.array([modality.space for modality in modalities])
    landmarks = [place for modality in modalities for place in modality.landmarks]
    return {"vector": _integers(Vector[modality.vector] for modality in modalities),
            "tuning": _integers(spaces[:, 0]),
            "low": spaces[:, [1, 3]],
            "high": spaces[:, [2, 4]],
            "weighting": _integers(Weighting[node.weighting] for node in nodes),
            "gain": np.array([node.gain for node in nodes]),
            "first_map": _firsts([len(node.resolutions) for node in nodes]),
            "first_landmark": _firsts([len(modality.landmarks) for modality in modalities]),
            "landmark": np.array(landmarks, float).reshape(-1, 2)}


def _desires(desires, names, modalities):
    elements = [[desire.source == other.target and (not desire.of or other.source in desire.of) for other in desires]
                for desire in desires]
    points = [_at(desire, modalities[names.index(desire.target)]) for desire in desires]
    return {"source": _integers(_source(desire) for desire in desires),
            "target": _integers(names.index(desire.target) for desire in desires),
            "valence": np.array([desire.valence or 0.0 for desire in desires], float),
            "sums_valence": np.array([desire.valence is None for desire in desires], np.bool_),
            "scale": np.array([desire.scale for desire in desires], float),
            "signed": np.array([desire.signed for desire in desires], np.bool_),
            "elements": np.array(elements, np.bool_).reshape(len(desires), len(desires)),
            "at": np.array(points, float).reshape(-1, 2)}


def _learning(learning, fps):
    by_time = learning.memory_unit == "seconds"
    return {"learning_rate": np.float32(learning.learning_rate),
            "discount": np.float32(learning.discount),
            "absent_decay": np.float32(learning.absent_decay),
            "away": learning.absent_form == "away",
            "update_on": int(UpdateOn[learning.update_on]),
            "credit": int(Credit[learning.credit]),
            "activity_retained": _retained(learning.activity * fps),
            "terminal": learning.terminal,
            "trace": learning.trace,
            "memory_retained": _retained(learning.memory * (fps if by_time else 1)),
            "memory_by_time": by_time,
            "memory_discounts": learning.memory_value == "discounted",
            "bootstrap": learning.bootstrap,
            "own_causes": learning.causes == "own",
            "capture": int(Capture[learning.capture]),
            "attention": int(Attention[learning.attention])}


def _retained(constant):
    """What one step, or change, leaves of what fades with a time constant of so many."""
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
