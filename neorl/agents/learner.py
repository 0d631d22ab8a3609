"""An agent that lives: in a loop of the user's own, step by step (`Learner`).

What the kernels take is checked before they see it; parameters, state and values are views that cannot be written to.
"""

import hashlib
import io
import json
import zipfile
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np

from neorl import checks
from neorl.agents.agent import Agent
from neorl.agents.compile import compiled, constants_of
from neorl.agents.description import described, restored
from neorl.agents.memory import fitting_runs, kept_apart, read_only
from neorl.core.binding import bound
from neorl.core.horde import as_vectors
from neorl.core.kernel import arrays, execute, kernel, mapped, new_tuple
from neorl.core.scene import ABSENT, CARDINAL, Actions, Scene
from neorl.core.state import new_state
from neorl.core.steps import steps_with
from neorl.core.stream import new_stream
from neorl.files import write_whole

# What `State` has of each map, by the array that says where it begins.
OF_A_MAP = {"first_value": ("values.q",), "first_cell": ("values.goal_range",),
            "first_track": ("tracks.cell", "tracks.events", "tracks.trace_cell", "tracks.trace_rates",
                            "tracks.trace_count", "tracks.remembered_count"),
            "first_trace": ("tracks.remembered", "tracks.remembered_at", "tracks.strength", "tracks.trace_weight",
                            "tracks.trace_worth")}
FORMAT = 1  # of saved files


class Output(NamedTuple):
    """What a node puts out (paper C, figure 3), as of the agent's last choice that was not drawn."""

    q: np.ndarray  # float64 (actions,): the value of each action
    desire: np.ndarray  # float64 (axes,): Σ |w| push · Q over its elements; in WaterWorld (Q_E − Q_W, Q_S − Q_N)
    valence: float  # Σ w


class Individual:
    """An agent with all that it knows, in a world: what `Learner` and `neorl.Run` have in common.

    Raises ValueError if the agent and the world do not go together, MemoryError if its values do not fit into the free
    memory.
    """

    def _live(self, agent, world, stream, scene, after=None):
        """Begin as an agent that knows nothing. after: one of the same agent that is over and gives up its memory."""
        old = after._state if after is not None and (after.agent, after.world) == (agent, world) else None
        if old is None:
            fitting_runs(agent, world)
        self._agent, self._world, self._scene = agent, world, scene
        self._parameters = kept_apart(compiled(agent, world))
        self._state = kept_apart(new_state(self._parameters, stream, world.things, old))

    @property
    def agent(self):
        """The `Agent`."""
        return self._agent

    @property
    def world(self):
        """The world, or for a `Learner` what it knows of it."""
        return self._world

    @property
    def parameters(self):
        """The agent's `Parameters`, views that cannot be written to."""
        return mapped(read_only, self._parameters)

    @property
    def state(self):
        """The agent's `State`, views that cannot be written to."""
        return mapped(read_only, self._state)

    def q(self, index=0):
        """The values of one of the agent's maps: float32 (cells, actions, cells), q[state, action, goal], a view that
        cannot be written to.

        index: the place of the map in `Agent.maps`. Raises ValueError if there is none.
        """
        maps = self.agent.maps
        index = checks.integer("index", index, at_least=0, at_most=len(maps) - 1)
        first, end = self._parameters.maps.first_value[index : index + 2]
        return read_only(self._state.values.q[first:end].reshape(maps[index].cells, -1, maps[index].cells))

    def output(self, name):
        """The `Output` of the node of that name. Raises ValueError if there is none."""
        checks.one_of("name", name, tuple(node.name for node in self.agent.nodes))
        inputs = [e for e, desire in enumerate(self.agent.desires) if desire.target == name]
        q, valence = self._state.desires.q[inputs], self._state.desires.valence[inputs]
        vectors = as_vectors(q, self.world.actions)
        return Output(q.sum(axis=0), np.sign(valence) @ vectors, float(valence.sum()))

    def change(self, agent):
        """Go on as another agent, which keeps what this one knows.

        A map keeps its values, its active cells and what led to them if both agents have it, in a node of the same
        name, and as much trace. All else begins anew; so do the desires of the step before.
        Raises ValueError unless it is an `Agent` that goes with the world, MemoryError if its values do not fit into
        the free memory.
        """
        fitting_runs(checks.instance("agent", agent, Agent), self.world)
        parameters = kept_apart(compiled(agent, self.world))
        state = kept_apart(new_state(parameters, self._state.stream, self.world.things))
        execute(steps_with(constants_of(agent, self.world)).begin, parameters, state, self._scene)
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
        self._bind()

    def transfer(self, other):
        """Take over the values of another `Learner` or `Run`, and which goals its cells know of.

        Raises ValueError unless it has the same maps and as many actions.
        """
        maps = checks.instance("other", other, Individual).agent.maps
        if maps != self.agent.maps or len(other.world.actions.names) != len(self.world.actions.names):
            raise ValueError(f"other has the maps {maps} and {len(other.world.actions.names)} actions, allowed are "
                             f"{self.agent.maps} and {len(self.world.actions.names)}")
        self._state.values.q[:] = other._state.values.q
        self._state.values.goal_range[:] = other._state.values.goal_range

    def copy(self):
        """One that goes on by itself from here, to the same bits."""
        other = object.__new__(type(self))
        vars(other).update(vars(self))
        for name in self._kept:
            setattr(other, name, kept_apart(mapped(np.copy, getattr(self, name))))
        other._bind()
        return other

    __copy__ = copy  # any other would share what is written to

    def __deepcopy__(self, memo):
        return self.copy()

    def save(self, path):
        """Write all to a file, by which `load` goes on to the same bits.

        Raises ValueError for an agent with a kernel that no module has.
        """
        about = {"format": FORMAT, "is": type(self).__name__, "agent": described(self.agent),
                 "world": described(self.world), "progress": self._progress}
        kept = {f"{name}.{each}": values for name in self._kept
                for each, values in arrays(getattr(self, name)).items()}
        about["digest"] = _digest(kept)
        content = io.BytesIO()
        np.savez(content, about=np.array(json.dumps(about)), **kept)
        write_whole(path, content.getbuffer())

    @classmethod
    def load(cls, path):
        """What `save` has written.

        Raises OSError if there is no such file, ValueError if it is damaged, or of another kind or version.
        """
        try:
            with Path(path).open("rb") as opened, np.load(opened, allow_pickle=False) as file:
                kept = {name: file[name] for name in file.files}
            about = json.loads(str(kept.pop("about")))
            digest = about["digest"]
        except (ValueError, KeyError, TypeError, EOFError, zipfile.BadZipFile) as error:
            raise ValueError(f"{path} is damaged, or was not written by neorl: {error}") from error
        if (about.get("format"), about.get("is")) != (FORMAT, cls.__name__) or digest != _digest(kept):
            raise ValueError(f"{path} holds a {about.get('is')} of format {about.get('format')}, or is damaged; "
                             f"allowed is a {cls.__name__} of format {FORMAT}")
        try:
            loaded = cls._of(restored(about["agent"]), restored(about["world"]))
            loaded._progress = about["progress"]
        except (ValueError, KeyError, TypeError, AttributeError) as error:
            raise ValueError(f"{path} describes no agent in a world of this version of neorl: {error!r}") from error
        for name in cls._kept:
            for each, mine in arrays(getattr(loaded, name)).items():
                saved = kept.get(f"{name}.{each}", np.empty(0))
                if (saved.dtype, saved.shape) != (mine.dtype, mine.shape):
                    raise ValueError(f"{path} has {saved.dtype} {saved.shape} for {name}.{each}, allowed is "
                                     f"{mine.dtype} {mine.shape}: it is of another version of neorl")
                mine[...] = saved
        return loaded


def _map_keys(agent):
    rule = agent.learning
    return [(node.name, each, rule.trace, rule.memory > 0) for node in agent.nodes for each in node.maps]


def _digest(kept):
    digest = hashlib.sha256()
    for name in sorted(kept):
        digest.update(f"{name} {kept[name].dtype} {kept[name].shape}".encode())
        digest.update(np.ascontiguousarray(kept[name]).data)
    return digest.hexdigest()


@dataclass(frozen=True)
class Surroundings(checks.Final):
    """What an agent knows of a world that is not made of kernels; see `Learner` for the fields."""

    things: int
    kinds: tuple[str, ...]
    actions: Actions
    size: float
    fps: float

    def __post_init__(self):
        kinds = tuple(checks.instance("kinds", each, str) for each in checks.several("kinds", self.kinds))
        if len(set(kinds)) < len(kinds):
            raise ValueError(f"kinds is {kinds!r}, allowed is each name once")
        checks.instance("actions", self.actions, Actions)
        checks.assign(self, things=checks.integer("things", self.things, at_least=0, at_most=2**20), kinds=kinds,
                     size=checks.real("size", self.size), fps=checks.real("fps", self.fps))
        for name in ("size", "fps"):
            if getattr(self, name) <= 0:
                raise ValueError(f"{name} is {getattr(self, name)!r}, allowed are numbers above 0")


class Learner(Individual):
    """An agent in a loop of the user's own: `begin` with a scene, then `act` and `observe` by turns.

    agent: an `Agent`. things: how many things there are at any time at most. kinds: the names of their kinds, that
    which an agent wants by default first. actions: what the agent can do, an `Actions`; by default N, S, E, W, and to
    be idle. seed: integer ≥ 0, of the agent's random numbers. size: the world's unit of length, such as its width.
    fps: steps a second, which memories in seconds depend on.

    Raises ValueError for anything else, or if agent and world do not go together, MemoryError if the agent's values do
    not fit into the free memory.
    """

    _kept = ("_state", "_scene")

    def __init__(self, agent, things=0, kinds=(), actions=CARDINAL, seed=0, size=1.0, fps=50):
        checks.instance("agent", agent, Agent)
        world = Surroundings(things, kinds, actions, size, fps)
        seed = checks.integer("seed", seed, at_least=0)
        sizes = {"things": world.things, "axes": actions.axes}
        scene = kept_apart(new_tuple(Scene, sizes, {}))
        self._live(agent, world, new_stream(np.random.SeedSequence(seed)), scene)
        self._progress = "before the first scene"
        self._bind()

    @classmethod
    def _of(cls, agent, world):
        return cls(agent, world.things, world.kinds, world.actions, 0, world.size, world.fps)

    def _bind(self):
        self._steps = steps_with(constants_of(self.agent, self.world))
        self._offered = mapped(np.copy, self._scene)
        self._calls = [bound(each, self._parameters, self._state, self._scene) for each in self._steps]
        self._accept = bound(accept, Offer(len(self.world.kinds), self._offered), self._scene)
        self._numbers = {None: ABSENT, **{name: number for number, name in enumerate(self.world.kinds)},
                         **{number: number for number in range(ABSENT, len(self.world.kinds))}}

    def begin(self, scene):
        """Begin, or begin anew after a leap, such as at the start of an episode: nothing is learned from it.

        scene: a `neorl.Scene`, as in `observe`. Raises ValueError for one that does not fit.
        """
        self._take(scene)
        self._calls[0]()
        self._progress = "to act"

    def act(self):
        """Choose an action, and return its number, 0 … actions − 1, or the number of actions for being idle.

        Raises RuntimeError before the first scene, or if what the last action has led to was not observed.
        """
        if self._progress != "to act":
            raise RuntimeError(f"act() came {self._progress}, allowed is act() after begin(scene) or observe(scene)")
        action = self._calls[1]()
        self._progress = "twice"
        return action

    def observe(self, scene):
        """Perceive what the last action has led to, and learn from it.

        scene: a `neorl.Scene` of numbers, or anything with its fields: position and velocity, (axes,), if velocity is
            None at rest; things, (things, axes), where they are; kinds, for each its kind's name or number, or None
            while it is absent; met, for each whether it was met in this step, () if none was. A thing that was met may
            have moved, changed its kind or vanished: its slot is that of a fresh one.

        Raises ValueError for one that does not fit or is not finite, RuntimeError unless the agent has acted.
        """
        if self._progress != "twice":
            raise RuntimeError("observe(scene) came before act(), allowed is observe(scene) after it")
        self._take(scene)
        self._calls[2]()
        self._progress = "to act"

    def _take(self, scene):
        """Check a scene, and copy it."""
        offered, things = self._offered, self.world.things
        _put("position", offered.position, scene.position)
        if scene.velocity is None:
            offered.velocity[:] = 0.0
        else:
            _put("velocity", offered.velocity, scene.velocity)
        if things or len(scene.things):
            _put("things", offered.things, scene.things)
            try:
                _put("kinds", offered.kinds, [self._numbers[each] for each in scene.kinds])
            except (KeyError, TypeError):
                raise ValueError(f"scene.kinds is {scene.kinds!r}, allowed are {', '.join(map(repr, self._numbers))}"
                                 ) from None
            if len(scene.met):
                _put("met", offered.met, scene.met)
            else:
                offered.met[:] = 0
        if not self._accept():
            raise ValueError(f"scene is {scene}, allowed are finite numbers")


class Offer(NamedTuple):
    """A scene to be checked."""

    n_kinds: int
    scene: Scene


@kernel
def accept(offer: Offer, scene: Scene) -> bool:
    """Take over a scene if its numbers are finite but for things that are absent; whether they are."""
    offered = offer.scene
    for axis in range(offered.position.shape[0]):
        if not (abs(offered.position[axis]) < np.inf and abs(offered.velocity[axis]) < np.inf):
            return False
    for thing in range(offered.kinds.shape[0]):
        for axis in range(offered.position.shape[0]):
            if offered.kinds[thing] < 0:
                offered.things[thing, axis] = 0.0
            elif not abs(offered.things[thing, axis]) < np.inf:
                return False
    for axis in range(offered.position.shape[0]):
        scene.position[axis], scene.velocity[axis] = offered.position[axis], offered.velocity[axis]
    for thing in range(offered.kinds.shape[0]):
        for axis in range(offered.position.shape[0]):
            scene.things[thing, axis] = offered.things[thing, axis]
        scene.kinds[thing] = offered.kinds[thing]
        scene.met[thing] = offered.met[thing] != 0
    return True


def _put(name, mine, given):
    values = np.asarray(given)
    if values.shape != mine.shape or values.dtype.kind not in "fiub":
        raise ValueError(f"scene.{name} is {given!r}, allowed are numbers of the shape {mine.shape}")
    mine[...] = values
