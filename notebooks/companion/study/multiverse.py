"""The multiverse of readings: all choices that the thesis leaves open, varied jointly, and their effect on the claims.

1. A *reading* fixes every open choice (`companion.thesis.reading`); each choice has a prior
   (`companion.shared.priors`).
2. A design is a scrambled Sobol sequence through the priors: any power of two of its readings fills the space.
3. The `OUTCOMES` of a claim under readings are its verdicts, whatever the number of runs.
4. The importance of choices for a claim is estimated from `ENOUGH` readings or more.
5. The book's record of shares is about its own design: `FEWEST` readings or more, spread evenly within the text, each
   in the papers' own conditions for `STEPS` steps or more. Other runs are shown on the page and not recorded.
"""

from typing import NamedTuple

import numpy as np
import scipy

from companion.shared import judging
from companion.shared.priors import WITHIN
from neorl import checks
from companion.thesis.reading import TO_THE_LETTER, conditions, judge
from companion.thesis.statements import STATEMENTS
from neorl.statistics import Estimate, difference, estimate
from companion.thesis.verdict import VERDICTS
from neorl.extras import require

PARTS = 5  # into which a prior without levels is cut; the middle one contains the reading to the letter
ENOUGH = 32  # readings
FEWEST, STEPS = 16, 30_000  # readings of the book's design, and steps of their runs at 50 steps per second
CHEAP = ("layers", "modal", "networks", "revaluing", "resolutions")  # groups of conditions
EXPENSIVE = ("single", "pace")  # for A1 to A5, and for B4
OUTCOMES = VERDICTS[:5]  # of claims about agents
PREDICTED = 0.1  # the least R² at which choices count as predicting the number of a claim


def design(points, seed=0, choices=WITHIN):
    """Plausible readings, spread evenly through the priors: a list of `Reading`.

    points: their number, a power of two, or ValueError is raised; a design is the first part of every larger one.
    choices: what varies, {name: `Choice`}; the rest is as in the reading to the letter.
    """
    checks.integer("points", points, at_least=2)
    if points & (points - 1):
        raise checks.error("points", "a power of two", points)
    shares = scipy.stats.qmc.Sobol(len(choices), rng=np.random.default_rng(seed)).random(points)
    return [TO_THE_LETTER.varied(**{name: choice.at(share) for (name, choice), share in zip(choices.items(), row)})
            for row in shares]


class Judged(NamedTuple):
    """A reading's claims, {name: `Claim`}, and the conditions of which they were judged, {key: `Condition`}."""

    claims: dict
    ran: dict


def judged(results):
    """Judge the claims for which some results of a reading suffice, {key: `Result`}: `Judged`."""
    return Judged(judge(results), {key: result.condition for key, result in results.items()})


def of_book(readings, cheap, expensive):
    """Whether what was run is of the book's own design.

    cheap, expensive: lists of `Judged`, of all readings in the groups `CHEAP`, and of the first ones in `EXPENSIVE`.
    """
    seed = next(iter(cheap[0].ran.values())).seed
    return (len(readings) >= FEWEST and readings == design(len(readings), seed) and len(cheap) == len(readings)
            and all(_as_long(each.ran, conditions(reading, STEPS, 1, groups=groups))
                    for groups, found in ((CHEAP, cheap), (EXPENSIVE, expensive))
                    for reading, each in zip(readings, found)))


def _as_long(ran, wanted):
    return judging.same(ran, wanted) and all(ran[key].steps >= wanted[key].steps for key in wanted)


def minutes(found, key):
    """The simulated minutes of a condition under all readings, as text. found: a list of `Judged`."""
    lasting = [each.ran[key].steps / each.ran[key].world.fps / 60 for each in found]
    return " to ".join(dict.fromkeys(f"{end:.3g}" for end in (min(lasting), max(lasting))))


def by_claim(*sweeps):
    """Claims by name, {name: [`Claim`, …]}, from sweeps, lists of {name: `Claim`}."""
    found = {name: [claims[name] for claims in judged] for judged in sweeps for name in judged[0]}
    return {name: found[name] for name in STATEMENTS if name in found}


def shares(claims):
    """Counts of readings for each claim: {name: {each of `OUTCOMES`, "readings"}}."""
    return {name: {kind: sum(claim.outcome == kind for claim in found) for kind in OUTCOMES} | {"readings": len(found)}
            for name, found in claims.items()}


def reproduced(claims):
    """The names of the claims that are reproduced, of {name: `Claim`}."""
    return [name for name, claim in claims.items() if claim.outcome == "reproduced"]


class Support(NamedTuple):
    """Claims reproduced at one level of a choice, on average, and their lead over the level to the letter."""

    choice: str
    level: str
    is_to_the_letter: bool
    reproduced: float
    lead: Estimate


def support(readings, judged):
    """A `Support` for each level of each choice, the mean over all readings that have it.

    A choice without levels is cut into fifths of its prior. A level that no reading has is left out.
    """
    counts = np.array([len(reproduced(claims)) for claims in judged])
    found = []
    for name in WITHIN:
        levels, _, (letter, *at) = binned(name, [TO_THE_LETTER, *readings], PARTS)
        at = np.array(at)
        for level, words in enumerate(levels):
            if np.any(at == level) and np.any(at == letter):
                lead = estimate(difference, counts[at == level], counts[at == letter])
                found.append(Support(name, words, level == letter, counts[at == level].mean(), lead))
    return found


def binned(name, readings, parts):
    """A choice in levels: (levels, shares of the prior, level of each reading)."""
    choice = WITHIN[name]
    values = [reading.choices[name] for reading in readings]
    if isinstance(choice.prior, tuple):
        levels = list(dict.fromkeys(choice.prior))
        prior = np.array([choice.prior.count(level) for level in levels]) / len(choice.prior)
        return tuple(map(choice.words, levels)), prior, np.array([levels.index(value) for value in values])
    ends = [choice.words(choice.at(min(i / parts, 1 - 1e-9))) for i in range(parts + 1)]
    levels = tuple(" … ".join(dict.fromkeys(pair)) for pair in zip(ends, ends[1:]))
    places = [min(int(choice.place(value) * parts), parts - 1) for value in values]
    return levels, np.full(parts, 1 / parts), np.array(places)


def importances(readings, claims):
    """The importance of each choice for claims: ({claim: {choice: importance}}, {claim: R²})."""
    found = {name: importance(readings[:len(each)], each) for name, each in claims.items() if len(each) >= ENOUGH}
    return {name: shares for name, (shares, _) in found.items()}, {name: share for name, (_, share) in found.items()}


def importance(readings, claims):
    """The importance of each choice for the number of a claim: ({name of the choice: importance}, R²).

    A random forest predicts the rank of the number among all readings. The importance of a choice is the loss of R² on
    held-out readings when its values are shuffled (Breiman 2001), the mean over four folds of the readings (fewer if
    there are not two in each); the R² returned is that before shuffling.
    """
    chosen = {key: choice for key, choice in WITHIN.items() if claims[0].name[0] in choice.papers}
    places = np.array([[choice.place(choices[key]) for key, choice in chosen.items()]
                       for choices in (reading.choices for reading in readings)])
    ranks = scipy.stats.rankdata([claim.here.value for claim in claims]) / len(claims)
    lost, explained = [], []
    ensemble, inspection, selection = (require(f"sklearn.{each}", extra="book")
                                       for each in ("ensemble", "inspection", "model_selection"))
    for learned, unseen in selection.KFold(min(4, len(readings) // 2), shuffle=True, random_state=0).split(places):
        forest = ensemble.RandomForestRegressor(50, random_state=0).fit(places[learned], ranks[learned])
        found = inspection.permutation_importance(forest, places[unseen], ranks[unseen], n_repeats=3, random_state=0)
        lost.append(found.importances_mean)
        explained.append(forest.score(places[unseen], ranks[unseen]))
    return dict(zip(chosen, np.mean(lost, axis=0))), float(np.mean(explained))
