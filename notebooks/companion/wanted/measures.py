"""What an agent knows, measured: it learns no more, desires something, and acts in a tank that it has not seen.

1. Every agent is measured in the same tanks: run k of `SEED`. It takes over the values that were learned, and nothing
   else.
2. *Caught*: discs of both colours a minute, while it wants both. *Earned*: points a second under the desire of the
   papers, green discs less red ones. *Seconds*: the mean time to a lone place, of `PLACES` in turn; one that is not
   reached counts as `PATIENCE`.
3. The exact answer is known for places, and for vectors: where there are no walls in between, the best push reduces
   the distance. *Places* and *vectors* are the shares of pairs of a cell and a goal for which the push of highest
   value does so, over all maps of a modality with their weights, between the cells of the finest. Where several
   pushes are best, each counts by its share. Cells of places count that the agent can enter, see `within_reach`.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from neorl import Desire, Place, Run

SEED = 761_900
MINUTES = 20
PLACES = (Place(0.2, 0.2), Place(0.8, 0.7), Place(0.25, 0.75), Place(0.7, 0.2), Place(0.5, 0.5), Place(0.85, 0.4))
NEAR, PATIENCE = 0.07, 60  # board widths, seconds


class Knowledge(NamedTuple):
    """What an agent knows, each a number."""

    caught: float
    earned: float
    seconds: float
    places: float
    vectors: float


def wanting(agent, green, red):
    """The agent with other valences of green and of red discs."""
    return replace(agent, desires=[replace(desire, valence={"green": green, "red": red}[desire.source])
                                   for desire in agent.desires])


def wanting_place(agent, place):
    """The agent with a lone place as its only desire, in each of its nodes."""
    return replace(agent, desires=[Desire(place, node.name, valence=1.0) for node in agent.nodes])


def knowledge(learned, k, minutes=MINUTES):
    """What a run has learned, measured in the tank of run k: `Knowledge`."""
    earned = _minutes_of(told(learned, 1.0, -1.0, k), minutes).rewards.sum() / (60 * minutes)
    return Knowledge(caught(learned, k, minutes), earned, _seconds_to_places(learned, k),
                     *(pointing(learned, n) for n in range(2)))


def caught(learned, k, minutes=MINUTES):
    """The discs of both colours that an agent catches a minute, if it wants both and learns no more."""
    return _minutes_of(told(learned, 1.0, 1.0, k), minutes).hits.sum() / minutes


def told(learned, green, red, k=0):
    """The run of an agent that has learned the same, learns no more, and desires discs alone, without exploration.

    green, red: the valence of either, in each of its nodes.
    """
    agent = learned.agent
    return _frozen(learned, replace(agent, policy=replace(agent.policy, exploration=0.0), desires=[
        Desire(kind, node.name, valence) for node in agent.nodes for kind, valence in (("green", green), ("red", red))
    ]), k)


def _minutes_of(run, minutes):
    steps = round(60 * minutes * run.world.fps)
    return run.record(steps, every=steps)


def _frozen(learned, agent, k):
    run = Run(agent, learned.world, SEED, k)
    run.transfer(learned)
    run.learns = False
    return run


def _seconds_to_places(learned, k):
    world, times = learned.world, []
    run = _frozen(learned, wanting_place(learned.agent, PLACES[0]), k)
    for place in PLACES:
        run.change(wanting_place(learned.agent, place))
        run.learns = False
        path = run.copy().record(PATIENCE * world.fps).positions / world.size
        far = np.linalg.norm(path - place.coordinates, axis=1) > NEAR
        steps = int(far.argmin()) if not far.all() else len(far) - 1
        run.advance(steps)
        times.append(steps / world.fps)
    return float(np.mean(times))


def pointing(run, n):
    """The share of pairs of a cell and a goal for which the best push leads to the goal, in node n of an agent."""
    node, pushes = run.agent.nodes[n], np.array(run.world.actions.pushes, float)
    first, of_places = sum(len(other.resolutions) for other in run.agent.nodes[:n]), node.state == "object"
    finest = max(node.maps, key=lambda nres: nres.resolution)
    low, high = (np.array([getattr(axis, end) for axis in node.modality.axes]) for end in ("low", "high"))
    shares = (np.arange(finest.resolution) + 0.5) / finest.resolution
    centres = np.stack(np.meshgrid(shares, shares), axis=-1).reshape(-1, 2) * (high - low) + low
    if of_places:
        centres = centres[within_reach(finest, run.world)[finest.encode(centres)]]
    sources = centres if of_places else np.zeros((1, 2))
    values = np.zeros((len(sources), len(pushes), len(centres)))
    for m, nres in enumerate(node.maps, first):
        own = nres.encode(sources) if of_places else [0]
        values += run.state.maps.weight[m] * run.q(m)[own][:, :, nres.encode(centres)]
    apart = centres[np.newaxis] - sources[:, np.newaxis]
    leads = np.einsum("sgx,ax->sag", apart, pushes) > 1e-9
    best = values == values.max(axis=1, keepdims=True)
    share = (best & leads).sum(axis=1) / best.sum(axis=1)
    return float(share[np.linalg.norm(apart, axis=-1) > 1e-9].mean())


def within_reach(nres, world):
    """The cells of a map of places that the agent can enter, whose place is its upper left corner: bool (cells,)."""
    far = 1 - 2 * world.radius / world.size
    ends = np.linspace(0.0, far, 10 * nres.resolution)
    cells = nres.encode(np.stack(np.meshgrid(ends, ends), axis=-1).reshape(-1, 2))
    return np.bincount(cells, minlength=nres.cells) > 0


class Stream(NamedTuple):
    """How much of the board a stream covers, and what it brought: each a number."""

    covered: float  # the share of cells of the finest map of places that it entered
    entropy: float  # of the time in these cells, as a share of that in all of them alike
    pairs: float  # the share of pairs of a cell and an action that occurred
    paid: float  # points a second


def stream_of(path, agent, world):
    """What a `neorl.experiments.run.Trajectory` with a frame for each step covers: `Stream`."""
    finest = max(agent.nodes[0].maps, key=lambda nres: nres.resolution)
    cells, n_actions = finest.encode(path.positions[:-1] / world.size), len(world.actions.names)
    reached = int(within_reach(finest, world).sum())
    share = np.bincount(cells, minlength=finest.cells) / len(cells)
    entropy = -(share[share > 0] * np.log(share[share > 0])).sum() / np.log(reached)
    pairs = len(np.unique(cells * (n_actions + 1) + path.actions)) / (reached * n_actions)
    return Stream(float((share > 0).sum() / reached), float(entropy), pairs,
                  (path.hits[:, 0] - path.hits[:, 1]).sum() / (len(cells) / world.fps))
