"""What newborns, veterans and a rule earn in the tank, put into words.

A newborn and a veteran are those of `neorl.chapters.chapter_1.before_and_after`, the rule is that of
`neorl.chapters.chapter_1.steering`.
"""


def describe_gain(gain):
    """Whether a life in the tank pays. gain: what veterans earn more than newborns, an `Estimate`."""
    return "A life in the tank pays" if gain.low > 0 else "Whether a life in the tank pays, these runs do not tell"


def describe_rule(by_rule, veterans):
    """What the rule does beside veterans, as the end of a sentence. by_rule, veterans: their rewards, (runs,) each."""
    if by_rule.mean() > veterans.mean():
        return ("does better than both, and it is not autonomous: whatever it knows, somebody else has found out. That "
                "is why this book does not ask who scores most. It asks what an agent can come to know and want by "
                "itself, and what for")
    return "does no better here, although somebody has told it the laws of motion"


def describe_leads(leads, minute):
    """What veterans earn more than newborns, a line for each life: leads {steps lived: `Estimate`}; minute in steps."""
    return "\n".join(f"{lessons / minute:6.2f} minutes lived: {lead} ahead" for lessons, lead in leads.items())
