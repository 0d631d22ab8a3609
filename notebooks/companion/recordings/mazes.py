"""OGBench's point mazes (arXiv 2410.20092): their environments, and data sets as its published script generates them.

`generate` follows `data_gen_scripts/generate_locomaze.py` of github.com/seohongpark/ogbench for the point: in each step
it pushes towards the next square on the shortest way to a goal, with noise, from a random square. A *navigate* episode
draws another goal whenever it reaches one; in a *stitch* episode the goal is four squares away. The sizes are those of
`commands.sh` beside the script. Episodes for validation, which the script generates after those for training, are left
out. `python -m companion.recordings.mazes FOLDER 8` writes the eight sets with each of the data seeds 0 to 7.

OGBench's own environments are used as they are, but for one thing: MuJoCo takes nine tenths of the time to find that a
point that touches no wall stays where it was put, and these steps are skipped. Tests compare the bits of both ways.
"""

import functools
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import NamedTuple

import gymnasium
import numpy as np

from neorl.common.extras import require

mujoco = require("mujoco", extra="mazes")
point = require("ogbench.locomaze.point", extra="mazes")

SIZES = {  # episodes, and steps of each
    "pointmaze-medium-navigate-v0": (1000, 1001),
    "pointmaze-large-navigate-v0": (1000, 1001),
    "pointmaze-giant-navigate-v0": (500, 2001),
    "pointmaze-teleport-navigate-v0": (1000, 1001),
    "pointmaze-medium-stitch-v0": (5000, 201),
    "pointmaze-large-stitch-v0": (5000, 201),
    "pointmaze-giant-stitch-v0": (5000, 201),
    "pointmaze-teleport-stitch-v0": (5000, 201),
}
NOISE = 0.5  # standard deviation, of a push of at most 1
APART = 4  # squares from the start to the goal of a stitch episode
UNIT = 4.0  # side of a square
CLEAR = 1.299999  # from the middle of a square, within which a point of radius .7 touches no wall around it
SIDES = ((-1, 0), (0, -1), (1, 0), (0, 1))


class Recording(NamedTuple):
    """Positions (steps, 2) and actions (steps, 2), float32, and whether each step is the last of its episode."""

    positions: np.ndarray
    actions: np.ndarray
    ends: np.ndarray


def environment(name, skip=True, **options):
    """OGBench's environment of a data set, with its own limit of steps unless an option says otherwise."""
    env = gymnasium.make(f"pointmaze-{name.split('-')[1]}-v0", disable_env_checker=True, **options)
    return skipping(env) if skip else env


def skipping(env):
    """An environment whose MuJoCo is not asked what becomes of a point that touches no wall."""
    walls = np.pad(env.unwrapped.maze_map == 1, 1, constant_values=True).tolist()
    plain = env.unwrapped.step

    def engine(model, data, nstep):
        x, y = data.qpos.tolist()
        j, i = int((x + 1.5 * UNIT) / UNIT), int((y + 1.5 * UNIT) / UNIT)  # as OGBench numbers squares
        right, down = x - UNIT * (j - 1), y - UNIT * (i - 1)
        across, along = (right > CLEAR) - (right < -CLEAR), (down > CLEAR) - (down < -CLEAR)
        row, beside = walls[i + 1], walls[i + 1 + along]
        if row[j + 1] or row[j + 1 + across] or beside[j + 1] or beside[j + 1 + across]:
            mujoco.mj_step(model, data, nstep=nstep)
        else:
            data.qacc_warmstart[:] = 0.0  # as MuJoCo leaves it, since nothing is accelerated

    def step(action):
        point.mujoco = SimpleNamespace(mj_step=engine)
        try:
            return plain(action)
        finally:
            point.mujoco = mujoco
    env.unwrapped.step = step
    return env


def generate(name, seed, episodes=None, skip=True):
    """The `Recording` of a data set, generated anew; episodes: by default as many as it has."""
    all_episodes, steps = SIZES[name]
    np.random.seed([list(SIZES).index(name), seed])  # OGBench draws from NumPy's global stream
    env = environment(name, skip, terminate_at_goal=False, max_episode_steps=steps)
    env.action_space.seed(seed)
    maze = env.unwrapped
    squares = [(i, j) for i, j in np.ndindex(maze.maze_map.shape) if maze.maze_map[i, j] == 0]
    corners = [square for square in squares if not is_hallway(maze.maze_map, *square)]
    ahead = functools.cache(lambda *pair: maze.get_oracle_subgoal(*map(maze.ij_to_xy, pair))[0])
    positions, actions, ends = [], [], []
    for episode in range(episodes or all_episodes):
        start = drawn(squares)
        goal = drawn(corners if "navigate" in name else squares_apart(maze.maze_map, start) or [start])
        task = {"init_ij": start, "goal_ij": goal}
        position, _ = env.reset(seed=None if episode else seed, options={"task_info": task})
        done = False
        while not done:
            here = maze.get_xy()
            direction = ahead(maze.xy_to_ij(here), maze.xy_to_ij(maze.cur_goal_xy)) - here
            direction = direction / (np.linalg.norm(direction) + 1e-6)
            action = np.clip(direction + np.random.normal(0, NOISE, 2), -1, 1)
            following, _, terminated, truncated, info = env.step(action)
            done = terminated or truncated
            if info["success"] and "navigate" in name:
                maze.set_goal(drawn(corners))
            positions.append(position)
            actions.append(action)
            ends.append(done)
            position = following
    return Recording(np.array(positions, np.float32), np.array(actions, np.float32), np.array(ends))


def drawn(squares):
    """One of some squares at random."""
    return squares[np.random.randint(len(squares))]


def is_hallway(maze, i, j):
    """Whether a square leads straight on, to two squares between two walls."""
    rows, columns = (maze[i - 1, j], maze[i + 1, j]), (maze[i, j - 1], maze[i, j + 1])
    return {(rows, columns)} <= {((0, 0), (1, 1)), ((1, 1), (0, 0))}


def squares_apart(maze, start):
    """The squares `APART` from a square, in the order in which a search breadth first meets them."""
    distance, reached = {start: 0}, [start]
    for i, j in reached:
        for below, right in SIDES:
            square = i + below, j + right
            if maze[square] == 0 and square not in distance:
                distance[square] = distance[i, j] + 1
                reached.append(square)
    return [square for square in reached if distance[square] == APART]


def load(folder, name, seed):
    """The `Recording` of a data set that `main` has written."""
    with np.load(Path(folder) / f"{name}-{seed}.npz") as arrays:
        return Recording(**arrays)


def main(folder, seeds):
    """Write every data set of some data seeds to a folder, one seed after the other, unless it is there."""
    for seed in range(int(seeds)):
        for name in SIZES:
            path = Path(folder) / f"{name}-{seed}.npz"
            if not path.exists():
                np.savez(path.with_suffix(".part.npz"), **generate(name, seed)._asdict())
                path.with_suffix(".part.npz").rename(path)
                print(path.name, flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
