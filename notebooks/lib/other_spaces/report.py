"""Sentences and tables of the page "Is it general?"."""

import numpy as np

from lib.other_spaces import hill, minds, scores
from lib.shared.wording import listed, number, table
from neorl.evidence import claims
from neorl.evidence.statistics import difference, estimate, probability_of_improvement
from neorl.evidence.verdict import EARLY, FINAL

# Settings tried by hand and by random draws before those of the page were fixed, on seeds that the page does not use.
SEARCHED = {"arm": 165, "vessel": 120, "water maze": 45, "birds": 14, "mountain car": 118,
            "Q-learning in the water maze": 16, "Q-learning of the mountain car": 3}


def judge(reached, sailed, swum, asked, driven):
    """Judge the claims on Kaelbling's properties: a list of `Claim`."""
    found = scores.of_each_world(reached, sailed, swum, asked, driven)
    new_place = [scores.seconds_at_a_new_place(swum, name) for name in ("neoRL", "Q-learning", "random")]
    apart, whole, chance = (asked[name].mean(axis=1) for name in ("a map of each", "one map", "random"))
    return [claims.judge_efficiency(*new_place), claims.judge_generality(found),
            claims.judge_composition(apart, whole, chance),
            claims.judge_extension(sailed["near joins"], sailed["far radar"], sailed["random"])]


def summary(verdicts, found):
    """The result of the page in a paragraph. found: from `scores.of_each_world`."""
    better = [world for world, each in found.items() if estimate(difference, *each).low > 0]
    properties = {}
    for claim in verdicts:
        properties.setdefault(claim.verdict, []).append(claim.statement.text.partition(":")[0].lower())
    text = "; ".join(f"{verdict}: {listed(names)}" for verdict, names in properties.items())
    return (f"With one learning rule and one policy the agent does better than chance in {len(better)} of "
            f"{len(found)} worlds: {listed(better)}. Of the properties that Kaelbling (2020) asks of a "
            f"learner, {text}.")


def cells():
    """The kinds and numbers of each agent's cells, in a table."""
    agents = {"arm of two links": minds.reacher(2), "arm of three links": minds.reacher(3),
              "vessel, radar": minds.pilot(), "vessel, far radar": minds.far_pilot(),
              "vessel, compass": minds.compass_pilot(), "water maze": minds.swimmer(),
              "birds, one map": minds.thinker(False), "birds, a map of each": minds.thinker(True),
              "mountain car": minds.driver()}
    return table(["Agent", "Cells", "Number"], [
        [name, listed(dict.fromkeys(f"{node.modality.name}s" for node in agent.nodes)),
         " + ".join(str(nres_map.cells) for nres_map in agent.maps)] for name, agent in agents.items()])


def luck(shares):
    """How often a random driver reaches the flag. shares: from `hill.luck`."""
    text = "; ".join(f"with actions held for {held} step{'s' * (held > 1)} a random driver reaches the flag in "
                     f"{100 * share:.0f}\u00a0% of {hill.EPISODES} episodes" for held, share in shares.items())
    return f"{text.capitalize()}."


def reaching(reached, feared):
    """Targets and obstacles that the arms meet, and the cost of avoiding obstacles. feared: from `lives.fear`."""
    said = [f"The arm of {links} links meets {_met(reached[links, 'agent'], 0)} targets and "
            f"{_met(reached[links, 'agent'], 1)} obstacles per second in the last fifth of its runs; at random it "
            f"meets {_met(reached[links, 'random'], 0)} and {_met(reached[links, 'random'], 1)}." for links in (2, 3)]
    rows = [[number(valence, 1), _met(result, 0), _met(result, 1),
             number(_rate(result, 1) / _rate(result, 0)) if _rate(result, 0) else "–",
             estimate(np.mean, result.rate(*FINAL))] for valence, result in feared.items()]
    header = ["Valence of obstacles", "Targets per second", "Obstacles per second", "Obstacles per target",
              "Reward per second"]
    return " ".join(said) + "\n\n" + table(header, rows)


def sailing(sailed):
    """Waypoints, collisions and rewards of pilots, in a table. sailed: from `lives.sail`."""
    return table(["Pilot", "Waypoints per minute", "Collisions per minute", "Reward per minute, first tenth",
                  "Reward per minute, last fifth"], [
        [name, *(estimate(np.mean, 60 * result.hit_rate(*FINAL)[:, kind]) for kind in range(2)),
         estimate(np.mean, 60 * result.rate(*EARLY)), estimate(np.mean, 60 * result.rate(*FINAL))]
        for name, result in sailed.items()])


def swimming(swum):
    """Seconds to the platform on later days, by trial of the day. swum: from `pool.swim`."""
    rows = [[f"{name}, platform {platform}", *(estimate(np.mean, seconds[:, scores.LATER, trial].mean(axis=1))
                                               for trial in range(seconds.shape[2]))]
            for platform, by_name in swum.items() for name, seconds in by_name.items()]
    return table([f"Seconds to the platform, from day {scores.LATER.start + 1} on",
                  *(f"Trial {trial}" for trial in range(1, len(rows[0])))], rows)


def savings(swum):
    """Seconds saved from the first trial of a day to the second, on the first days and on later ones."""
    seconds = swum["moved"]["neoRL"]
    early, late = (estimate(difference, seconds[:, days, 0].mean(axis=1), seconds[:, days, 1].mean(axis=1))
                   for days in (slice(0, 2), scores.LATER))
    table_too = estimate(difference, *(swum["moved"]["Q-learning"][:, scores.LATER, trial].mean(axis=1)
                                       for trial in range(2)))
    return (f"From the first trial of a day to the second, neoRL saves {early} seconds on the first two days and "
            f"{late} on the second half of the days; on these, Q-learning saves {table_too}.")


def thinking(asked, named):
    """Steps of questions as multiples of the fewest, for birds with and without a name. named: how many have one."""
    return table(["Steps, as a multiple of the fewest", "Birds with a name", "Birds without a name"], [
        [name, estimate(np.mean, each[:, :named].mean(axis=1)), estimate(np.mean, each[:, named:].mean(axis=1))]
        for name, each in asked.items()])


def driving(driven):
    """Steps per episode by quarter of the decisions, and the probability that neoRL beats chance, in a table."""
    quarters = {name: each.reshape(len(each), 4, -1).mean(axis=2).T for name, each in driven.items()}
    rows = [[name, *(estimate(np.mean, each) for each in of_driver)] for name, of_driver in quarters.items()]
    rows.append(["probability that a run of neoRL beats a random driver's", *(
        probability_of_improvement(-agent, -chance) for agent, chance in zip(quarters["neoRL"], quarters["random"]))])
    return table(["Steps per episode", "First quarter", "Second", "Third", "Last"], rows)


def searched():
    """How many settings were tried before those of the page were fixed, in a sentence."""
    return "Settings tried: " + ", ".join(f"{name} {count}" for name, count in SEARCHED.items()) + "."


def _rate(result, kind):
    return float(result.hit_rate(*FINAL)[:, kind].mean())


def _met(result, kind):
    return estimate(np.mean, result.hit_rate(*FINAL)[:, kind])
