"""What somebody who watches a run asks of its kernels: to look where the agent is not, and to join in."""

from neorl.core.horde import N_EVENTS
from neorl.core.kernel import array, kernel
from neorl.core.life import settle, settle_point
from neorl.core.modality import OBJECTS, POSITION, VELOCITY
from neorl.core.network import cell_of, evaluate, place_coordinates
from neorl.core.plan import Memory, Plan
from neorl.worlds.waterworld import Rules, WaterWorldState, move_agent, reset_board, touch_creeps

HALF_SECOND = 0.5  # a velocity is seen where it would take the agent in this time


@kernel
def survey(plan: Plan, memory: Memory, elsewhere: Memory, there: WaterWorldState, side: int,
           values: array("float64", "tiles", 4)) -> None:
    """The value of each action as if the agent were in the middle of each of side × side tiles, row by row.

    elsewhere: memory to work in, with the agent's q and known. there: the tank's state, with a position to work in.
    """
    for tile in range(side * side):
        there.agent_position[0] = (tile % side + 0.5) / side * plan.width
        there.agent_position[1] = (tile // side + 0.5) / side * plan.width
        settle(plan, elsewhere, there)
        for e in range(plan.source.shape[0]):  # recursion takes the agent's own desires of the step before
            elsewhere.worth[e] = memory.worth[e]
            for action in range(N_EVENTS):
                elsewhere.pull[e, action] = memory.pull[e, action]
        evaluate(plan, elsewhere, there)
        for action in range(N_EVENTS):
            values[tile, action] = elsewhere.value[action]


@kernel
def cell_seen_at(plan: Plan, state: WaterWorldState, m: int, x: float, y: float) -> int:
    """The cell of a map for a place in the arena; if the map is about things, for a thing there."""
    n = 0
    while plan.first_map[n + 1] <= m:
        n += 1
    if plan.vector[n] != POSITION:
        x -= state.agent_position[0] / plan.width
        y -= state.agent_position[1] / plan.width
        if plan.vector[n] == VELOCITY:
            x /= HALF_SECOND
            y /= HALF_SECOND
    u, v = place_coordinates(plan, n, x, y)
    return cell_of(plan, m, u, v)


@kernel
def step_second(plan: Plan, memory: Memory, rules: Rules, state: WaterWorldState, second: WaterWorldState,
                contacts: array("int8", "creeps"), action: int) -> float:
    """Let a second agent in the same tank do an action, and return what it is paid.

    second: the state with a position and a velocity of its own. A creep that it takes is one that the first agent has
    not met: what its maps follow instead begins anew, and nothing is learned from the leap.
    """
    move_agent(second, rules, action)
    reward, done = touch_creeps(second, rules, contacts)
    for n in range(plan.points.shape[0]):
        if plan.vector[n] == OBJECTS:
            for creep in range(contacts.shape[0]):
                if contacts[creep] != 0:
                    settle_point(plan, memory, state, n, creep)
    if done:
        reset_board(state, rules)
        settle(plan, memory, state)
    return reward
