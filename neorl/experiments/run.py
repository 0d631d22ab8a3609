"""One learner in one tank, from its first step on, in slices of any length.

Run k of a seed draws its tank from ``SeedSequence(seed).spawn(k + 1)[k]`` and its choices from the first child of
that, so it is the same run alone or among others, on one core or on several.

What the kernels take is checked before they see it: `Run.parameters`, `Run.state` and `Run.q` are views that cannot be
written to, and the tank, which can, is checked at every `Run.advance`.
"""

from typing import NamedTuple

import numpy as np
import psutil

from neorl import checks
from neorl.agents.agent import Agent
from neorl.agents.compile import compiled
from neorl.core.choices import N_EVENTS
from neorl.core.horde import as_vectors
from neorl.core.kernel import arrays, execute, mapped
from neorl.core.state import new_state
from neorl.core.stream import new_stream
from neorl.worlds.rollout import begin_tracks, rollout
from neorl.worlds.waterworld import WaterWorld, check_state

BIN_SECONDS = 0.2
CACHE_LINES = 128  # bytes; two lines, because processors fetch them in pairs
PAGE = 4_096
SLICE = 10_000  # steps between two looks at the keyboard
# What `State` has of each map, by the array that says where it begins.
OF_A_MAP = {"first_value": ("values.q",), "first_cell": ("values.goal_range",),
            "first_track": ("tracks.cell", "tracks.events", "tracks.trace_cell", "tracks.trace_rates",
                            "tracks.trace_count", "tracks.remembered_count"),
            "first_trace": ("tracks.remembered", "tracks.remembered_at", "tracks.strength", "tracks.trace_weight",
                            "tracks.trace_worth")}


class Output(NamedTuple):
    """What a node puts out (paper C, figure 3), as of the agent's last choice that was not drawn."""

    q: np.ndarray  # float64 (4,): the value of each action
    desire: np.ndarray  # float64 (2,): Σ |w| (Q_E − Q_W, Q_S − Q_N) over its elements
    valence: float  # Σ w


class Run:
    """One learner in one tank, from its first step on.

    after: a run of the same agent that is over; its values are overwritten.

    Raises ValueError for a bad argument, MemoryError if the agent's values do not fit into the free memory.
    """

    def __init__(self, agent, world, seed=0, run=0, after=None):
        checks.instance("agent", agent, Agent)
        checks.instance("world", world, WaterWorld)
        sequence = np.random.SeedSequence(checks.integer("seed", seed, at_least=0),
                                          spawn_key=(checks.integer("run", run, at_least=0),))
        old = None
        if after is not None and checks.instance("after", after, Run).agent == agent:
            old = after._state
        else:
            fitting_runs(agent)
        self._agent, self._world = agent, world
        self._parameters = kept_apart(compiled(agent, world))
        self._world_state = kept_apart(world.reset(sequence))
        stream = new_stream(sequence.spawn(1)[0])
        self._state = kept_apart(new_state(self._parameters, stream, world.n_creeps, old))
        self._step = on_lines_of_its_own(np.zeros(1, np.int64))
        self._contacts = on_lines_of_its_own(np.zeros(world.n_creeps, np.int8))
        execute(begin_tracks, self._parameters, self._state, self._world_state)

    @property
    def agent(self):
        """The `Agent`."""
        return self._agent

    @property
    def world(self):
        """The `WaterWorld`."""
        return self._world

    @property
    def world_state(self):
        """The `WaterWorldState` of the tank, whose arrays can be written to. A state that is assigned is copied."""
        return self._world_state

    @world_state.setter
    def world_state(self, state):
        check_state(state, self._world)
        for mine, given in zip(self._world_state, state):
            mine[...] = given

    @property
    def parameters(self):
        """The agent's `Parameters`, views that cannot be written to."""
        return mapped(_read_only, self._parameters)

    @property
    def state(self):
        """The agent's `State`, views that cannot be written to."""
        return mapped(_read_only, self._state)

    @property
    def step(self):
        """How many steps the run has taken."""
        return int(self._step[0])

    def advance(self, steps, rewards=None, hits=None):
        """Take `steps` more steps; returns the reward that they pay.

        rewards: float32 (bins,) and hits: int16 (bins, 2), if given, take the rewards and the green and red creeps
        of each 0.2 s since the run began. An interruption leaves a run that can go on from its `step`.
        Raises ValueError if they do not fit, or if the tank's state is not finite.
        """
        check_state(self._world_state, self._world)
        last = self.step + checks.integer("steps", steps, at_least=0)
        bin_length = bin_steps(self._world)
        if rewards is None and hits is None:
            bin_length = last + 1  # a single bin, which is not kept
        bins = -(-last // bin_length)
        rewards, hits = _bins("rewards", rewards, np.float32, bins), _bins("hits", hits, np.int16, bins, 2)
        paid = 0.0
        while self.step < last:
            paid = execute(rollout, self._parameters, self._state, self._world.rules, self._world_state, self._contacts,
                           self._step, min(last, self.step + SLICE), paid, bin_length, rewards, hits)
        return paid

    def change(self, agent):
        """Go on as another agent, which keeps what this one knows.

        A map keeps its values, its active cells and what led to them if both agents have it, in a node of the same
        name, and as much trace. All else begins anew; so do the desires of the step before.
        Raises ValueError unless it is an `Agent`, MemoryError if its values do not fit into the free memory.
        """
        fitting_runs(checks.instance("agent", agent, Agent))
        parameters = kept_apart(compiled(agent, self._world))
        state = kept_apart(new_state(parameters, self._state.stream, self._world.n_creeps))
        execute(begin_tracks, parameters, state, self._world_state)
        old, new = arrays(self._state), arrays(state)
        old_maps = {key: m for m, key in enumerate(_map_keys(self.agent))}
        for m, key in enumerate(_map_keys(agent)):
            if key in old_maps:
                for firsts, names in OF_A_MAP.items():
                    of_old, of_new = getattr(self._parameters.maps, firsts), getattr(parameters.maps, firsts)
                    begin_old, end_old = of_old[old_maps[key] : old_maps[key] + 2]
                    begin, end = of_new[m : m + 2]
                    for name in names:
                        width = len(new[name]) // of_new[-1]
                        new[name][width * begin : width * end] = old[name][width * begin_old : width * end_old]
        for name in ("last_event", "activity", "attended"):
            new[name][:] = old[name]
        vars(self).update(_agent=agent, _parameters=parameters, _state=state)  # at once, even if interrupted

    def transfer(self, other):
        """Take over the values of another run, of an agent with the same maps. Raises ValueError for other ones."""
        if checks.instance("other", other, Run).agent.maps != self.agent.maps:
            raise ValueError(f"other has the maps {other.agent.maps}, allowed are {self.agent.maps}")
        self._state.values.q[:] = other._state.values.q
        self._state.values.goal_range[:] = other._state.values.goal_range

    def output(self, name):
        """The `Output` of the node of that name. Raises ValueError if there is none."""
        checks.one_of("name", name, tuple(node.name for node in self.agent.nodes))
        inputs = [e for e, desire in enumerate(self.agent.desires) if desire.target == name]
        q, valence = self._state.desires.q[inputs], self._state.desires.valence[inputs]
        return Output(q.sum(axis=0), np.sign(valence) @ as_vectors(q), float(valence.sum()))

    def q(self, index=0):
        """The values of one of the agent's maps: float32 (cells, 4, cells), q[state, action, goal], a read-only view.

        index: the place of the map in `Agent.maps`. Raises ValueError if there is none.
        """
        maps = self.agent.maps
        index = checks.integer("index", index, at_least=0, at_most=len(maps) - 1)
        first, cells = self._parameters.maps.first_value[index], maps[index].cells
        return _read_only(self._state.values.q[first : first + N_EVENTS * cells**2].reshape(cells, N_EVENTS, cells))


def _map_keys(agent):
    rule = agent.learning
    return [(node.name, each, rule.trace, rule.memory > 0) for node in agent.nodes for each in node.maps]


def _read_only(array):
    view = array.view()
    view.flags.writeable = False
    return view


def _bins(name, given, dtype, bins, *beside):
    """Arrays for what a run brings, new ones if none are given."""
    if given is None:
        return np.zeros((bins, *beside), dtype)
    if (not isinstance(given, np.ndarray) or given.dtype != dtype or len(given) < bins or given.shape[1:] != beside
            or not given.flags.c_contiguous or not given.flags.writeable):
        found = f"{given.dtype} {given.shape}" if isinstance(given, np.ndarray) else repr(given)
        raise ValueError(f"{name} is {found}, allowed is {dtype.__name__} from {(bins, *beside)} on, contiguous and "
                         "writeable")
    return given


def fitting_runs(agent):
    """How many runs of an agent fit into nine tenths of the free memory. Raises MemoryError if there is none."""
    free = psutil.virtual_memory().available
    needed = 4 * agent.n_values
    if needed > 0.9 * free:
        raise MemoryError(f"a run of this agent needs {needed / 2**30:.1f} GiB of memory, {free / 2**30:.1f} are free")
    return int(0.9 * free // needed)


def kept_apart(fields):
    """The same named tuple, its small arrays on cache lines of their own.

    Two cores that write to one line have to take turns, which made runs side by side a sixth slower.
    """
    return mapped(lambda array: on_lines_of_its_own(array) if array.nbytes < PAGE else array, fields)


def on_lines_of_its_own(array):
    buffer = np.zeros(array.nbytes + 2 * CACHE_LINES, np.uint8)
    copy = buffer[CACHE_LINES : CACHE_LINES + array.nbytes].view(array.dtype).reshape(array.shape)
    copy[...] = array
    return copy


def bin_steps(world):
    """Steps in a bin of 0.2 s, at least one."""
    return max(1, round(BIN_SECONDS * world.fps))


def new_bins(world, runs, steps):
    bins = -(-steps // bin_steps(world))
    return np.zeros((runs, bins), np.float32), np.zeros((runs, bins, 2), np.int16)
