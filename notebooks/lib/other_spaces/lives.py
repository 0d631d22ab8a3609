"""Runs of the arm and the vessel: the page's agents, the same agents acting at random, and some variants."""

import numpy as np

from lib.other_spaces import minds
from neorl import Arm, Run, Vessel
from neorl.core.kernel import mapped
from neorl.experiments.simulation import simulate_once

ARMS = {2: Arm((0.5, 0.5), radius=0.15), 3: Arm((0.4, 0.3, 0.3), radius=0.15)}  # by the number of links
WATERS = Vessel()
VALENCES = (0.0, -0.1, -0.3, -1.0)  # of obstacles, in `fear`


def reach(steps, runs, seed):
    """`Result`s of both arms: {(links, "agent" or "random"): `Result`}."""
    return {(links, name): simulate_once(agent, world, steps=steps, runs=runs, seed=seed, progress=False)
            for links, world in ARMS.items()
            for name, agent in (("agent", minds.reacher(links)), ("random", minds.aimless(minds.reacher(links))))}


def curve(result, kind=None, points=20):
    """Reward per second over stretches of the runs of a `Result`: (minutes (points,), float64 (runs, points)).

    kind: the number of a kind of things; if given, the rate is that of meeting them.
    """
    shares = np.linspace(0, 1, points + 1)
    rates = [result.rate(*each) if kind is None else result.hit_rate(*each)[:, kind]
             for each in zip(shares[:-1], shares[1:])]
    return shares[1:] * result.seconds / 60, np.stack(rates, axis=1)


def fear(steps, runs, seed):
    """`Result`s of the arm of two links with obstacles of several valences: {valence: `Result`}."""
    return {valence: simulate_once(minds.reacher(2, valence), ARMS[2], steps=steps, runs=runs, seed=seed,
                                   progress=False)
            for valence in VALENCES}


def sail(steps, runs, seed):
    """`Result`s of pilots: {"radar", "far radar", "near joins", "compass" or "random": `Result`}.

    With "near joins" the near map of the radar is added to the far one at half-time.
    """
    far, both = minds.far_pilot(), minds.pilot()
    changing = {"near joins": [(steps // 2, both)]}
    agents = {"radar": both, "far radar": far, "near joins": far, "compass": minds.compass_pilot(),
              "random": minds.aimless(both)}
    return {name: simulate_once(agent, WATERS, steps=steps, runs=runs, seed=seed, changes=changing.get(name, ()),
                                progress=False)
            for name, agent in agents.items()}


def watch(agent, world, experience, steps, seed):
    """Record `steps` steps of a run that has had `experience` steps before.

    Returns a list of (a copy of the state after the step; whether a thing of the first kind was met in the step). In
    that state a new thing has replaced the one that was met.
    """
    run = Run(agent, world, seed)
    run.advance(experience)
    seen = []
    for _ in range(steps):
        run.advance(1)
        scene = run.world_state.scene
        seen.append((mapped(np.copy, run.world_state), bool((scene.met == 1).any())))
    return seen
