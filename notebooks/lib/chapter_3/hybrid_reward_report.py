"""Tables and sentences on the learners' scores in the game of fruits, in Markdown, for the page of chapter 3.

Learners are named as in `lib.chapter_3.hybrid_reward.KINDS`; ``played`` is {kind: `Played`} of all of them.
"""

import numpy as np

from lib.chapter_3.hybrid_reward import KINDS
from lib.shared.wording import by_interval, number, table
from neorl.evidence.statistics import difference, estimate, probability_of_improvement


def finals(game, played):
    """The states of each learner, those it has learned about, and its final reward, as a table."""
    return table(("Agent", "States", "Learned about", "Reward per 100 steps"),
                 [(kind.capitalize(), f"{game.states(kind):,}", f"{played[kind].known.mean():,.0f}",
                   estimate(np.mean, played[kind].final)) for kind in KINDS])


def lead_of_heads(played):
    """Whether heads are better than the single learner after the same steps, and latent heads better than heads."""
    one, heads, latent = (played[kind].final for kind in KINDS)
    lead = estimate(difference, latent, heads)
    learn = by_interval(lead, "learn more from the same steps than", "learn less from the same steps than",
                        "are indistinguishable from")
    return ("A run of heads is better than one of the single learner with probability "
            f"{probability_of_improvement(heads, one)}. Latent heads {learn} heads (difference {lead}).")


def catching_up(played):
    """Whether and when the single learner, which plays for longer, reaches the final score of heads."""
    one, heads = played["one learner"], played["heads"]
    level, course = heads.final.mean(), one.rewards.mean(axis=0)
    reached = one.edges[1:][course >= level]
    if len(reached):
        return (f"The single learner does catch up: after {reached[0]:,} steps its mean first reaches "
                f"{number(level, 1)}, the score of heads after {heads.edges[-1]:,} steps.")
    return (f"In {one.edges[-1]:,} steps the single learner does not reach the {number(level, 1)} that heads score "
            f"after {heads.edges[-1]:,}; it ends at {number(course[-1], 1)}.")


def price(played):
    """How often learners are finally caught, and whether that shows the cost of separation."""
    one, heads, latent = (100 * played[kind].share("caught") for kind in KINDS)
    cost = ("The separation thus has a price: the head of a fruit ignores the ghost, the head of the ghost ignores "
            "the fruits, and the sum of two best plans is not the best plan." if one < min(heads, latent) else
            "The price of the separation, plans that ignore each other, does not show in this number.")
    return (f"At the end of these longest runs the single learner is caught in {one:.0f} % of its games, heads in "
            f"{heads:.0f} % and latent heads in {latent:.0f} %. {cost}")


def best_discounts(discounts, swept):
    """The discounts at which heads do best, how often they run out of time, and whether they are always ahead.

    discounts: a list with 0.5 and 0.9 among others. swept: {kind: [`Played` for each of discounts]}.
    """
    steps = swept["heads"][0].edges[-1]
    final = {kind: [played.final.mean() for played in swept[kind]] for kind in KINDS}
    best = {kind: discounts[int(np.argmax(means))] for kind, means in final.items()}
    stuck = {kind: [f"{100 * swept[kind][discounts.index(each)].share('out of time'):.1f} %" for each in (0.5, 0.9)]
             for kind in KINDS}
    order = ("At every discount, though, heads of either kind lead the single learner with the same "
             "experience." if min(final["heads"] + final["latent heads"]) > max(final["one learner"]) else
             "At the worst discount heads no longer lead the single learner with the same experience.")
    return (f"After {steps:,} steps heads do best at γ = {best['heads']} and latent heads at γ = "
            f"{best['latent heads']}, of those tried. At γ = 0.5, {stuck['heads'][0]} of the games of heads run out of "
            f"time; at γ = 0.9 it is {stuck['heads'][1]} (latent heads: {' and '.join(stuck['latent heads'])}). "
            f"Random actions sooner or later free an agent from an attractor, so it may cost time without ending a "
            f"game. {order}")
