"""Tables and sentences on decision processes, in Markdown, for the page of chapter 3."""

import numpy as np

from lib.chapter_3.decision import sweeps_until_stable, time_to
from lib.chapter_3.growth import growth_factor
from lib.shared.wording import table
from neorl.evidence.statistics import estimate


def returns_table(rewards, returns):
    """The returns of each time step under several discounts: rewards (steps,), returns {γ: (steps,)}."""
    rows = [("Rₜ₊₁", *(f"{each:.0f}" for each in rewards))]
    rows += [(f"Gₜ, γ = {discount}", *(f"{each:.2f}" for each in values)) for discount, values in returns.items()]
    return table(("t", *range(len(rewards))), rows)


def final_errors(errors):
    """The error of each learning rate at the end, in the order of their names, which is that of their floors.

    errors: {name: (visits (checkpoints,), errors (runs, checkpoints))}.
    """
    return table(("Learning rate", "Largest error at the end"),
                 [(name, estimate(np.mean, errors[name][1][:, -1])) for name in sorted(errors)])


def model_against_values(made, checkpoints, task):
    """The benefit and the cost of learning a model and planning with it.

    made: {"Q-learning", "model": share of the best return (runs, checkpoints)}, both from the same steps. checkpoints:
    numbers of steps. task: the `Process`.
    """
    values, model = (time_to(made[name] >= 0.95, checkpoints) for name in ("Q-learning", "model"))
    ratio = estimate(np.mean, values / model)
    ahead = ("The model thus learns from fewer steps." if ratio.low > 1 else
             "The interval leaves open which one needs fewer.")
    return (f"To reach 95 % of the best return, Q-learning takes {values.mean():,.0f} steps and the model "
            f"{model.mean():,.0f}; the ratio, learner by learner, is {ratio}. {ahead} The price is computation: the "
            f"hundred sweeps of one plan take {100 * task.states**2 * task.actions:,} multiplications, where a "
            "step of Q-learning takes one.")


def cost_of_a_dimension(covering, learning):
    """The factors by which one more dimension prolongs learning.

    covering, learning: {"2 cells", …: (dimensions (points,), steps (runs, points))}, until everything has been tried
    and until the values are right, in spaces of that many cells per axis.
    """
    factors = {int(name.split()[0]): [growth_factor(*covering[name]), growth_factor(*learning[name])]
               for name in covering}
    found = table(("Cells per axis", "Steps to try everything grow by", "Steps to learn grow by"),
                  [(cells, *(f"× {factor}" for factor in both)) for cells, both in factors.items()])
    above = all(factor.low > cells for cells, both in factors.items() for factor in both)
    why = "Each factor is larger than that, since an axis also brings two actions. " if above else ""
    powers = [np.log(factor.value) / np.log(cells) for cells, both in factors.items() for factor in both]
    return (f"The cost of one more dimension, from the second on, in a fit of the logarithm:\n\n{found}\n\nThe number "
            f"of states alone grows by factors of 2, 3 and 4. {why}More precisely than in the thesis, training time "
            "grows exponentially with the number of *axes*: in these fits, as the number of states to the power of "
            f"{min(powers):.1f} to {max(powers):.1f}.")


def sweeps_in_all(task, discount, evaluations):
    """The number of sweeps of policy iteration in all, for each number of sweeps per evaluation."""
    found = (sweeps_until_stable(*task.expected(), discount, sweeps) for sweeps in evaluations)
    return "; ".join(f"{total} sweeps in all with {sweeps} per iteration"
                     for total, sweeps in zip(found, evaluations)) + "."
