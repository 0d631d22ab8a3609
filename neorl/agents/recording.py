"""Recordings of what somebody did, from which a `Learner` learns: positions or scenes, and actions between them.

1. A recording consists of *stretches*, across whose ends nothing is learned: it may jump there, as between trials, or
   the animal may have been lost.
2. A continuous action, such as a velocity, counts for the action of the agent whose push has the nearest direction;
   without actions, the displacements count. A push of 0 is no event, as an idle step is none.
3. In each step the agent learns exactly as by `Learner.observe` with this action: from any behaviour, all goals at once
   (thesis section 4.1.3).
"""

from typing import NamedTuple

import numpy as np

from neorl.agents.scenes import Offer, accept
from neorl.common import checks
from neorl.core.functions import Loop
from neorl.core.layout import Memory, Record
from neorl.core.scene import Scene
from neorl.kernels.annotations import array, new_tuple, tabled
from neorl.kernels.kernel import kernel

STEP, BEGINS, JUMPS = range(3)  # what a row is to an agent; after a jump it does not begin again
STEADY = 1e-3  # timestamps differ by no greater share from steady ones


@tabled
class Recording(NamedTuple):
    """Scenes one after the other, and what led to each. Lost positions are left out."""

    row: array("int64", "rows")  # STEP, BEGINS or JUMPS
    action: array("int64", "rows")  # the number of the action that led to it
    reward: array("float64", "rows")  # of that action
    position: array("float64", "rows", "axes")
    velocity: array("float64", "rows", "axes")
    things: array("float64", "rows", "things", "axes")
    kinds: array("int64", "rows", "things")
    met: array("int64", "rows", "things")


@tabled
class Watching(NamedTuple):
    """An agent and what it watches: all that its steps take, by one pointer."""

    agent: Record
    memory: Memory
    scene: Scene
    loop: Loop
    offer: Offer
    recording: Recording


@kernel
def watch(watching: Watching, first: int, end: int) -> None:
    """Learn from the rows first … end − 1."""
    agent, offered, recording = watching.agent, watching.offer.scene, watching.recording
    for row in range(first, end):
        for axis in range(offered.position.shape[0]):
            offered.position[axis] = recording.position[row, axis]
            offered.velocity[axis] = recording.velocity[row, axis]
        for thing in range(offered.kinds.shape[0]):
            offered.kinds[thing], offered.met[thing] = recording.kinds[row, thing], recording.met[row, thing]
            for axis in range(offered.position.shape[0]):
                offered.things[thing, axis] = recording.things[row, thing, axis]
        accept(watching.offer, watching.scene)
        if recording.row[row] == STEP:
            agent.last_event, agent.reward = recording.action[row], recording.reward[row]
            watching.loop.observe(agent, watching.memory, watching.scene, watching.loop.functions)
        elif recording.row[row] == BEGINS:
            watching.loop.begin(agent, watching.memory, watching.scene, watching.loop.functions)


def recorded(scenes, actions, rewards, ends, pushes, jump):
    """The `Recording` of scenes, a `Scene` of arrays with a row for each; lost positions are NaN.

    actions, rewards, ends: as in `Learner.watch`. pushes: `neorl.core.scene.Actions`. jump: BEGINS or JUMPS, at the
    beginning of a stretch. Raises ValueError for anything else.
    """
    count = len(scenes.position)
    lost = np.isnan(scenes.position).any(axis=1)
    breaks = np.zeros(count, bool)  # after a position
    breaks[_indices("ends", ends, count)] = True
    begins = np.append(True, lost[:-1] | breaks[:-1])[~lost]
    steps = np.flatnonzero(~lost)[~begins] - 1  # those that are learned from
    taken = _actions(actions, scenes.position, steps, pushes)
    sizes = {"rows": int(np.sum(~lost)), "axes": scenes.position.shape[1], "things": scenes.kinds.shape[1]}
    recording = new_tuple(Recording, sizes, {name: np.ascontiguousarray(values[~lost])
                                             for name, values in scenes._asdict().items()})
    recording.row[begins] = jump
    recording.action[~begins] = taken
    if rewards is not None:
        recording.reward[~begins] = _of_steps("rewards", rewards, (count - 1,), steps)
    return recording


def check_places(positions, agent, size):
    """Raise ValueError for positions beyond the maps of places of an agent."""
    for along in range(positions.shape[1]):
        ranges = [(axis.low * size, axis.high * size) for node in agent.nodes for axis in node.modality.axes
                  if (axis.of, axis.feature, axis.along) == ("position", "component", along) and not axis.closed]
        if not ranges:
            continue
        low, high, mine = min(ranges)[0], max(high for _, high in ranges), positions[:, along]
        outside = np.sum((mine < low) | (mine > high))
        if outside:
            raise ValueError(f"positions along axis {along} must be from {low:g} to {high:g}, as the agent's maps of "
                             f"places are, but {outside:,} of {len(mine):,} are outside, from {np.nanmin(mine):g} to "
                             f"{np.nanmax(mine):g}: scale and shift them, or give the maps that range{_timely(mine)}")


def nearest_action(push, actions):
    """The number of the action with the direction nearest to a push, (…, axes): int64 (…). Idleness for a push of 0."""
    table = np.array(actions.pushes, float)
    table /= np.maximum(np.sqrt(np.sum(table * table, axis=1, keepdims=True)), np.finfo(float).tiny)
    along = sum(push[..., axis, np.newaxis] * table[:, axis] for axis in range(actions.axes))
    return np.where(np.any(push != 0.0, axis=-1), along.argmax(axis=-1), len(table))


def _actions(actions, positions, steps, pushes):
    """The numbers of the actions of some steps."""
    if actions is None:
        return nearest_action(positions[steps + 1] - positions[steps], pushes)
    array, count = checks.as_array("actions", actions), len(positions) - 1
    if array.ndim == 2:
        return nearest_action(_of_steps("actions", array, (count, pushes.axes), steps), pushes)
    numbers = _of_steps("actions", array, (count,), steps)
    wrong = (numbers != np.floor(numbers)) | (numbers < 0) | (numbers > len(pushes.names))
    if wrong.any():
        raise checks.error("actions", f"numbers of actions from 0 to {len(pushes.names)}, which stands for none, or "
                           f"pushes of the shape (steps, {pushes.axes})", numbers[wrong][0])
    return numbers.astype(np.int64)


def _of_steps(name, values, shape, steps):
    """The values of some steps, as doubles. Raises ValueError unless there is a finite one for each step."""
    array = checks.as_array(name, values)
    if array.shape != shape or array.dtype.kind not in "fiub":
        raise ValueError(f"{name} must be numbers of the shape {shape}, one for each step between two positions, but "
                         f"{'are' if array.dtype.kind in 'fiub' else 'is'} {checks.shown(values)}, of the shape "
                         f"{array.shape}")
    array = array[steps].astype(float)
    wrong = ~np.isfinite(array.reshape(len(array), -1)).all(axis=1)
    if wrong.any():
        raise ValueError(f"{name} must be finite in all steps that are learned from, but {np.sum(wrong):,} of "
                         f"{len(wrong):,} are not, first that of step {steps[wrong][0]:,}: end the stretch before it "
                         "by ends, or by a position of NaN")
    return array


def _indices(name, values, count):
    """Indices of positions, also as a mask of positions or of steps."""
    array = checks.as_array(name, values)
    if array.dtype.kind == "b" and array.shape in ((count,), (count - 1,)):
        return np.flatnonzero(array)
    if array.size == 0:
        return []
    if array.ndim != 1 or array.dtype.kind not in "iu" or not 0 <= array.min() <= array.max() < count:
        raise checks.error(name, f"indices of positions, from 0 to {count - 1}, or a truth value for each", values)
    return array


def _timely(column):
    """A hint, if a column looks like timestamps."""
    steps = np.diff(column)
    steady = len(steps) > 1 and steps.min() > 0 and np.ptp(steps) <= STEADY * steps.mean()
    return "; it rises steadily, as timestamps do: leave these out" if steady else ""
