"""Step-by-step recordings of runs in WaterWorld, for drawing and replay."""

from dataclasses import dataclass

import numpy as np

from neorl import checks
from neorl.experiments.run import Run, new_bins
from neorl.worlds.waterworld import GREEN, WaterWorld


@dataclass(frozen=True, eq=False)
class Recording:
    """The movements and captures in a tank, step by step, in board widths and seconds."""

    name: str
    fps: int
    radius: float
    agent: np.ndarray  # float32 (steps + 1, 4): position and velocity
    creeps: np.ndarray  # float32 (steps + 1, creeps, 4)
    green: np.ndarray  # bool (steps + 1, creeps)
    hits: np.ndarray  # int64 (steps + 1, 2): green and red creeps taken so far

    __eq__ = checks.equal_fields


def record(name: str, run: Run, steps: int) -> Recording:
    """Advance a run by `steps` steps, and return the `Recording`, called `name`.

    run: a `neorl.Run` in `neorl.WaterWorld`, which is advanced. steps: integer ≥ 1.
    Raises ValueError for anything else.
    """
    steps = checks.integer("steps", steps, at_least=1)
    checks.instance("world of run", checks.instance("run", run, Run).world, WaterWorld)
    scale, frames, taken = 1 / run.world.width, [], np.zeros(2, np.int64)
    rewards, hits = new_bins(run.world, 1, run.step + steps)
    for step in range(steps + 1):
        if step:
            hits[:] = 0
            run.advance(1, rewards[0], hits[0])
            taken = taken + hits[0].sum(axis=0)
        state = run.world_state
        scene, velocity = state.scene, state.direction * state.speed[:, None]
        frames.append((np.concatenate([scene.position, scene.velocity]) * scale,
                       np.hstack([scene.things, velocity]) * scale, scene.kinds == GREEN, taken))
    agent, creeps, green, hits = map(np.array, zip(*frames))
    return Recording(name, run.world.fps, run.world.radius * scale, agent.astype(np.float32),
                     creeps.astype(np.float32), green, hits)
