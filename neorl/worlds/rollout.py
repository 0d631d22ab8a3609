"""The rollout of an agent in WaterWorld: choose, act, let the world move on, perceive and learn, step after step."""

import numpy as np

from neorl.core.kernel import array, kernel
from neorl.core.life import act, attend, perceive, reset_tracks
from neorl.core.network import choose
from neorl.core.parameters import Parameters
from neorl.core.state import State
from neorl.worlds.waterworld import Rules, WaterWorldState, reset_board, step_board


@kernel
def rollout(parameters: Parameters, state: State, rules: Rules, board: WaterWorldState,
            contacts: array("int8", "things"), clock: array("int64", 1), last_step: int, total: float, bin_steps: int,
            rewards: array("float32", "bins"), hits: array("int16", "bins", 2)) -> float:
    """Take the steps clock[0] … last_step − 1, adding what they pay to the bins of `rewards` and `hits`.

    contacts: working memory. total: reward so far, to which theirs is added and returned. hits: green and red creeps.
    """
    for step in range(clock[0], last_step):
        action = choose(parameters, state, board)
        act(parameters, state, action)
        reward, done = step_board(board, rules, action, contacts)
        for n in range(parameters.nodes.points.shape[0]):
            perceive(parameters, state, board, contacts, n)
        attend(parameters, state, board)
        total += reward
        interval = step // bin_steps
        rewards[interval] += np.float32(reward)
        for thing in range(contacts.shape[0]):
            hits[interval, 0] += contacts[thing] == 1
            hits[interval, 1] += contacts[thing] == -1
        if done:
            reset_board(board, rules)
            reset_tracks(parameters, state, board)
    clock[0] = last_step
    return total


@kernel
def begin_tracks(parameters: Parameters, state: State, board: WaterWorldState) -> None:
    """Start every track where things are now, see `neorl.core.life.reset_tracks`."""
    reset_tracks(parameters, state, board)
