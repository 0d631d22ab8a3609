"""What of an agent goes on: as it changes into another, as its values go to another, and in a file.

Each array and each field of the state says so where it is declared (`neorl.core.layout`). A map is the same in two
agents if its `MapKey` is. A file holds the state alone: all else is made of the agent and its world, and each index in
the state is compared with its range, since kernels would trust it.
"""

from collections import Counter
from typing import Any, NamedTuple

import numpy as np

from neorl.agents.agent import LEARNED
from neorl.common import checks
from neorl.core.layout import DERIVED, ENTRIES, KEEPING, PART_OF, PLACES, TRACKS, VALUES, Memory, of_agent, of_desire
from neorl.core.scene import ABSENT
from neorl.kernels.annotations import arrays, fields
from neorl.kernels.identity import identity

OF_AGENT, OF_DESIRE = ([name for name, *_ in fields_of()] for fields_of in (of_agent, of_desire))
MOST = 2**62  # of a count


class MapKey(NamedTuple):
    """What a map has in common with one that can take its values."""

    node: str
    goals: str
    events: str  # what each cell of contacts has values for
    state: str
    beyond: str
    map: str  # its identity, since an axis that a user has defined again is the same as long as its code is
    place: int  # among equal ones


def map_keys(agent):
    """The `MapKey` of each of an agent's maps."""
    before: Counter[Any] = Counter()
    for node, nres_map in ((node, nres_map) for node in agent.nodes for nres_map in node.maps):
        events = "after-states" if node.goals == "contacts" and agent.contacts.efference > 0 else "actions"
        key = MapKey(node.name, node.goals, events, node.state, node.beyond, identity(nres_map), 0)
        yield key._replace(place=before[key])
        before[key] += 1


def values_of(agent, record, memory, m):
    """The values of a map in the layout of `Individual.q`, as a view."""
    nres, node = record["maps"][m], [node for node in agent.nodes for _ in node.resolutions][m]
    values, cells = memory.q[nres["first_value"] : nres["end_value"]], nres["cells"]
    actions = len(record["push"])
    if node.state != "object":
        return values.reshape(1, cells, actions).swapaxes(1, 2)
    if node.goals == "contacts":
        return values.reshape(cells, -1, ENTRIES)
    if agent.learning.bootstrap:  # see `neorl.core.learning.Order`
        return values.reshape(cells, actions, cells)
    return values.reshape(cells, cells, actions).transpose(1, 2, 0)


def part_of(name, record, memory, m):
    """The part of an array of the memory that is a map's, as a view."""
    (_, shape), nres = fields(Memory)[name], record["maps"]
    part = PART_OF[shape[0]]
    array, rows = getattr(memory, name), nres[record["n_maps"] - 1][f"end_{part}"]
    return array.reshape(rows, -1)[nres[m][f"first_{part}"] : nres[m][f"end_{part}"]] if array.size else array


def continue_as(old_agent, old_record, old_memory, agent, record, memory):
    """Copy what goes on as another agent, whose record and memory are as of its beginning in the same scene."""
    old_maps = {key: m for m, key in enumerate(map_keys(old_agent))}
    for m, key in enumerate(map_keys(agent)):
        if key in old_maps:
            _keep_map(old_agent, old_record, old_memory, old_maps[key], agent, record, memory, m)
    for name in OF_AGENT:
        record[name] = old_record[name]
    old_desires = {key: e for e, key in enumerate(_desire_keys(old_agent))}
    for e, key in enumerate(_desire_keys(agent)):
        if key in old_desires:
            for name in OF_DESIRE:
                record["desires"][name][e] = old_record["desires"][name][old_desires[key]]
    _keep_worths(old_agent, old_record, agent, record)


def transfer(source_agent, source_record, source_memory, agent, record, memory):
    """Copy all values of maps of one agent into the same maps of another. Raises ValueError unless all are the same."""
    keys, source_keys = list(map_keys(agent)), list(map_keys(source_agent))
    if len(keys) != len(source_keys):
        raise ValueError(f"other must have as many maps as this one, {len(keys)}, but has {len(source_keys)}")
    for m, (mine, theirs) in enumerate(zip(keys, source_keys)):
        for name, one, another in zip(MapKey._fields, mine, theirs):
            if one != another:
                one, another = (agent.maps[m], source_agent.maps[m]) if name == "map" else (one, another)
                raise ValueError(f"other must have the maps of this one, but of its map {m} {name} is {another!r}, "
                                 f"and here {one!r}")
    for m in range(len(keys)):
        for name in _kept(VALUES):
            _keep_part(name, source_agent, source_record, source_memory, m, agent, record, memory, m)


def state_of(record, memory):
    """All arrays of an agent's state, by name: views of the record and the memory."""
    return ({f"agent.{name}": record[name] for name in OF_AGENT}
            | {f"desires.{name}": record["desires"][name][: record["n_desires"]] for name in OF_DESIRE}
            | arrays(memory._replace(**{name: None for name in KEEPING if name not in _kept(VALUES, TRACKS, PLACES)})))


def check_state(record, memory):
    """Raise ValueError for a state that no run could have, by which a kernel might leave its arrays.

    Arrays have the types and shapes of the record and the memory.
    """
    for name, array in state_of(record, memory).items():
        if array.dtype.kind == "f" and not np.isfinite(array).all():
            raise checks.error(name, "finite numbers", array[~np.isfinite(array)].flat[0])
    _check_within("agent.last_event", record["last_event"], len(record["push"]))
    _check_within("agent.evaluation", record["evaluation"], MOST)
    _check_within("desires.meetings", record["desires"]["meetings"], MOST)
    _check_within("events", memory.events, MOST)
    for m in range(record["n_maps"]):
        _check_map(record["maps"][m], *(part_of(name, record, memory, m) for name in (
            "goal_range", "tracks", "remembered", "remembered_at", "after", "left")), len(memory.frames))


def _check_map(nres, goal_range, tracks, remembered, remembered_at, after, left, n_frames):
    """Raise ValueError for what is remembered in a map, if it is not in the map."""
    cells, tracks = nres["cells"], tracks.reshape(-1)
    _check_within("goal_range", goal_range, [cells, nres["goals"]])
    _check_within("tracks.cell", tracks["cell"], cells - 1, at_least=ABSENT)
    _check_within("after", after, cells - 1)
    _check_within("tracks.remembered", tracks["remembered"], cells if remembered.size else 0)
    _check_within("tracks.frame", tracks["frame"], n_frames - 1)
    for name in ("passed", "left"):
        _check_within(f"tracks.{name}", tracks[name], MOST)
    lists, places = remembered.reshape(len(tracks), -1), remembered_at.reshape(len(tracks), -1)
    for t, track in enumerate(tracks):
        count = track["remembered"]
        _check_within("remembered", lists[t, :count], cells - 1)
        expected = np.zeros_like(places[t])
        expected[lists[t, :count]] = np.arange(1, count + 1)
        if not np.array_equal(places[t], expected):
            raise ValueError("remembered_at must be the places of the cells remembered, but is not")
        begin, end = nres["first_value"], nres["end_value"]
        _check_within("left", left[t, : track["left"]], end - ENTRIES, at_least=begin)


def _check_within(name, numbers, at_most, at_least=0):
    outside = (numbers < at_least) | (numbers > at_most)
    if np.any(outside):
        raise checks.error(name, f"integers from {at_least} to {np.max(at_most)}", np.asarray(numbers)[outside].flat[0])


def own_tracks(memory):
    """The memory of a double of an agent, which has the same values, and tracks of its own that have not begun."""
    return memory._replace(**{name: np.zeros_like(getattr(memory, name)) for name, keeping in KEEPING.items()
                              if keeping not in (VALUES, DERIVED)})


def _kept(*keepings):
    return [name for name, keeping in KEEPING.items() if keeping in keepings]


def _keep_map(old_agent, old_record, old_memory, old_m, agent, record, memory, m):
    remembers = _remembers(old_agent, old_m) == _remembers(agent, m)
    for name in _kept(VALUES, *(TRACKS, PLACES) * remembers):
        _keep_part(name, old_agent, old_record, old_memory, old_m, agent, record, memory, m)


def _keep_part(name, old_agent, old_record, old_memory, old_m, agent, record, memory, m):
    if name == "q":  # whose order depends on the rule of learning
        values_of(agent, record, memory, m)[...] = values_of(old_agent, old_record, old_memory, old_m)
        return
    old, new = part_of(name, old_record, old_memory, old_m), part_of(name, record, memory, m)
    if new.size:
        moved = record["maps"][m]["first_value"] - old_record["maps"][old_m]["first_value"]
        new[...] = old + moved if KEEPING[name] is PLACES else old


def _remembers(agent, m):
    """What two maps' memories of how their cells were reached must have in common."""
    node, memory = [node for node in agent.nodes for _ in node.resolutions][m], agent.learning.memory
    if node.goals == "contacts":
        return agent.contacts.efference
    return memory > 0 if node.state == "object" else memory


def _desire_keys(agent):
    nodes = {node.name: node for node in agent.nodes}
    before: Counter[Any] = Counter()
    for desire in agent.desires:
        key = desire, identity(nodes[desire.target])
        yield *key, before[key]
        before[key] += 1


def _keep_worths(old_agent, old_record, agent, record):
    """Let desires that learn the worth of a kind begin with what is known of it."""
    learned = {desire.source: e for e, desire in reversed(list(enumerate(old_agent.desires)))
               if desire.valence == LEARNED}
    for e, desire in enumerate(agent.desires):
        if desire.valence == LEARNED and desire.source in learned:
            for name in ("worth", "meetings"):
                record["desires"][name][e] = old_record["desires"][name][learned[desire.source]]
