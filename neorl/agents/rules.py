"""How an agent learns and how it chooses actions: the rules that all its nodes share, as data.

The defaults are plain: an agent bootstraps, credits its last action, remembers no earlier cells, and explores.
Everything the thesis leaves open is a field. `CALIBRATED` and `TO_THE_LETTER` are the rules of learning of two readings
of the thesis (see `companion.thesis.reading`), and `GREEDY` is the policy of both.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated

from neorl.common import checks
from neorl.common.checks import NotNegative, OneOf, Positive, Share, Within
from neorl.core.choices import Credit, UpdateOn
from neorl.core.policy import greedy
from neorl.kernels.kernel import check_kernel

CREDITS = tuple(name for name in Credit.__members__ if name != "own")
WHEN_INDIFFERENT = ("random", "no-op")
MOST_AHEAD = 100  # steps of coasting


@dataclass(frozen=True)
class Learning(checks.Final):
    """How the Horde learns (thesis section 4.1.3).

    learning_rate: α in [0, 1]. discount: γ in [0, 1] for each update. It has no effect without bootstrapping or memory.
    update_on: when values are updated. "cell": at a change of cell, inference inversion (eq. 4.7, 4.8); "step": at
        every step, temporal difference (eq. 4.6), to which no field below except `terminal` applies: see
        `AT_EVERY_STEP`.
    credit: ψ of an event in the cell just left. "share": the share of the steps there on which it occurred;
        "happened": 1 if it occurred at all; "count": the number of steps on which it occurred, α ψ being 1 at most;
        "activity": how active it was at the end, see `activity`; "last": 1 for the last event only. Or a
        `neorl.kernel` ``(count, steps, last, activity) → ψ`` of the number of steps in the cell on which it occurred,
        the number of all steps there, whether it was the last, and its activity. A ψ below 0 counts as 0, and α ψ is 1
        at most.
    activity: seconds > 0, the time constant of the leaky integrator behind the credit "activity". The activity of an
        event that has long occurred on every step is 1; below 0.01 it counts as 0 (section 4.4).
    absent_decay: −ψ(0) in [0, 1]: the values of events that did not occur decrease at the rate α · absence.
    absent_form: "decay" towards zero, or "away" from the target, as in eq. 4.8 with a negative rate; values are then
        kept between 0 and the highest possible value.
    terminal: reaching a goal is worth 1; otherwise 1 plus the discounted value of reaching it again.
    memory: a leaky integrator over all cells left, ≥ 0: the mean number of earlier cells remembered. All of them learn
        to reach the cell just entered, at rates that fade by memory / (1 + memory) with each change of cell; a goal
        reached k changes later is worth γ^k. 0 disables it: only the cell just left learns. Of the places that the self
        has passed (see `Node`), the latest 500 are remembered at most.
    bootstrap: the cell just left also learns about all other goals from the cell entered (the γ max Q of eq. 4.8).

    Raises ValueError for anything else.
    """

    learning_rate: Share = 0.1
    discount: Share = 0.9
    update_on: Annotated[str, OneOf(tuple(UpdateOn.__members__))] = "cell"
    credit: str | Callable = "last"
    activity: NotNegative = 0.5
    absent_decay: Share = 0.0
    absent_form: Annotated[str, OneOf(("decay", "away"))] = "decay"
    terminal: bool = True
    memory: NotNegative = 0.0
    bootstrap: bool = True

    def __post_init__(self):
        checks.check_fields(self)
        checks.assign(self, credit=(check_kernel("credit", self.credit) if callable(self.credit) else
                                    checks.one_of("credit", self.credit, CREDITS)))
        if self.update_on == "step":
            for name, value in AT_EVERY_STEP.items():
                if getattr(self, name) not in (value, getattr(Learning, name)):
                    raise checks.error(name, f"{value!r} with update_on 'step'", getattr(self, name))
                checks.assign(self, **{name: value})


# The fields that temporal difference fixes, with the values that then replace the defaults.
AT_EVERY_STEP = {"credit": "share", "absent_decay": 0.0, "memory": 0.0, "bootstrap": True}


@dataclass(frozen=True)
class Contacts(checks.Final):
    """How nodes with contacts as their only goals learn, see `neorl.core.contacts`: beyond the thesis.

    The defaults are the best values found by `notebooks/companion/beyond_agents/search.py`, for values of actions.

    horizon: seconds > 0, the time constant of discounting.
    learning_rate: α in [0, 1], the minimum; after n visits the rate is (n + 2)^(−3/4) or this, whichever is greater.
    familiarity: ≥ 0. After n visits of an action, a finer map's own value has the weight n / (n + familiarity).
    first_value: in [0, 1], the initial approach value of untried actions: optimism in place of ε.
    trace_rate: in [0, 1], the rate at which actions on the way to a contact learn of it; 0 for no trace.
    caution: ≥ 0, the weight of harm against the best approach.
    fear: the value used for harm: "avoidance", the value of a contact to an agent that would flee, or "approach", as
        in the superposition of the thesis (eq. 4.4).
    rivals: in [0, 1], the weight of the approaches of all things of positive valence but the one of highest value. With
        0 the best alone counts, with 1 all add up.
    efference: ≥ 0, in sizes of the world per second: what a push of length 1 adds at once to the agent's velocity. The
        agent is supposed to know it, by an efference copy. Its values are then those of after-states, which are the
        positions of things together with its own velocity after the push that it is about to give, and all nodes with
        contacts as goals must have an axis of velocity. 0 stands for an agent without an efference copy, whose values
        are those of actions.
    lookahead: in 0 … 100, only with an efference copy. The approach of an action is then the mean of that of its
        after-state and of those that the agent would be in after one more push, 1 … `lookahead` steps later, if it
        coasted until then and things stood still. The agent is supposed to know what its velocity does to its
        position, by path integration.

    Raises ValueError for anything else.
    """

    horizon: Positive = 0.389
    learning_rate: Share = 0.0262
    familiarity: NotNegative = 6.15
    first_value: Share = 0.31
    trace_rate: Share = 0.215
    caution: NotNegative = 0.309
    fear: Annotated[str, OneOf(("avoidance", "approach"))] = "avoidance"
    rivals: Share = 0.0
    efference: NotNegative = 0.0
    lookahead: Annotated[int, Within(0, MOST_AHEAD)] = 0

    def __post_init__(self):
        checks.check_fields(self)
        if self.lookahead > 0 and self.efference == 0:
            raise checks.error("lookahead", "0 without an efference copy (efference is 0)", self.lookahead)


@dataclass(frozen=True)
class Policy(checks.Final):
    """How the agent chooses: the action of highest value, ties broken at random (paper A, The Control Problem).

    exploration: ε in [0, 1], the probability that the action of a step is drawn at random instead, whatever `choose`
        is: give 0 beside a policy that explores by itself, as in ``Policy(0.0, choose=softmax(0.2))``.
    when_indifferent: what to do while every action has a value of exactly 0: "random", that is to choose as usual, or
        "no-op", to be idle.
    choose: a `neorl.kernel` (value, stream) → action: `neorl.custom.greedy`, `neorl.custom.softmax` of a temperature,
        or the user's own; see `neorl.core.policy`. A number outside the range of actions counts as the nearest action.

    Raises ValueError for anything else.
    """

    exploration: Share = 0.1
    when_indifferent: Annotated[str, OneOf(WHEN_INDIFFERENT)] = "random"
    choose: Callable = greedy

    def __post_init__(self):
        checks.check_fields(self)
        check_kernel("choose", self.choose)


# Of the confirmed readings within the text, the one for which most claims agree (`notebooks/companion/study`).
CALIBRATED = Learning(
    learning_rate=0.01242, discount=0.9931, credit="share", activity=0.4982, absent_decay=0.07674,
    absent_form="decay", terminal=False, memory=35.28, bootstrap=False)
# What the text prints, and the simplest or the middle of the prior where it leaves more, see
# `notebooks/companion/thesis/priors.py`.
TO_THE_LETTER = Learning(
    learning_rate=0.012247448713915891, discount=0.9805065484119142, credit="activity", activity=0.5,
    absent_decay=0.03162277660168379, absent_form="away", terminal=False, memory=0.0, bootstrap=True)
GREEDY = Policy(exploration=0.0)
