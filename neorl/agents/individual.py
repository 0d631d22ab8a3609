"""An agent in a world, with everything it has learned: the base of `neorl.Learner` and `neorl.Run`.

Parameters, state and values are read-only views. A saved file holds every array, the agent and its world as plain data
(`neorl.description`), the digests of the user's code in them (`neorl.worlds.former`), and one that reveals damage.
"""

from os import PathLike
from types import SimpleNamespace
from typing import Any, NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from neorl.agents.agent import LEARNED, Agent
from neorl.agents.embodiment import embodied, loop_of, own_axes
from neorl.agents.memory import fitting_runs, kept_apart, read_only
from neorl.common import checks
from neorl.common.files import read_arrays, write_arrays
from neorl.core import loop
from neorl.core.building import TABLES, clear_q, n_values, with_values
from neorl.core.coordinates import check_faults
from neorl.core.horde import as_vectors
from neorl.core.layout import ENTRIES, Memory
from neorl.description import described, restored, warn_of_main
from neorl.kernels.annotations import arrays, mapped
from neorl.kernels.execution import execute
from neorl.worlds.former import changes, code_of

# The arrays of `Memory` that have a part for each map, by what the part begins and ends with.
OF_A_MAP = {"cell": ("goal_range",), "track": ("tracks", "events"), "passed": ("passed_at", "passed_rates"),
            "trace": ("remembered", "remembered_at", "strength", "trace_weight", "trace_worth")}


class Output(NamedTuple):
    """The output of a node (paper C, figure 3), as of the agent's last choice that was not exploratory."""

    q: np.ndarray  # float64 (actions,): the value of each action
    desire: np.ndarray  # float64 (axes,): Σ |w| push · Q over its elements; in WaterWorld (Q_E − Q_W, Q_S − Q_N)
    valence: float  # Σ w


class Individual:
    """An agent in a world, with everything it has learned: the base of `Learner` and `neorl.Run`.

    Raises ValueError if the agent and the world are incompatible, MemoryError if its values do not fit into the free
    memory.
    """

    in_words = "a Run or a Learner"  # in messages

    def _begin_untrained(self, agent, world, stream, after=None):
        """Begin as an untrained agent. after: a finished one, whose memory is reused if it is large enough."""
        self._agent, self._world, q = agent, world, None
        record, memory = embodied(agent, world)
        if after is not None and after._holds_values_of(record):
            execute(clear_q, after._record, after._memory)
            q = after._memory.q
        else:
            fitting_runs(record)
        record["stream"] = stream
        self._record, self._memory = kept_apart(record), kept_apart(with_values(record, memory, q))

    def _holds_values_of(self, record):
        """Whether the values of the agent with this record fit into the memory of this one's."""
        return n_values(record) <= len(self._memory.q)

    @property
    def agent(self) -> Agent:
        """The `Agent`."""
        return self._agent

    @property
    def world(self) -> Any:
        """The world, or the `Surroundings` of a `Learner`."""
        return self._world

    @property
    def state(self) -> SimpleNamespace:
        """The fields of the agent's record (`neorl.core.layout`), as read-only views; of tables, the rows in use.

        ``state.maps.cells`` is a column, with a number for each map, and ``state.maps[0].cells`` that of the first.
        """
        view = read_only(self._record)
        fields = {name: getattr(view, name) if view[name].dtype.names else view[name][()] for name in view.dtype.names}
        return SimpleNamespace(**fields | {name: fields[name][: fields[f"n_{name}"]] for name in TABLES})

    @property
    def memory(self) -> Memory:
        """The agent's `neorl.core.layout.Memory`, as read-only views."""
        return mapped(read_only, self._memory)

    def q(self, index: int = 0) -> NDArray[np.float32]:
        """The values of one of the agent's maps, as a read-only view.

        float32 (cells, actions, cells), q[state, action, goal]; contiguous only if the agent bootstraps. If the state
        is the self, there is one: (1, actions, cells). For a node with contacts as goals (cells, actions, 3): approach,
        fear, number of visits (see `neorl.core.contacts`).

        index: the map's position in `Agent.maps`. Raises ValueError if there is none.
        """
        index = checks.integer("index", index, at_least=0, at_most=len(self.agent.maps) - 1)
        return read_only(_values_of(self.agent, self._record, self._memory, index))

    def output(self, name: str) -> Output:
        """The `Output` of the node called `name`. Raises ValueError if there is none."""
        checks.one_of("name", name, tuple(node.name for node in self.agent.nodes))
        inputs = [e for e, desire in enumerate(self.agent.desires) if desire.target == name]
        desires = self._record["desires"][inputs]
        q, valence = desires["q"], desires["total_valence"]
        vectors = as_vectors(q, self.world.actions)
        return Output(q.sum(axis=0), np.sign(valence) @ vectors, float(valence.sum()))

    def _check_faults(self):
        """Raise ValueError for a kernel of the user's that has returned NaN to the agent."""
        faults = self._record["faults"]
        if faults[0] or faults[1]:
            check_faults(faults, own_axes(self.agent), self.agent.learning.credit)

    def change(self, agent: Agent) -> None:
        """Continue as another agent, which keeps what this one has learned.

        A map keeps its values, its active cells and its memory of how they were reached if both agents have it, in a
        node of the same name with the same states and goals; a desire that both have keeps its learned valence.
        Everything else is reset, including the desires of the previous step.
        Raises ValueError unless it is an `Agent` compatible with the world, MemoryError if its values do not fit into
        the free memory.
        """
        record, memory = embodied(checks.instance("agent", agent, Agent), self.world)
        fitting_runs(record)
        record["stream"] = self._record["stream"]
        record, memory = kept_apart(record), kept_apart(with_values(record, memory))
        execute(loop.begin, record, memory, self._scene, loop_of(agent).functions)
        old_maps = {key: m for m, key in enumerate(_map_keys(self.agent))}
        for m, key in enumerate(_map_keys(agent)):
            if key in old_maps:
                _keep_map(self._record, self._memory, old_maps[key], record, memory, m)
                _values_of(agent, record, memory, m)[...] = _values_of(self.agent, self._record, self._memory,
                                                                       old_maps[key])
        for name in ("last_event", "activity"):
            record[name] = self._record[name]
        for e, desire in enumerate(agent.desires):
            if desire.valence == LEARNED and desire in self.agent.desires:
                for name in ("worth", "meetings"):
                    record["desires"][name][e] = self._record["desires"][name][self.agent.desires.index(desire)]
        vars(self).update(_agent=agent, _record=record, _memory=memory)  # at once, even if interrupted
        self._bind()

    def transfer(self, other: "Individual") -> None:
        """Copy the values of another `Learner` or `Run`, and the range of goals that its cells have learned about.

        other: one with the same maps and as many actions. Raises ValueError for anything else.
        """
        maps = checks.instance("other", other, Individual).agent.maps
        if maps != self.agent.maps or len(other.world.actions.names) != len(self.world.actions.names):
            raise ValueError(f"other must have the maps {self.agent.maps} and {len(self.world.actions.names)} actions, "
                             f"but has {maps} and {len(other.world.actions.names)}")
        for m in range(len(maps)):
            _values_of(self.agent, self._record, self._memory, m)[...] = other.q(m)
        self._memory.goal_range[:] = other._memory.goal_range

    def copy(self) -> Self:
        """An independent copy, which continues from here bit for bit the same."""
        other = object.__new__(type(self))
        other.__setstate__({name: mapped(np.copy, value) if name in self._kept else value
                            for name, value in self.__getstate__().items()})
        return other

    __copy__ = copy  # a shallow copy would share the arrays that kernels write

    def __deepcopy__(self, memo):
        return self.copy()

    def __getstate__(self):  # without compiled code, which `_bind` finds again
        return {name: getattr(self, name) for name in ("_agent", "_world", "_progress", *self._kept)}

    def __setstate__(self, state):
        vars(self).update(state)
        for name in self._kept:
            setattr(self, name, kept_apart(getattr(self, name)))
        self._bind()

    def save(self, path: str | PathLike[str]) -> None:
        """Save everything to a file, from which `load` continues bit for bit the same.

        An existing file is replaced. Raises OSError if it cannot be written, ValueError for anything but a path, and
        for an agent with a kernel that is not defined in a module. Warns of what stands in ``__main__``, which other
        programs cannot load.
        """
        data = {"agent": described(self.agent, Agent), "world": described(self.world)}
        about = data | {"code": code_of(data, self), "progress": self._progress}
        write_arrays(checks.path("path", path), type(self).__name__, about, {
            f"{name}.{each}": values for name in self._kept for each, values in arrays(getattr(self, name)).items()})
        warn_of_main(path, data)

    @classmethod
    def load(cls, path: str | PathLike[str]) -> Self:
        """Load a `Learner` or `Run` that `save` has written.

        Raises OSError if there is no such file, ValueError if it is damaged, of another kind or version, or if the
        code of a kernel or a world of the user's has changed or cannot be found.
        """
        path = checks.path("path", path)
        about, kept = read_arrays(path, cls.__name__)
        try:
            changed = changes({name: about[name] for name in ("agent", "world")}, about.get("code"))
            if not changed:
                loaded = cls._of(restored(about["agent"], Agent), restored(about["world"]))
                loaded._progress = about["progress"]
        except (ValueError, KeyError, TypeError, AttributeError) as error:
            raise ValueError(f"{path} must describe an agent in a world of this version of neorl, but "
                             f"{error!r}") from error
        if changed:
            raise ValueError(f"{path}: a {cls.__name__} must go on with the code that it was saved with, but "
                             f"{'; '.join(changed.values())}: restore that code, or begin another")
        for name in cls._kept:
            for each, mine in arrays(getattr(loaded, name)).items():
                saved = kept.get(f"{name}.{each}", np.empty(0, object))
                if (saved.dtype, saved.shape) != (mine.dtype, mine.shape):
                    raise ValueError(f"{path}: {name}.{each} must be {mine.dtype} {mine.shape}, but is {saved.dtype} "
                                     f"{saved.shape}; the file is of another version of neorl")
                mine[...] = saved
        return loaded


def _keep_map(old_record, old_memory, old_m, record, memory, m):
    """Copy the active cells of a map and its memory of how they were reached, all but its values."""
    was, now = old_record["maps"][old_m], record["maps"][m]
    for part, names in OF_A_MAP.items():
        first, end = f"first_{part}", f"end_{part}"
        for name in names if now[end] > now[first] else ():
            old, new = (getattr(all_of, name).reshape(of_all["maps"][of_all["n_maps"] - 1][end], -1)
                        for of_all, all_of in ((old_record, old_memory), (record, memory)))
            new[now[first] : now[end]] = old[was[first] : was[end]]


def _values_of(agent, record, memory, m):
    """The values of a map in the layout of `Individual.q`, as a view."""
    nres, node = record["maps"][m], [node for node in agent.nodes for _ in node.resolutions][m]
    values, cells = memory.q[nres["first_value"] : nres["end_value"]], nres["cells"]
    actions = len(record["push"])
    if node.state != "object":
        return values.reshape(1, cells, actions).swapaxes(1, 2)
    if node.goals == "contacts":
        return values.reshape(cells, actions, ENTRIES)
    if agent.learning.bootstrap:  # see `neorl.core.learning.Order`
        return values.reshape(cells, actions, cells)
    return values.reshape(cells, cells, actions).transpose(1, 2, 0)


def _map_keys(agent):
    memory = agent.learning.memory
    return [(node.name, node.goals, node.state, node.beyond, each, memory > 0 if node.state == "object" else memory)
            for node in agent.nodes for each in node.maps]
