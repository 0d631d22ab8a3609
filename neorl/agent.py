"""A neoRL agent as data: its maps, how it learns, how it chooses, and what it values.

Everything that the thesis leaves open is a field, with the book's default reading first; nothing here runs. `compiled`
turns an agent into the flat arrays that the kernels take.
"""

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from neorl import checks
from neorl.horde import N_EVENTS, OWN_CELL
from neorl.nres import NresMap

DRIVERS = ("cell", "step")
CREDITS = ("share", "happened", "last")
WEIGHTINGS = ("equal", "resolution", "cells")
IDLE = ("random", "no-op")


@dataclass(frozen=True)
class Learning:
    """How the Horde learns (thesis section 4.1.3).

    learning_rate: α in [0, 1]. discount: γ in [0, 1] for each update.
    driver: what makes an update. "cell": a change of cell, inference inversion (eq. 4.7, 4.8); "step": every step,
        temporal difference (eq. 4.6), to which the fields below do not apply.
    credit: ψ of an event in the cell just left. "share": the share of the steps there on which it occurred;
        "happened": 1 if it occurred at all; "last": 1 for the last event only.
    absence: −ψ(0) in [0, 1]: events that did not occur sink towards zero at the rate α · absence.
    terminal: a goal reached is worth 1; otherwise 1 plus the discounted value of reaching it again.
    trace: how many of the cells left most recently learn that the cell now entered is where they led to, the k-th
        before the last at γ^k times its rate (a leaky integrator). 1 is the cell just left alone.
    bootstrap: the cell just left also learns about all other goals from the cell entered (the γ max Q of eq. 4.8).

    Raises ValueError for anything else.
    """

    learning_rate: float = 0.03
    discount: float = 0.8
    driver: str = "cell"
    credit: str = "share"
    absence: float = 0.0
    terminal: bool = True
    trace: int = 1
    bootstrap: bool = True

    def __post_init__(self):
        checks.real("learning_rate", self.learning_rate, 0, 1)
        checks.real("discount", self.discount, 0, 1)
        checks.one_of("driver", self.driver, DRIVERS)
        checks.one_of("credit", self.credit, CREDITS)
        checks.real("absence", self.absence, 0, 1)
        checks.flag("terminal", self.terminal)
        checks.integer("trace", self.trace, at_least=1)
        checks.flag("bootstrap", self.bootstrap)
        if self.driver == "step" and (self.trace, self.bootstrap, self.credit, self.absence) != (1, True, "share", 0):
            raise ValueError("driver is 'step', allowed with it are the defaults of credit, absence, trace, bootstrap")


@dataclass(frozen=True)
class Policy:
    """How the agent chooses: the action of highest value, ties broken at random (paper A, The Control Problem).

    exploration: ε in [0, 1], the share of steps on which the action is drawn instead.
    idle: what to do while every action is worth exactly 0: "random" or "no-op".
    """

    exploration: float = 0.0
    idle: str = "random"

    def __post_init__(self):
        checks.real("exploration", self.exploration, 0, 1)
        checks.one_of("idle", self.idle, IDLE)


@dataclass(frozen=True)
class Agent:
    """One neoRL agent: maps that learn side by side and add up their values (paper A, experiment 2).

    maps: one `NresMap` or more.
    weighting: of the maps in the sum. "equal"; "resolution", by N; "cells", by N².
    valence_green, valence_red: the weight of an element of interest of that colour.
    own_cell: whether an element in the agent's own cell is "silent", its desire met, or "counts".

    Raises ValueError for anything else.
    """

    maps: tuple[NresMap, ...]
    weighting: str = "equal"
    learning: Learning = field(default_factory=Learning)
    policy: Policy = field(default_factory=Policy)
    valence_green: float = 1.0
    valence_red: float = -1.0
    own_cell: str = "silent"

    def __post_init__(self):
        object.__setattr__(self, "maps", checks.several("maps", self.maps))
        if not self.maps or not all(isinstance(nres_map, NresMap) for nres_map in self.maps):
            raise ValueError(f"maps is {self.maps!r}, allowed are one NresMap or more")
        checks.one_of("weighting", self.weighting, WEIGHTINGS)
        checks.real("valence_green", self.valence_green)
        checks.real("valence_red", self.valence_red)
        checks.one_of("own_cell", self.own_cell, OWN_CELL)

    @property
    def n_values(self):
        """How many Q values a run holds; each takes four bytes."""
        return sum(N_EVENTS * nres_map.cells**2 for nres_map in self.maps)


def place_cells(resolutions, extent=(0.0, 1.0), **choices):
    """The place-cell agent of paper A: a map for each of `resolutions`; `choices` are the other fields of `Agent`."""
    resolutions = checks.several("resolutions", resolutions)
    return Agent(tuple(NresMap(resolution, extent) for resolution in resolutions), **choices)


def brownian():
    """The control: every action drawn (ε = 1), so the agent moves as in Brownian motion (paper A, fig. 6)."""
    return place_cells([1], policy=Policy(exploration=1.0))


class Plan(NamedTuple):
    """All that is chosen of an agent, as the kernels take it."""

    resolution: np.ndarray  # int64 (maps,)
    first: np.ndarray  # int64 (maps,): where in q a map begins
    first_cell: np.ndarray  # int64 (maps,): how many cells the maps before it have
    low: np.ndarray  # float64 (maps,): where the map begins, in pixels
    scale: np.ndarray  # float64 (maps,): intervals a pixel
    weight: np.ndarray  # float64 (maps,)
    valence_green: float
    valence_red: float
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
    cell: np.ndarray  # int64 (maps,): the active cell
    events: np.ndarray  # int64 (maps, 5): steps on which each action was taken since the cell was entered
    last_event: np.ndarray  # int64 (1,)
    trace_cell: np.ndarray  # int64 (maps, trace): cells left, a ring
    trace_rates: np.ndarray  # float32 (maps, trace, 4): the rates of their events
    trace_count: np.ndarray  # int64 (maps,): cells left since the episode began
    target: np.ndarray  # float32 (most cells,): working memory
    value: np.ndarray  # float64 (4,): of each action, at the last choice that was not drawn
    stream: np.ndarray  # uint64 (4,): the random numbers of the policy


def compiled(agent, width):
    """The `Plan` of an agent on a board of `width` pixels."""
    learning, policy = agent.learning, agent.policy
    resolution = np.array([nres_map.resolution for nres_map in agent.maps], np.int64)
    low, high = (width * np.array(ends, float) for ends in zip(*(nres_map.extent for nres_map in agent.maps)))
    cells, sizes = resolution**2, N_EVENTS * resolution**4
    weight = resolution.astype(float) ** WEIGHTINGS.index(agent.weighting)
    return Plan(resolution, np.cumsum(sizes) - sizes, np.cumsum(cells) - cells, low, resolution / (high - low),
                weight / weight.sum(), float(agent.valence_green), float(agent.valence_red), agent.own_cell == "counts",
                np.float32(learning.learning_rate), np.float32(learning.discount), np.float32(learning.absence),
                DRIVERS.index(learning.driver), CREDITS.index(learning.credit), learning.terminal, learning.trace,
                learning.bootstrap, float(policy.exploration), policy.idle == "no-op")


def new_memory(agent, stream):
    """The `Memory` of an agent that has learned nothing."""
    maps, trace = len(agent.maps), agent.learning.trace
    known = np.concatenate([np.tile([nres_map.cells, 0], (nres_map.cells, 1)) for nres_map in agent.maps])
    return Memory(np.zeros(agent.n_values, np.float32), known, np.zeros(maps, np.int64),
                  np.zeros((maps, N_EVENTS + 1), np.int64), np.zeros(1, np.int64), np.zeros((maps, trace), np.int64),
                  np.zeros((maps, trace, N_EVENTS), np.float32), np.zeros(maps, np.int64),
                  np.zeros(max(nres_map.cells for nres_map in agent.maps), np.float32), np.zeros(N_EVENTS), stream)
