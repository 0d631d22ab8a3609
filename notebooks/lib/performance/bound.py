"""A lower bound for the time of a step: the world's own step, and the agent's bytes at the machine's bandwidth.

Bytes that an update must move, in each map for each change of cell that it learns from, with A actions:

1. Learning all goals (bootstrapping) reads the A rows of the cell entered, and reads and writes the rows of the cell
   left whose events have a rate. A row has 4 bytes for each goal that the cells may know of.
2. A memory of k cells reads and writes A values of each, which lie together unless the agent bootstraps
   (`neorl.core.learning.Order`). The cells lie far apart in a large map, so whole lines of 64 bytes are moved.
   In a map that fits into the cache nearest to the processor, and on lines that the previous change brought there,
   each value moves 4 bytes.
3. The memory fades at every change of cell: for each cell 2 A weights, as many worths and a strength, all read and
   written, 4 bytes each. To learn, a cell's number is read (8 bytes), and its range of goals read and written (2 × 16).

And in every step:

4. Choosing reads A values for each creep in each map, 4 bytes each.
5. Every track compares its cell, 8 bytes, and counts an event, 8 bytes read and written.

The *working set* consists of all lines of values that learning touches in the timed stretch, and of the memory.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from lib.performance.bandwidth import LINE
from lib.performance.timing import again, always, in_turns
from neorl.agents.papers import multimodal, place_cells
from neorl.agents.rules import CALIBRATED
from neorl.core.kernel import array, execute, kernel
from neorl.core.stream import new_stream, randint
from neorl.evidence.statistics import estimate
from neorl.experiments.run import Run
from neorl.worlds.waterworld import Rules, WaterWorld, WaterWorldState, reset, step

NEAREST_CACHE = 2**15  # bytes, on most processors of the last decade
ALL_GOALS, MEMORY = (replace(CALIBRATED, bootstrap=cells == 0, memory=cells) for cells in (0.0, 30.0))
AGENTS = {"N23 (all goals)": place_cells([23], learning=ALL_GOALS), "N23 (memory)": place_cells([23], learning=MEMORY),
          "twelve maps (all goals)": multimodal(learning=ALL_GOALS, object_state="object"),
          "twelve maps (memory)": multimodal(learning=MEMORY, object_state="object")}
LIVED = 20_000  # steps that an agent lives before it is timed
STRETCH = 5_000  # timed steps, at most


class Moved(NamedTuple):
    """Bytes that an agent moves in a stretch of a run."""

    standing: float  # bytes per step that do not depend on learning
    ordered: float  # bytes per step that lie side by side
    scattered: float  # bytes per step of whole lines, moved for values that lie apart
    working_set: int  # bytes
    changes: float  # changes of cell per step that the agent learns from
    remembered: float  # mean number of cells remembered at such a change

    @property
    def bytes(self):
        """All bytes per step."""
        return self.standing + self.ordered + self.scattered


class Loop(NamedTuple):
    """One agent's loop, world and agent together, beside its bound. Seconds per step, each (rounds,)."""

    moved: Moved
    world: np.ndarray
    loop: np.ndarray

    def moving(self, bandwidths):
        """Seconds per step that it takes to copy the bytes in order."""
        return self.moved.bytes / bandwidths.at(self.moved.working_set)

    def ratio(self, bandwidths):
        """Time of the loop as a multiple of its bound: an `Estimate` over repetitions."""
        moving = self.moving(bandwidths)
        return estimate(lambda loop, world, axis: loop.min(axis) / (world.min(axis) + moving), self.loop, self.world)


def measure(steps, rounds, seed=0, agents=AGENTS):
    """Time the agents' loops in a tank with three creeps, in turns: {name: `Loop`}."""
    world, steps = WaterWorld(), min(steps, STRETCH)
    runs = {name: Run(agent, world, seed) for name, agent in agents.items()}
    for run in runs.values():
        run.advance(LIVED)
    timed = {"": bare(world, steps, seed), **{name: again(run, steps) for name, run in runs.items()}}
    seconds = in_turns(timed, rounds)
    return {name: Loop(moved(run.copy(), steps), seconds[""] / steps, seconds[name] / steps)
            for name, run in runs.items()}


def spent(steps, rounds, seed=0, agents=AGENTS):
    """Seconds of a step by part, averaged over random movement: {name: {part: seconds}}.

    The agents are made indifferent, so they draw their actions and all move identically. Then parts are removed: first
    learning, then desires. What is left beside the world's step is to find the active cells.
    """
    world, steps = WaterWorld(), min(steps, STRETCH)
    lives = {}
    for name, agent in agents.items():
        blank = replace(agent, learning=replace(CALIBRATED, learning_rate=0.0, memory=0.0))
        indifferent = [replace(desire, valence=0.0) for desire in agent.desires]
        for part, less in (("all", replace(agent, desires=indifferent)),
                           ("desires", replace(blank, desires=indifferent)), ("seeing", replace(blank, desires=()))):
            lives[name, part] = Run(less, world, seed)
            lives[name, part].advance(LIVED)
    times = in_turns({"": bare(world, steps, seed), **{key: again(run, steps) for key, run in lives.items()}}, rounds)
    least = {key: each.min() / steps for key, each in times.items()}
    return {name: {"world": least[""], "seeing": least[name, "seeing"] - least[""],
                   "choosing": least[name, "desires"] - least[name, "seeing"],
                   "learning": least[name, "all"] - least[name, "desires"]} for name in agents}


def bare(world, steps, seed=0):
    """A preparation for `in_turns`, to time the steps of a world without an agent, with random actions."""
    state, stream = world.reset(seed), new_stream(np.random.SeedSequence(seed))
    return always(execute, drawn_steps, state, world.rules, stream, steps)


@kernel
def drawn_steps(state: WaterWorldState, rules: Rules, stream: array("uint64", 4), steps: int) -> float:
    """Take ``steps`` steps of WaterWorld with random actions. Returns the total reward."""
    total = 0.0
    for _ in range(steps):
        reward, done = step(state, rules, randint(stream, 4))
        total += reward
        if done:
            reset(state, rules)
    return total


def moved(run, steps):
    """Advance a `Run` by ``steps``, and count the bytes that its agent moves: `Moved`.

    The agent has to desire every creep in each map, none of which has the self as its state.
    """
    maps, state, learning = run.parameters.maps, run.state, run.agent.learning
    tracks, actions = state.tracks, run.parameters.push.shape[0]
    touched = np.zeros(-(-state.values.q.nbytes // LINE), bool)
    map_of = np.repeat(np.arange(len(maps.cells)), np.diff(maps.first_track))
    standing = len(maps.cells) * run.world.things * actions * 4 + len(tracks.cell) * (8 + 2 * 8)
    ordered = scattered = changes = remembered = most = 0
    near = [np.empty(0, int)] * len(tracks.cell)  # lines that the previous change touched
    for _ in range(steps):
        before = tracks.cell.copy()
        run.advance(1)
        for track in np.flatnonzero(tracks.cell != before):
            m, left, entered = map_of[track], before[track], tracks.cell[track]
            cells, first, count = maps.cells[m], maps.first_value[m], tracks.remembered_count[track]
            ordered += count * 4 * 2 * (4 * actions + 1)  # fades
            if learning.memory > 0 and count == 0:  # the board was reset
                continue
            changes += 1
            remembered += count
            if learning.bootstrap:
                begin, end = state.values.goal_range[maps.first_cell[m] + left]
                written = actions if learning.absent_decay > 0 else np.count_nonzero(state.rates)
                ordered += 4 * (end - begin) * (actions + 2 * written)
                for row in np.add.outer([left, entered], np.zeros(actions, int)).ravel() * actions * cells + first + (
                        np.tile(np.arange(actions), 2) * cells):
                    touched[4 * (row + begin) // LINE : 4 * (row + end - 1) // LINE + 1] = True
            if learning.memory > 0:
                ordered += count * (8 + 2 * 16)
                known = tracks.remembered[maps.first_trace[m] + (track - maps.first_track[m]) * cells:][:count]
                apart, of_goal = (cells, 1) if learning.bootstrap else (1, actions)
                values = np.add.outer(first + known * actions * cells + entered * of_goal, np.arange(actions) * apart)
                lines, values_of_line = np.unique(4 * values.ravel() // LINE, return_counts=True)
                touched[lines] = True
                is_near = np.isin(lines, near[track]) | (4 * actions * cells**2 <= NEAREST_CACHE)
                scattered += 2 * LINE * np.count_nonzero(~is_near)
                ordered += 2 * 4 * values_of_line[is_near].sum()
                near[track], most = lines, max(most, tracks.remembered_count.sum())
    working_set = LINE * int(touched.sum()) + int(most) * (4 * (4 * actions + 1) + 8 + 16)
    return Moved(standing, ordered / steps, scattered / steps, working_set, changes / steps,
                 remembered / max(1, changes))
