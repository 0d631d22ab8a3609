"""The least that a step can take: the world's own step, and the bytes that the agent moves at the machine's bandwidth.

What an update must move, in each map for each change of cell that it learns from, with A actions:

1. Learning all goals (bootstrapping) reads the A rows of the cell entered, and reads and writes those of the cell left
   whose events have a rate. A row has 4 bytes for each goal that the cells may know of.
2. A memory of k cells reads and writes A values of each, which lie together unless the agent bootstraps
   (`neorl.core.learning.Order`). The cells lie far apart in a large map, so the values move their lines of 64 bytes.
   In a map that fits into the cache nearest to the processor, and on lines that the change before has brought there,
   each value moves 4 bytes.
3. What is remembered fades at every change of cell: of each cell 2 A weights, as many worths and a strength, all read
   and written, 4 bytes each. To learn, a cell's number is read, and its range of goals read and written: 8 and 2 × 16.

And in every step:

4. Choosing reads A values of each creep in each map, 4 bytes each.
5. Every track compares its cell, 8 bytes, and counts an event, 8 bytes read and written.

The *working set* is all lines of values that learning touches in the stretch that is timed, and what is remembered.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from neorl.agents.papers import multimodal, place_cells
from neorl.agents.rules import Learning
from neorl.chapters.performance.bandwidth import LINE
from neorl.chapters.performance.timing import again, always, in_turns
from neorl.core.kernel import array, execute, kernel
from neorl.core.stream import new_stream, randint
from neorl.evidence.statistics import estimate
from neorl.experiments.run import Run
from neorl.worlds.waterworld import Rules, WaterWorld, WaterWorldState, reset, step

NEAREST_CACHE = 2**15  # bytes, on most processors of the last decade
ALL_GOALS = Learning(bootstrap=True, memory=0.0)
AGENTS = {"N23 (all goals)": place_cells([23], learning=ALL_GOALS), "N23 (memory)": place_cells([23]),
          "twelve maps (all goals)": multimodal(learning=ALL_GOALS), "twelve maps (memory)": multimodal()}
LIVED = 20_000  # steps before an agent is timed
STRETCH = 5_000  # steps that are timed, at most


class Moved(NamedTuple):
    """What an agent moved in a stretch of a run."""

    standing: float  # bytes of every step, whatever is learned
    ordered: float  # bytes a step that lie side by side
    scattered: float  # bytes a step of lines for a value each
    working_set: int  # bytes
    changes: float  # changes of cell a step that something was learned from
    remembered: float  # cells remembered at such a change, in the mean

    @property
    def bytes(self):
        """All bytes a step."""
        return self.standing + self.ordered + self.scattered


class Loop(NamedTuple):
    """One agent's loop, world and agent together, beside its bound. Seconds a step, each (rounds,)."""

    moved: Moved
    world: np.ndarray
    loop: np.ndarray

    def moving(self, bandwidths):
        """The seconds a step that the bytes take where they are copied in order."""
        return self.moved.bytes / bandwidths.at(self.moved.working_set)

    def ratio(self, bandwidths):
        """How many times its bound the loop takes, as an `Estimate` over repetitions."""
        moving = self.moving(bandwidths)
        return estimate(lambda loop, world, axis: loop.min(axis) / (world.min(axis) + moving), self.loop, self.world)


def measure(steps, rounds, seed=0, agents=AGENTS):
    """The loops of the agents in a tank of three creeps, all in turn: {name: `Loop`}."""
    world, steps = WaterWorld(), min(steps, STRETCH)
    runs = {name: Run(agent, world, seed) for name, agent in agents.items()}
    for run in runs.values():
        run.advance(LIVED)
    timed = {"": bare(world, steps, seed), **{name: again(run, steps) for name, run in runs.items()}}
    seconds = in_turns(timed, rounds)
    return {name: Loop(moved(run.copy(), steps), seconds[""] / steps, seconds[name] / steps)
            for name, run in runs.items()}


def spent(steps, rounds, seed=0, agents=AGENTS):
    """Where the seconds of a step go, in the mean over random movement: {name: {part: seconds}}.

    The agents are made indifferent, so that they draw their actions and all move alike. Then parts are taken away: what
    they learn, and what they desire. What is left beside the world's step is to see which cells are active.
    """
    world, steps = WaterWorld(), min(steps, STRETCH)
    lives = {}
    for name, agent in agents.items():
        blank = replace(agent, learning=Learning(learning_rate=0.0, memory=0.0))
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
    """What `in_turns` takes to time the steps of a world without an agent, whose actions are drawn."""
    state, stream = world.reset(seed), new_stream(np.random.SeedSequence(seed))
    return always(execute, drawn_steps, state, world.rules, stream, steps)


@kernel
def drawn_steps(state: WaterWorldState, rules: Rules, stream: array("uint64", 4), steps: int) -> float:
    """So many steps of WaterWorld. Returns the reward."""
    total = 0.0
    for _ in range(steps):
        reward, done = step(state, rules, randint(stream, 4))
        total += reward
        if done:
            reset(state, rules)
    return total


def moved(run, steps):
    """What the agent of a `Run` moves in the coming steps, which it takes: `Moved`.

    It desires every creep in each map.
    """
    maps, state, learning = run.parameters.maps, run.state, run.agent.learning
    tracks, actions = state.tracks, run.parameters.push.shape[0]
    touched = np.zeros(-(-state.values.q.nbytes // LINE), bool)
    map_of = np.repeat(np.arange(len(maps.cells)), np.diff(maps.first_track))
    standing = len(maps.cells) * run.world.things * actions * 4 + len(tracks.cell) * (8 + 2 * 8)
    ordered = scattered = changes = remembered = most = 0
    near = [np.empty(0, int)] * len(tracks.cell)  # lines that the change before has touched
    for _ in range(steps):
        before, learned_before = tracks.cell.copy(), tracks.trace_count.copy()
        run.advance(1)
        for track in np.flatnonzero(tracks.cell != before):
            m, left, entered = map_of[track], before[track], tracks.cell[track]
            cells, first, count = maps.cells[m], maps.first_value[m], tracks.remembered_count[track]
            ordered += count * 4 * 2 * (4 * actions + 1)  # fades
            if tracks.trace_count[track] <= learned_before[track]:
                continue
            changes += 1
            remembered += count
            if learning.bootstrap:
                begin, end = state.values.goal_range[maps.first_cell[m] + left]
                rates = tracks.trace_rates[track, (tracks.trace_count[track] - 1) % learning.trace]
                written = actions if learning.absent_decay > 0 else np.count_nonzero(rates)
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
