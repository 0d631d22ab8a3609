"""Reward shaping that harms: a race to a finish, in which a buoy on the way pays, too (thesis section 3.4.1).

An agent that is paid enough at the buoy goes to and fro there, and never finishes. By the true rewards, a state from
which a policy never finishes has value 0.
"""

from dataclasses import replace

import numpy as np

from lib.chapter_3.decision import plan, policy_values

BONUSES = np.arange(0.02, 0.5, 0.02)  # the bonuses that are tried


def least_tempting(race, on_buoy, start, discount):
    """The least of `BONUSES` for which the best policy never finishes from the start; None if each lets it finish.

    race: a `Process` that pays at the finish. on_buoy: bool, of the shape of its rewards, true for steps to the buoy.
    start: a state. discount: from 0 to 0.9999.
    """
    for bonus in BONUSES:
        paid = replace(race, rewards=race.rewards + bonus * on_buoy)
        policy = plan(*paid.expected(), discount).argmax(axis=1)
        if policy_values(race, policy, discount)[start] <= 0:
            return float(bonus)
    return None


def in_words(solved, finish, least):
    """The effects of shaping on the race.

    solved: {"true", "buoy pays", "potential": (true values (states,) of the policy that is best with these rewards,
    its action values)}. finish: a state. least: of `least_tempting`.
    """
    worth = {name: values for name, (values, _) in solved.items()}
    never = 100 * (np.delete(worth["buoy pays"], finish) <= 0).mean()
    from_start = "" if least is None else f"From the start S this happens from a bonus of {least:.2f} on. "
    kept = ("exactly the best true return everywhere" if np.allclose(worth["potential"], worth["true"]) else
            "less than the best true return somewhere")
    return (f"With the buoy, {never:.0f} % of the places are the start of a race that never ends: the agent goes to "
            f"and fro at the buoy. {from_start}With the potential the policy earns {kept}.")
