"""The multiverse of readings: all choices that the thesis leaves open, varied jointly, and their effect on the claims.

1. A *reading* fixes every open choice (`neorl.evidence.reading`). Plausible values are stated beforehand, as an
   independent prior for each choice (`neorl.evidence.priors`). There are two multiverses: within the text of the
   thesis, and beyond it.
2. A design is a scrambled Sobol sequence through the priors, so that any power of two of its readings fills the space.
3. The conditions of all three papers are run under every reading, and judged by the rules of `neorl.evidence.claims`:
   a claim *holds* if its verdict is "reproduced", is *undecided* if its intervals leave room for it, and *fails*
   otherwise, also if agents have learned nothing to test it by.
"""

from collections.abc import Mapping
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import scipy

from neorl import checks
from neorl.evidence.priors import TO_THE_LETTER, WITHIN, Choice
from neorl.evidence.reading import Reading
from neorl.evidence.statistics import Estimate, difference, estimate
from neorl.extras import require

PARTS = 5  # into which a prior without levels is cut; the middle one contains the reading to the letter


def design(points: int, seed: int = 0, choices: Mapping[str, Choice] = WITHIN) -> list[Reading]:
    """Plausible readings, spread evenly through the priors: a list of `Reading`.

    points: their number, a power of two; a design is the first part of every larger one. seed: integer ≥ 0, of the
    sequence. choices: the fields that vary, {field of `Reading`: `Choice`}: `WITHIN`, `BEYOND`, or any other. The
    other fields are those of the reading to the letter.
    Raises ValueError for anything else.
    """
    checks.integer("points", points, at_least=2)
    if points & (points - 1):
        raise ValueError(f"points is {points}, allowed are powers of two")
    seed = checks.integer("seed", seed, at_least=0)
    shares = scipy.stats.qmc.Sobol(len(choices), rng=np.random.default_rng(seed)).random(points)
    return [replace(TO_THE_LETTER, **{name: choice.at(share) for (name, choice), share in zip(choices.items(), row)})
            for row in shares]


def outcome(claim):
    """The outcome of a claim: "holds", "undecided" or "fails"."""
    return "holds" if claim.outcome == "reproduced" else "undecided" if claim.undecided else "fails"


def shares(judged):
    """How often each claim holds: {name: {"holds", "undecided", "untestable", "readings"}}, counts of readings.

    judged: {name: `Claim`} for each reading.
    """
    found = {}
    for name in judged[0]:
        outcomes = [outcome(claims[name]) for claims in judged]
        found[name] = {"holds": outcomes.count("holds"), "undecided": outcomes.count("undecided"),
                       "untestable": sum(claims[name].outcome == "not testable" for claims in judged),
                       "readings": len(judged)}
    return found


def held(claims):
    """The names of the claims that hold, of {name: `Claim`}."""
    return [name for name, claim in claims.items() if outcome(claim) == "holds"]


class Support(NamedTuple):
    """How many claims hold at one level of a choice, and the lead over the level of the reading to the letter."""

    choice: str
    level: str
    value: object
    is_to_the_letter: bool
    held: float
    lead: Estimate


def support(readings, judged, choices=WITHIN):
    """A `Support` for each level of each choice, the mean over all readings that have it.

    A choice without levels is cut into fifths of its prior, each with its median as its value. A level that no reading
    has is left out.
    """
    counts = np.array([len(held(claims)) for claims in judged])
    found = []
    for name, choice in choices.items():
        if isinstance(choice.prior, tuple):
            values = choice.prior
            levels = list(map(choice.words, values))
            letter, *at = [values.index(getattr(reading, name)) for reading in [TO_THE_LETTER, *readings]]
        else:
            values = [choice.at((part + 0.5) / PARTS) for part in range(PARTS)]
            ends = [choice.words(choice.prior.ppf(part / PARTS)) for part in range(PARTS + 1)]
            levels = [" … ".join(pair) for pair in zip(ends, ends[1:])]
            letter, *at = [min(int(PARTS * choice.place(getattr(reading, name))), PARTS - 1)
                           for reading in [TO_THE_LETTER, *readings]]
        at = np.array(at)
        for level, (value, words) in enumerate(zip(values, levels)):
            if np.any(at == level) and np.any(at == letter):
                lead = estimate(difference, counts[at == level], counts[at == letter])
                found.append(Support(name, words, value, level == letter, counts[at == level].mean(), lead))
    return found


def importance(readings, judged, name, choices=WITHIN, seed=0):
    """The importance of each choice for the number of a claim: ({name of the choice: importance}, R²).

    A random forest predicts the rank of the number among all readings. The importance of a choice is the loss of R² on
    held-out readings when its values are shuffled (Breiman 2001), the mean over four folds of the readings (fewer if
    there are not two in each); the R² returned is that before shuffling.
    """
    chosen = [key for key, choice in choices.items() if name[0] in choice.papers]
    places = np.array([[choices[key].place(getattr(reading, key)) for key in chosen] for reading in readings])
    ranks = scipy.stats.rankdata([claims[name].here.value for claims in judged]) / len(judged)
    lost, explained = [], []
    ensemble, inspection, selection = (require(f"sklearn.{each}", extra="book")
                                       for each in ("ensemble", "inspection", "model_selection"))
    for learned, unseen in selection.KFold(min(4, len(readings) // 2), shuffle=True, random_state=seed).split(places):
        forest = ensemble.RandomForestRegressor(50, random_state=seed).fit(places[learned], ranks[learned])
        found = inspection.permutation_importance(forest, places[unseen], ranks[unseen], n_repeats=3, random_state=seed)
        lost.append(found.importances_mean)
        explained.append(forest.score(places[unseen], ranks[unseen]))
    return dict(zip(chosen, np.mean(lost, axis=0))), float(np.mean(explained))
