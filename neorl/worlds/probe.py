"""Kernels for viewers: probe the values of an agent anywhere, and add a second player to WaterWorld."""

from neorl.core import life
from neorl.core.choices import MapState, Vector
from neorl.core.constants import Constants
from neorl.core.geometry import cell_within, locate
from neorl.core.kernel import array, kernel
from neorl.core.network import evaluate
from neorl.core.parameters import Parameters
from neorl.core.scene import Scene
from neorl.core.state import State
from neorl.worlds.waterworld import Rules, WaterWorldState, move_agent, reset, touch_creeps

HALF_SECOND = 0.5  # a velocity is shown at the place that the agent would reach in this time


@kernel
def survey(parameters: Parameters, constants: Constants, state: State, elsewhere: State, there: Scene, side: int,
           values: array("float64", "tiles", "actions")) -> None:
    """The value of each action if the agent were in the middle of each of side × side tiles, row by row.

    elsewhere: a scratch state with the agent's q and goal_range. there: the scene, with a scratch position.
    """
    for tile in range(side * side):
        there.position[0] = (tile % side + 0.5) / side * parameters.size
        there.position[1] = (tile // side + 0.5) / side * parameters.size
        life.begin(parameters, constants, elsewhere, there)
        for e in range(state.desires.valence.shape[0]):  # recursion uses the agent's own of the previous step
            elsewhere.desires.valence[e] = state.desires.valence[e]
            elsewhere.desires.worth[e] = state.desires.worth[e]
            for action in range(len(constants.actions)):
                elsewhere.desires.q[e, action] = state.desires.q[e, action]
        evaluate(parameters, constants, elsewhere, there)
        for action in range(len(constants.actions)):
            values[tile, action] = elsewhere.action_value[action]


@kernel
def cell_seen_at(parameters: Parameters, constants: Constants, elsewhere: State, scene: Scene, m: int, x: float,
                 y: float) -> int:
    """The cell of a map for a place in the world; if the map represents things, for a thing there.

    elsewhere: a scratch state. Along the axes of other vectors, the cell is that of what the agent perceives.
    ABSENT for a place beyond a map that ends.
    """
    nodes, offset = parameters.nodes, elsewhere.offset
    n = 0
    while nodes.first_map[n + 1] <= m:
        n += 1
    offset[0], offset[1] = x, y
    if nodes.follows[n] != Vector.position:
        for axis in range(len(constants.axes)):
            offset[axis] -= scene.position[axis] / parameters.size
            if nodes.follows[n] == Vector.velocity:
                offset[axis] /= HALF_SECOND
    locate(parameters, constants, scene, n, 0, True, offset, elsewhere.coordinates, elsewhere.faults)
    return cell_within(parameters, elsewhere.coordinates, n, m)


@kernel
def step_second(parameters: Parameters, constants: Constants, state: State, scene: Scene, board: WaterWorldState,
                rules: Rules, second: Scene, action: int) -> float:
    """Take an action of a second agent on the same board, and return its reward.

    scene: of the board. second: the same, with the second agent's own position and velocity. The first agent does not
    meet a creep that the second one takes: the creep's tracks restart at the fresh one, and nothing is learned from it.
    """
    move_agent(second, rules, action)
    reward, done = touch_creeps(WaterWorldState(second, board.direction, board.speed, board.jitter, board.stream),
                                rules)
    for n in range(parameters.nodes.points.shape[0]):
        if parameters.nodes.follows[n] == Vector.objects and parameters.nodes.state[n] != MapState.self:
            for creep in range(second.met.shape[0]):
                if second.met[creep] != 0:
                    life.begin_point(parameters, constants, state, scene, n, creep)
    if done:
        reset(board, rules)
        if parameters.notices_resets:
            life.begin(parameters, constants, state, scene)
    return reward
