"""An agent in a world, with everything it has learned: the base of `neorl.Learner` and `neorl.Run`.

Parameters, state and values are read-only views. A saved file holds the state (`neorl.agents.keeping`), the agent and
its world as plain data (`neorl.description`), and the digests of the user's code in them (`neorl.worlds.former`).
"""

from dataclasses import replace
from os import PathLike
from types import SimpleNamespace
from typing import Any, NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from neorl.agents import keeping
from neorl.agents.agent import Agent, Desire, Place
from neorl.agents.embodiment import embodied, loop_of, own_axes
from neorl.agents.memory import fitting_runs, kept_apart, read_only
from neorl.common import checks
from neorl.common.alone import Alone
from neorl.common.array_files import open_arrays, write_arrays
from neorl.core import loop
from neorl.core.building import TABLES, clear_q, n_values, with_values
from neorl.core.coordinates import check_faults
from neorl.core.horde import as_vectors
from neorl.core.layout import Memory
from neorl.description import described, restored, warn_of_main
from neorl.kernels.annotations import arrays, mapped
from neorl.kernels.execution import execute
from neorl.worlds.former import changes, code_of



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
    _remedy = "use a copy()"  # instead of a call within a call

    def _begin_untrained(self, agent, world, stream, after=None):
        """Begin as an untrained agent. after: a finished one, whose memory is reused if it is large enough."""
        self._agent, self._world, self._alone, q = agent, world, Alone(self._remedy), None
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
    def learns(self) -> bool:
        """Whether it learns, True at first; may be set. Without learning it acts by what it knows.

        What it does meanwhile is not remembered. Raises ValueError for anything but True and False.
        """
        return bool(self._record["learns"])

    @learns.setter
    def learns(self, value):
        self._alone.check("learns", called_back=True)
        self._record["learns"] = checks.flag("learns", value)

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
        fear, number of visits (see `neorl.core.contacts`); of after-states (cells, 1, 3).

        index: the map's position in `Agent.maps`. Raises ValueError if there is none.
        """
        index = checks.integer("index", index, at_least=0, at_most=len(self.agent.maps) - 1)
        return read_only(keeping.values_of(self.agent, self._record, self._memory, index))

    def output(self, name: str) -> Output:
        """The `Output` of the node called `name`. Raises ValueError if there is none."""
        return self._output(name, self._record)

    def _output(self, name, record):
        checks.one_of("name", name, tuple(node.name for node in self.agent.nodes))
        inputs = [e for e, desire in enumerate(self.agent.desires) if desire.target == name]
        desires = record["desires"][inputs]
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

        A map keeps its values if both agents have it, in a node of the same name with the same states and goals; also
        its active cells and its memory of how they were reached if both remember alike. A desire that both have, for
        the same node, keeps what it was at the previous step. The worth of a kind of thing that was learned is known to
        all desires that learn it. Everything else begins afresh. So a change to the same agent changes nothing.

        Raises ValueError unless it is an `Agent` compatible with the world, and for a kernel of an axis that returns
        NaN; MemoryError if its values do not fit into the free memory, RuntimeError while another thread advances it.
        """
        checks.instance("agent", agent, Agent)
        self._alone.check("change", called_back=True)
        record, memory = embodied(agent, self.world)
        fitting_runs(record)
        record, memory = kept_apart(record), kept_apart(with_values(record, memory))
        if self._has_begun:
            execute(loop.begin, record, memory, self._scene, loop_of(agent).functions)
            check_faults(record["faults"], own_axes(agent), agent.learning.credit)
        keeping.continue_as(self.agent, self._record, self._memory, agent, record, memory)
        vars(self).update(_agent=agent, _record=record, _memory=memory)  # at once, even if interrupted
        self._bind()

    def want(self, *sources: Any, valence: float = 1.0) -> None:
        """Desire these things alone from now on, in every node that can: `change` without other nodes.

        sources: kinds of things, `Place`s, and places as the scenes have them, (axes,), in the world's units. valence:
        a number. Raises ValueError for anything else, and if no node can desire one of them.

        >>> run = neorl.Run(neorl.place_cells([5]), neorl.WaterWorld())
        >>> run.want("green", (50.0, 200.0))
        """
        wanted = [each if isinstance(each, str | Place) else Place(*(
            checks.real("sources", number) / self.world.size for number in checks.several("sources", each)))
            for each in sources]
        nodes = [node.name for node in self.agent.nodes if node.modality.takes_places]
        if wanted and not nodes:
            raise ValueError("an agent must have a node of places or of things to want one, but has none: give its "
                             "desires for points by change()")
        self.change(replace(self.agent, desires=[Desire(each, node, valence) for each in wanted for node in nodes]))

    def transfer(self, other: "Individual") -> None:
        """Copy the values of another `Learner` or `Run`, and the range of goals that its cells have learned about.

        other: one whose nodes have the same names, states, goals and maps, with as many actions. Raises ValueError for
        anything else, RuntimeError while another thread advances this one.
        """
        checks.instance("other", other, Individual)
        actions, others = len(self.world.actions.names), len(other.world.actions.names)
        if actions != others:
            raise ValueError(f"other must have {actions} actions, but has {others}")
        self._alone.check("transfer", called_back=True)
        keeping.transfer(other.agent, other._record, other._memory, self.agent, self._record, self._memory)

    def copy(self) -> Self:
        """An independent copy, which continues from here bit for bit the same.

        Raises RuntimeError while another thread advances this one.
        """
        other = object.__new__(type(self))
        other.__setstate__({name: mapped(np.copy, value) if name in self._kept else value
                            for name, value in self.__getstate__().items()})
        return other

    __copy__ = copy  # a shallow copy would share the arrays that kernels write

    def __deepcopy__(self, memo):
        return self.copy()

    def __getstate__(self):  # without compiled code, which `_bind` finds again
        self._alone.check("copy", called_back=True)
        return {name: getattr(self, name) for name in ("_agent", "_world", "_progress", *self._kept)}

    def __setstate__(self, state):
        vars(self).update(state, _alone=Alone(self._remedy))
        for name in self._kept:
            setattr(self, name, kept_apart(getattr(self, name)))
        self._bind()

    def save(self, path: str | PathLike[str]) -> None:
        """Save everything to a file, from which `load` continues bit for bit the same.

        An existing file is replaced. Raises OSError if it cannot be written, ValueError for anything but a path, for
        an agent with a kernel that is not defined in a module, and after one has returned NaN; RuntimeError while
        another thread advances this one. Warns of what stands in ``__main__``, which other programs cannot load.
        """
        self._alone.check("save", called_back=True)
        self._check_faults()
        data = {"agent": described(self.agent, Agent), "world": described(self.world)}
        about = data | {"code": code_of(data, self), "progress": self._progress}
        write_arrays(checks.path("path", path), type(self).__name__, about, self._state())
        warn_of_main(path, data)

    @classmethod
    def load(cls, path: str | PathLike[str]) -> Self:
        """Load a `Learner` or `Run` that `save` has written.

        Raises OSError if there is no such file, ValueError if it is damaged, of another kind or version, or if the
        code of a kernel or a world of the user's has changed or cannot be found.
        """
        path = checks.path("path", path)
        with open_arrays(path, cls.__name__) as file:
            try:
                changed = changes({name: file.about[name] for name in ("agent", "world")}, file.about.get("code"))
                if not changed:
                    agent, world = restored(file.about["agent"], Agent), restored(file.about["world"])
                    loaded = cls._of(agent, world)
                    loaded._progress = loaded._checked_progress(file.about["progress"])
            except (ValueError, LookupError, TypeError, AttributeError, RecursionError) as error:
                raise ValueError(f"{path} must describe an agent in a world of this version of neorl, but "
                                 f"{error!r}") from error
            if changed:
                raise ValueError(f"{path}: a {cls.__name__} must go on with the code that it was saved with, but "
                                 f"{'; '.join(changed.values())}: restore that code, or begin another")
            file.read_into(loaded._state())
        try:
            keeping.check_state(loaded._record, loaded._memory)
            loaded._check_surroundings()
        except ValueError as error:
            raise ValueError(f"{path}: {error}") from error
        return loaded

    def _state(self):
        """All arrays of its state and of its world's, by name."""
        return keeping.state_of(self._record, self._memory) | {
            f"world.{name}": array for name, array in arrays(self._surroundings).items()}
