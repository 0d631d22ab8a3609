"""Kernels for viewers: probe the values of an agent where it is not, and add a second player."""

from neorl.core.choices import Vector
from neorl.core.geometry import cell_of, place_coordinates
from neorl.core.kernel import array, kernel
from neorl.core.life import reset_point, reset_tracks
from neorl.core.network import evaluate
from neorl.core.parameters import Parameters
from neorl.core.state import State
from neorl.worlds.waterworld import Rules, WaterWorldState, move_agent, reset_board, touch_creeps

HALF_SECOND = 0.5  # a velocity is seen where it would take the agent in this time


@kernel
def survey(parameters: Parameters, state: State, elsewhere: State, there: WaterWorldState, side: int,
           values: array("float64", "tiles", 4)) -> None:
    """The value of each action as if the agent were in the middle of each of side × side tiles, row by row.

    elsewhere: a state to work in, with the agent's q and goal_range. there: the board, with a position to work in.
    """
    for tile in range(side * side):
        there.agent_position[0] = (tile % side + 0.5) / side * parameters.width
        there.agent_position[1] = (tile // side + 0.5) / side * parameters.width
        reset_tracks(parameters, elsewhere, there)
        for e in range(state.desires.valence.shape[0]):  # recursion takes the agent's own desires of the step before
            elsewhere.desires.valence[e] = state.desires.valence[e]
            for action in range(N_EVENTS):
                elsewhere.desires.q[e, action] = state.desires.q[e, action]
        evaluate(parameters, elsewhere, there)
        for action in range(N_EVENTS):
            values[tile, action] = elsewhere.action_value[action]


@kernel
def cell_seen_at(parameters: Parameters, board: WaterWorldState, m: int, x: float, y: float) -> int:
    """The cell of a map for a place in the arena; if the map is about things, for a thing there."""
    nodes = parameters.nodes
    n = 0
    while nodes.first_map[n + 1] <= m:
        n += 1
    if nodes.vector[n] != Vector.position:
        x -= board.agent_position[0] / parameters.width
        y -= board.agent_position[1] / parameters.width
        if nodes.vector[n] == Vector.velocity:
            x /= HALF_SECOND
            y /= HALF_SECOND
    u, v = place_coordinates(nodes, n, x, y)
    return cell_of(parameters.maps, m, u, v)


@kernel
def step_second(parameters: Parameters, state: State, rules: Rules, board: WaterWorldState, second: WaterWorldState,
                contacts: array("int8", "things"), action: int) -> float:
    """Let a second agent on the same board do an action, and return what it is paid.

    second: the board with a position and a velocity of its own. A creep that it takes is one that the first agent has
    not met: what its maps follow instead starts anew, and nothing is learned from the leap.
    """
    move_agent(second, rules, action)
    reward, done = touch_creeps(second, rules, contacts)
    for n in range(parameters.nodes.points.shape[0]):
        if parameters.nodes.vector[n] == Vector.objects:
            for creep in range(contacts.shape[0]):
                if contacts[creep] != 0:
                    reset_point(parameters, state, board, n, creep)
    if done:
        reset_board(board, rules)
        reset_tracks(parameters, state, board)
    return reward
