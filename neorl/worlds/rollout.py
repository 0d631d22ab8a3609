"""An agent in WaterWorld: choose, act, let the world move on, perceive and learn, step after step."""

import numpy as np

from neorl.core.kernel import array, kernel
from neorl.core.life import act, attend, choose, perceive, settle
from neorl.core.plan import Memory, Plan
from neorl.worlds.waterworld import Rules, WaterWorldState, reset_board, step_board


@kernel
def rollout(plan: Plan, memory: Memory, rules: Rules, state: WaterWorldState, contacts: array("int8", "creeps"),
         first_step: int, last_step: int, bin_steps: int, rewards: array("float32", "bins"),
         hits: array("int16", "bins", 2)) -> float:
    """Live the steps first_step … last_step − 1, adding what they bring to the bins of `rewards` and `hits`.

    Returns the reward that they bring in all. contacts: working memory. hits: green and red creeps.
    """
    total = 0.0
    for step in range(first_step, last_step):
        action = choose(plan, memory, state)
        act(plan, memory, action)
        reward, done = step_board(state, rules, action, contacts)
        for n in range(plan.points.shape[0]):
            perceive(plan, memory, state, contacts, n)
        attend(plan, memory, state)
        total += reward
        interval = step // bin_steps
        rewards[interval] += np.float32(reward)
        for creep in range(contacts.shape[0]):
            hits[interval, 0] += contacts[creep] == 1
            hits[interval, 1] += contacts[creep] == -1
        if done:
            reset_board(state, rules)
            begin_tracks(plan, memory, state)
    return total


@kernel
def begin_tracks(plan: Plan, memory: Memory, state: WaterWorldState) -> None:
    """Begin every track where things are now, see `neorl.core.life.settle`."""
    settle(plan, memory, state)
