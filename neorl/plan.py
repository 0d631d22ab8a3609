"""An agent as the kernels take it: a `Plan` of flat arrays for what is chosen, a `Memory` of them for what changes.

Maps follow one another in the order of the agent's nodes. A *track* is one point that a map follows: the agent itself,
or one of the things that its modality is about. All tracks of a map share its values. Desires keep the agent's order.
"""

from typing import NamedTuple

import numpy as np

from neorl.agent import COLOURS, CREDITS, DRIVERS, WEIGHTINGS
from neorl.horde import N_EVENTS
from neorl.modality import Tuning, Vector
from neorl.nres import tiling

GREEN, RED, NODE, POINT = range(4)  # where a desire comes from


class Plan(NamedTuple):
    """All that is chosen of an agent for one world. `first_…` arrays have one more entry, for the end of the last."""

    width: float  # of the board, in pixels
    # of each map
    columns: np.ndarray  # int64
    rows: np.ndarray  # int64
    low_u: np.ndarray  # float64: where the first column begins
    scale_u: np.ndarray  # float64: columns a unit
    low_v: np.ndarray  # float64
    scale_v: np.ndarray  # float64
    closed: np.ndarray  # bool: whether the last row borders on the first
    cells: np.ndarray  # int64
    contact: np.ndarray  # int64: the cell of the vector (0, 0)
    weight: np.ndarray  # float64
    first: np.ndarray  # int64: where in q the map begins
    first_cell: np.ndarray  # int64: how many cells the maps before it have
    first_track: np.ndarray  # int64
    # of each node
    vector: np.ndarray  # int64, see `modality.Vector`
    tuning: np.ndarray  # int64, see `modality.Tuning`
    reach: np.ndarray  # float64 (nodes, 2), of proximal tuning
    gain: np.ndarray  # float64
    points: np.ndarray  # int64: how many it follows
    first_map: np.ndarray  # int64
    first_landmark: np.ndarray  # int64
    first_input: np.ndarray  # int64: where in `inputs` its desires begin
    landmark: np.ndarray  # float64 (landmarks, 2)
    inputs: np.ndarray  # int64: desires, those of one node after those of the other
    order: np.ndarray  # int64: nodes, each after those that it takes desires from
    # of each desire
    source: np.ndarray  # int64: GREEN, RED, NODE or POINT
    valence: np.ndarray  # float64
    sums_valence: np.ndarray  # bool: whether the valence is that of its elements instead
    scale: np.ndarray  # float64
    signed: np.ndarray  # bool
    elements: np.ndarray  # bool (desires, desires): which desires of its source its vector comes from
    goal: np.ndarray  # int64 (desires, maps): the cell of a POINT
    # learning and policy, as in `Learning` and `Policy`
    own_cell_counts: bool
    learning_rate: np.float32
    discount: np.float32
    absence: np.float32
    driver: int  # the place in DRIVERS
    credit: int  # the place in CREDITS
    terminal: bool
    trace: int
    bootstrap: bool
    exploration: float
    idle_is_no_op: bool


class Memory(NamedTuple):
    """All that changes in an agent."""

    q: np.ndarray  # float32 (n_values,): q[state, action, goal] of one map after the other
    known: np.ndarray  # int64 (cells of all maps, 2): the goals, from and to, that a cell may know anything of
    cell: np.ndarray  # int64 (tracks,): the active cell
    events: np.ndarray  # int64 (tracks, 5): steps on which each action was taken since the cell was entered
    last_event: np.ndarray  # int64 (1,)
    trace_cell: np.ndarray  # int64 (tracks, trace): cells left, a ring
    trace_rates: np.ndarray  # float32 (tracks, trace, 4): the rates of their events
    trace_count: np.ndarray  # int64 (tracks,): cells left since the point appeared
    target: np.ndarray  # float32 (most cells,): working memory
    # as of the last choice that was not drawn
    pull: np.ndarray  # float64 (desires, 4): what each desire adds to the value of each action in its node
    landing: np.ndarray  # float64 (desires, 2): where a node's desire lands, as seen from the agent, in board widths
    worth: np.ndarray  # float64 (desires,): its valence, all its elements together
    value: np.ndarray  # float64 (4,): of each action
    stream: np.ndarray  # uint64 (4,): the random numbers of the policy


def compiled(agent, world):
    """The `Plan` of an agent in a world."""
    nodes, maps, desires, learning = agent.nodes, agent.maps, agent.desires, agent.learning
    names = [node.name for node in nodes]
    modalities = [node.modality for node in nodes]
    columns, rows, low_u, scale_u, low_v, scale_v, closed = (np.array(column) for column in zip(*map(tiling, maps)))
    cells = columns * rows
    points = [{"objects": world.n_creeps, "boundaries": 4, "landmarks": len(modality.landmarks)}.get(modality.vector, 1)
              for modality in modalities]
    reach = [[high for _, high in modality.ranges] or [0.0] for modality in modalities]
    inputs = [[e for e, desire in enumerate(desires) if desire.target == name] for name in names]
    owners = [name for node, name in zip(nodes, names) for _ in node.resolutions]
    elements = [[desire.source == other.target and (not desire.of or other.source in desire.of) for other in desires]
                for desire in desires]
    goal = [[nres_map.encode(desire.source) if _source(desire) == POINT and desire.target == owner else 0
             for owner, nres_map in zip(owners, maps)] for desire in desires]
    return Plan(
        width=float(world.width),
        columns=columns, rows=rows, low_u=low_u, scale_u=scale_u, low_v=low_v, scale_v=scale_v, closed=closed,
        cells=cells,
        contact=_integers(nres_map.encode(np.zeros(len(nres_map.modality.axes))) for nres_map in maps),
        weight=np.concatenate([_weights(node) for node in nodes]),
        first=_firsts(N_EVENTS * cells**2),
        first_cell=_firsts(cells),
        first_track=_firsts([count for node, count in zip(nodes, points) for _ in node.resolutions]),
        vector=_integers(Vector[modality.vector] for modality in modalities),
        tuning=_integers(Tuning[modality.tuning] for modality in modalities),
        reach=np.array([(each[0], each[-1]) for each in reach], float),
        gain=np.array([node.gain for node in nodes], float),
        points=_integers(points),
        first_map=_firsts([len(node.resolutions) for node in nodes]),
        first_landmark=_firsts([len(modality.landmarks) for modality in modalities]),
        first_input=_firsts([len(each) for each in inputs]),
        landmark=np.array([place for modality in modalities for place in modality.landmarks], float).reshape(-1, 2),
        inputs=_integers(e for each in inputs for e in each),
        order=_integers(names.index(name) for name in agent.evaluation_order),
        source=_integers(_source(desire) for desire in desires),
        valence=np.array([desire.valence or 0.0 for desire in desires], float),
        sums_valence=np.array([desire.valence is None for desire in desires], np.bool_),
        scale=np.array([desire.scale for desire in desires], float),
        signed=np.array([desire.signed for desire in desires], np.bool_),
        elements=np.array(elements, np.bool_).reshape(len(desires), len(desires)),
        goal=np.array(goal, np.int64).reshape(len(desires), len(maps)),
        own_cell_counts=agent.own_cell == "counts",
        learning_rate=np.float32(learning.learning_rate),
        discount=np.float32(learning.discount),
        absence=np.float32(learning.absence),
        driver=DRIVERS.index(learning.driver),
        credit=CREDITS.index(learning.credit),
        terminal=learning.terminal,
        trace=learning.trace,
        bootstrap=learning.bootstrap,
        exploration=float(agent.policy.exploration),
        idle_is_no_op=agent.policy.idle == "no-op")


def new_memory(plan, stream):
    """The `Memory` of an agent that has learned nothing."""
    tracks, desires = plan.first_track[-1], len(plan.source)
    return Memory(
        q=np.zeros(plan.first[-1], np.float32),
        known=np.concatenate([np.tile([cells, 0], (cells, 1)) for cells in plan.cells]),
        cell=np.zeros(tracks, np.int64),
        events=np.zeros((tracks, N_EVENTS + 1), np.int64),
        last_event=np.zeros(1, np.int64),
        trace_cell=np.zeros((tracks, plan.trace), np.int64),
        trace_rates=np.zeros((tracks, plan.trace, N_EVENTS), np.float32),
        trace_count=np.zeros(tracks, np.int64),
        target=np.zeros(plan.cells.max(), np.float32),
        pull=np.zeros((desires, N_EVENTS)),
        landing=np.zeros((desires, 2)),
        worth=np.zeros(desires),
        value=np.zeros(N_EVENTS),
        stream=stream)


def _integers(values):
    return np.array([int(value) for value in values], np.int64)


def _weights(node):
    weights = np.array(node.resolutions, float) ** WEIGHTINGS.index(node.weighting)
    return weights / weights.sum()


def _firsts(sizes):
    return np.concatenate([[0], np.cumsum(sizes)]).astype(np.int64)


def _source(desire):
    if not isinstance(desire.source, str):
        return POINT
    return COLOURS.index(desire.source) if desire.source in COLOURS else NODE
