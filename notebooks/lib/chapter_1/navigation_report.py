"""Sentences on the rewards of newborns, veterans and a rule in the tank.

`lib.chapter_1.before_and_after` defines newborns and veterans, `lib.chapter_1.steering` the rule.
"""

import numpy as np

from lib.shared.wording import table
from neorl.evidence.statistics import difference, estimate, probability_of_improvement


def in_short(newborns, veterans, by_rule, minutes):
    """The worth of experience in the tank, in three sentences, from the rewards per second of `first_minutes`.

    minutes: how long a veteran has lived.
    """
    gain, chance = estimate(difference, veterans, newborns), probability_of_improvement(veterans, newborns)
    return (f"{describe_gain(gain)}: in its first minute on a board, an agent that has lived {minutes:.0f} minutes in "
            f"another such tank earns {gain} per second more than the same agent newborn, with the 95 % interval in "
            f"brackets, and beats a newborn of another pair with probability {chance}. Neither had a training phase; "
            f"both learn while they act. A fixed steering rule that is given the laws of motion earns "
            f"{estimate(np.mean, by_rule)}, whatever its experience.")


def rewards_table(newborns, veterans, by_rule, minutes):
    """The same rewards as a Markdown table."""
    rows = (("newborn", newborns), (f"veteran of {minutes:.0f} minutes", veterans),
            ("helmsman and captain by rule", by_rule))
    return table(["in its first minute on a board", "reward per second"],
                 [(name, estimate(np.mean, rewards)) for name, rewards in rows])


def describe_gain(gain):
    """Whether experience in the tank pays. gain: the lead of veterans over newborns, an `Estimate`."""
    return "Experience in the tank pays" if gain.low > 0 else "These runs do not show a gain from experience"


def describe_rule(by_rule, veterans):
    """The rule's score against the veterans', as the end of a sentence. by_rule, veterans: rewards, (runs,) each."""
    if by_rule.mean() > veterans.mean():
        return ("scores higher than both, but it is not autonomous: its knowledge was built in. This book "
                "therefore does not ask which controller scores highest, but what an agent can learn and desire by "
                "itself")
    return "scores no higher here, although it is given the laws of motion"


def describe_leads(leads, minute):
    """The lead of veterans over newborns, one line per length of life: leads {steps: `Estimate`}; minute in steps."""
    return "\n".join(f"{lessons / minute:6.2f} minutes lived: {lead} more per second"
                     for lessons, lead in leads.items())
