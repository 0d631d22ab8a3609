"""Kernels for viewers: probe an agent's values anywhere, and let a reader play in WaterWorld, beside it or alone."""

import numpy as np

from neorl.core import loop
from neorl.core.choices import MapState, Vector
from neorl.core.functions import AgentFunctions
from neorl.core.geometry import cell_within, locate
from neorl.core.layout import Memory, Record
from neorl.core.scene import HALF_SECOND, Scene
from neorl.kernels.annotations import array
from neorl.kernels.kernel import kernel
from neorl.worlds.rollout import Log, count_hits
from neorl.worlds.waterworld import Rules, WaterWorldState, move_agent, reset, step, touch_creeps


@kernel
def survey(agent: Record, double: Record, memory: Memory, there: Scene, functions: AgentFunctions, side: int,
           values: array("float64", "tiles", "actions")) -> None:
    """The value of each action if the agent were in the middle of each of side × side tiles, row by row.

    double, memory: those of the agent, with tracks of their own. there: the scene, with a position of its own.
    """
    for tile in range(side * side):
        there.position[0] = (tile % side + 0.5) / side * agent.size
        there.position[1] = (tile // side + 0.5) / side * agent.size
        loop.imagine(agent, double, memory, there, functions)
        for action in range(agent.action_value.shape[0]):
            values[tile, action] = double.action_value[action]


@kernel
def cell_seen_at(agent: Record, memory: Memory, scene: Scene, functions: AgentFunctions, m: int, x: float,
                 y: float) -> int:
    """The cell of a map for a place in the world; if the map represents things, for a thing there.

    agent: a record that may be written to. Along the axes of other vectors, the cell is that of what the agent
    perceives. ABSENT for a place beyond a map that ends.
    """
    node, offset = agent.nodes[agent.maps[m].node], agent.offset
    offset[0], offset[1] = x, y
    if node.follows != Vector.position:
        for axis in range(agent.here.shape[0]):
            offset[axis] -= scene.position[axis] / agent.size
            if node.follows == Vector.velocity:
                offset[axis] /= HALF_SECOND
    locate(agent, memory, scene, functions.user, node, 0, True)
    return cell_within(agent, memory, node, agent.maps[m], agent.coordinates)


@kernel
def step_second(agent: Record, memory: Memory, scene: Scene, functions: AgentFunctions, board: WaterWorldState,
                rules: Rules, second: Scene, action: int) -> float:
    """Take an action of a second agent on the same board, and return its reward.

    scene: of the board. second: the same, with the second agent's own position and velocity. The first agent does not
    meet a creep that the second one takes: the creep's tracks restart at the fresh one, and nothing is learned from it.
    """
    move_agent(second, rules, action)
    reward, done = touch_creeps(WaterWorldState(second, board.direction, board.speed, board.jitter, board.stream),
                                rules)
    for n in range(agent.n_nodes):
        if agent.nodes[n].follows == Vector.objects and agent.nodes[n].state != MapState.self:
            for creep in range(second.met.shape[0]):
                if second.met[creep] != 0:
                    loop.begin_point(agent, memory, scene, functions, n, creep)
    if done:
        reset(board, rules)
        if agent.notices_resets:
            loop.begin(agent, memory, scene, functions)
    return reward


@kernel
def step_alone(board: WaterWorldState, rules: Rules, log: Log, action: int) -> None:
    """Take an action of a reader who is alone on a board, and write down what comes of it, as `rollout` does."""
    now = log.clock[0]
    log.clock[0] = now + 1
    reward, done = step(board, rules, action)
    log.paid[0] += reward
    log.rewards[now // log.bin_steps] += np.float32(reward)
    count_hits(board.scene, log, now)
    if done:
        reset(board, rules)
