"""What a step takes at least: the world's own step, and the bytes that an agent moves.

Bytes that an update must move, in each map for each change of cell that it learns from, with A actions:

1. Learning all goals (bootstrapping) reads the A rows of the cell entered, and reads and writes the rows of the cell
   left whose events have a rate. A row has 4 bytes for each goal that the cells may know of.
2. A memory of k cells reads and writes A values of each, which lie together unless the agent bootstraps
   (`neorl.core.learning.Order`). Whole lines of 64 bytes are moved, which the cells remembered share in part. In a map
   that fits into the cache nearest to the processor, and on lines that the previous change brought there, each value
   moves 4 bytes.
3. The memory fades at every change of cell: for each cell 2 A weights, as many worths and a strength, all read and
   written, 4 bytes each. To learn, a cell's number is read (8 bytes), and its range of goals read and written (2 × 16).

And in every step:

4. Choosing reads A values for each creep in each map, 4 bytes each.
5. Every track compares its cell, 8 bytes, and counts an event, 8 bytes read and written.

The *working set* consists of all lines of values that learning touches in the timed stretch, and of the memory.
"""

from typing import NamedTuple

import numpy as np

from companion.performance.timing import always
from neorl.core.learning import ZERO, MapValues, Rule, learn_all_goals
from neorl.core.stream import new_stream, randint
from neorl import kernel
from neorl.custom import array, execute
from neorl.worlds.waterworld import Rules, WaterWorldState, reset, step

LINE = 64  # bytes, in which memory moves
NEAREST_CACHE = 2**15  # bytes, on most processors of the last decade
RATES = np.full(4, 0.01, np.float32)


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

    The agent has to desire every creep in each map, each to have a cell for it, and none the self as its state.
    """
    maps, memory, learning = run.state.maps, run.memory, run.agent.learning
    tracks, actions = memory.tracks, run.state.push.shape[0]
    touched = np.zeros(-(-memory.q.nbytes // LINE), bool)
    map_of = np.repeat(np.arange(len(maps.cells)), maps.end_track - maps.first_track)
    standing = len(maps.cells) * run.world.things * actions * 4 + len(tracks.cell) * (8 + 2 * 8)
    ordered = scattered = changes = remembered = most = 0
    near = [np.empty(0, int)] * len(tracks.cell)  # lines that the previous change touched
    for _ in range(steps):
        before = tracks.cell.copy()
        run.advance(1)
        for track in np.flatnonzero(tracks.cell != before):
            m, left, entered = map_of[track], before[track], tracks.cell[track]
            cells, first, count = maps.cells[m], maps.first_value[m], tracks.remembered[track]
            ordered += count * 4 * 2 * (4 * actions + 1)  # fades
            if learning.memory > 0 and count == 0:  # the board was reset
                continue
            changes += 1
            remembered += count
            if learning.bootstrap:
                begin, end = memory.goal_range[maps.first_cell[m] + left]
                written = actions if learning.absent_decay > 0 else np.count_nonzero(run.state.rates)
                ordered += 4 * (end - begin) * (actions + 2 * written)
                for row in np.add.outer([left, entered], np.zeros(actions, int)).ravel() * actions * cells + first + (
                        np.tile(np.arange(actions), 2) * cells):
                    touched[4 * (row + begin) // LINE : 4 * (row + end - 1) // LINE + 1] = True
            if learning.memory > 0:
                ordered += count * (8 + 2 * 16)
                known = memory.remembered[maps.first_trace[m] + (track - maps.first_track[m]) * cells:][:count]
                rows, apart = ((known * actions * cells + entered, cells) if learning.bootstrap else
                               ((entered * cells + known) * actions, 1))
                values = np.add.outer(first + rows, np.arange(actions) * apart)
                lines, values_of_line = np.unique(4 * values.ravel() // LINE, return_counts=True)
                touched[lines] = True
                is_near = np.isin(lines, near[track]) | (4 * actions * cells**2 <= NEAREST_CACHE)
                scattered += 2 * LINE * np.count_nonzero(~is_near)
                ordered += 2 * 4 * values_of_line[is_near].sum()
                near[track], most = lines, max(most, tracks.remembered.sum())
    working_set = LINE * int(touched.sum()) + int(most) * (4 * (4 * actions + 1) + 8 + 16)
    return Moved(standing, ordered / steps, scattered / steps, working_set, changes / steps,
                 remembered / max(1, changes))


def learning_all_goals(resolution, changes, seed=0):
    """A preparation for `in_turns`, to time learning all goals along a random walk."""
    cells, rng = resolution**2, np.random.default_rng(seed)
    moves = rng.choice([-1, 1, -resolution, resolution], changes + 1)
    path = np.clip(np.cumsum(moves) + cells // 2, 0, cells - 1)
    values = MapValues(np.full(4 * cells**2, 0.1, np.float32), 0, cells, 4, np.tile([0, cells], (cells, 1)),
                       np.empty(cells, np.float32))
    return always(execute, learn_along, values, Rule(np.float32(0.9), True, ZERO, False), path, RATES)


@kernel
def learn_along(values: MapValues, rule: Rule, path: array("int64", "cells"), rates: array("float32", 4)) -> None:
    """Learn all goals from each change of cell along a path."""
    for change in range(path.shape[0] - 1):
        learn_all_goals(values, rule, path[change], path[change + 1], rates)
