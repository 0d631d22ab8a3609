"""Sentences on the rewards of newborns, veterans and a rule in the tank.

A newborn and a veteran are those of `neorl.chapters.chapter_1.before_and_after`, the rule is that of
`neorl.chapters.chapter_1.steering`.
"""


def describe_gain(gain):
    """Whether experience in the tank pays. gain: the lead of veterans over newborns, an `Estimate`."""
    return "Experience in the tank pays" if gain.low > 0 else "These runs do not show a gain by experience"


def describe_rule(by_rule, veterans):
    """The rule's score against the veterans', as the end of a sentence. by_rule, veterans: rewards, (runs,) each."""
    if by_rule.mean() > veterans.mean():
        return ("scores higher than both, and it is not autonomous: its knowledge was designed in. This book "
                "therefore does not ask which controller scores highest, but what an agent can learn and desire by "
                "itself")
    return "scores no higher here, although it is given the laws of motion"


def describe_leads(leads, minute):
    """The lead of veterans over newborns, one line per length of life: leads {steps: `Estimate`}; minute in steps."""
    return "\n".join(f"{lessons / minute:6.2f} minutes lived: {lead} ahead" for lessons, lead in leads.items())
