"""Ten hours of learning: which ways keep what an agent knows?

1. Agents of paper B with both modalities learn for ten hours, in twelve pieces. In the task *kept* they desire what the
   papers' agents do; in *turned* they do for the first two pieces, 100 minutes, and then want red discs too, which is
   the trap of chapter 5. After every piece a copy of them learns no more, wants both colours and is measured
   (`companion.wanted.measures`).
2. A *way* is what differs from today's agent, by means of the thesis: `WAYS`. One of them is an element of interest
   that moves: the place where the agent was at the beginning of a second, which it fears throughout that second; in
   the task *turned* from the turn on, since red discs are feared before.
3. Ways were searched in `SEARCH_RUNS` runs from `SEARCH_SEED`. What was tried before is not recorded: for 100 minutes
   after the turn, in two runs from 762,500, fears of .3 to 4 seconds and valences of 1 to 8, some with ε of .05 to .2;
   and an element of interest of valence 1, 3 and 10 at the cell of 5 × 5 that had been visited least, which did not
   help. The same fears of a second were tried to the letter, and under the desire of the papers.
4. The ways in `REPORTED` are recorded from a seed that no search had. To the letter, three ways of *kept* were
   added later: "trail −1" when four runs of the others had been seen, after trails of −.3, −.5 and −1 in two runs from
   762,700; and, since it did not keep what was known, slower learning and times without desire when all runs of the
   others had been seen, after both, an end of learning and values that do not sink in two runs from 762,700.

``python -m companion.wanted.ten_hours search ten_hours_search.csv`` and ``… report ten_hours.csv`` record the tables,
and resume when rerun.
"""

import csv
import sys
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import NamedTuple

import numpy as np

from companion.wanted.lessons import WORLD, agent_of, desiring, varied
from companion.wanted.measures import caught
from neorl import Desire, Place, Run
from neorl.common.version import VERSION
from neorl.experiments.condition import source_digest

SHIPPED, SEARCHED = (Path(__file__).with_name(name) for name in ("ten_hours.csv", "ten_hours_search.csv"))
PIECES, PIECE, TURN = 12, 50, 2  # pieces, minutes in each, and pieces before red discs are wanted
MEASURED = 10  # minutes
SEARCH_SEED, SEARCH_RUNS = 762_000, 1
SEED, RUNS = 763_000, 12
TASKS = ("kept", "turned")


class Way(NamedTuple):
    """What differs from today's agent."""

    exploration: float = 0.0
    rate: float = 1.0  # times today's learning rate
    sinks: bool = True  # whether the values of actions that were not taken sink
    cycle: float = PIECE  # minutes, at the end of each of which `rest` minutes go by without desire
    rest: float = 0.0
    learns: int = PIECES  # pieces, after which it learns no more
    fear: float = 0.0  # of where it was at the beginning of a second, as valence


WAYS = {
    "today": Way(), "ε = .02": Way(0.02), "ε = .05": Way(0.05), "ε = .1": Way(0.1), "ε = .2": Way(0.2),
    "a tenth of the learning rate": Way(rate=0.1), "no value sinks": Way(sinks=False),
    "learning ends after 100 minutes": Way(learns=TURN),
    "1 minute in 10 without desire": Way(cycle=10, rest=1), "5 minutes in 10 without desire": Way(cycle=10, rest=5),
    "6 seconds a minute without desire": Way(cycle=1, rest=0.1),
    "30 seconds a minute without desire": Way(cycle=1, rest=0.5),
    "trail −1": Way(fear=1), "trail −2": Way(fear=2), "trail −3": Way(fear=3),
    "trail −3, ε = .2": Way(0.2, fear=3)}


class Row(NamedTuple):
    """One run of ten hours, piece by piece: each (pieces,)."""

    reading: str
    task: str
    way: str
    run: int
    green: np.ndarray  # caught a minute while learning
    red: np.ndarray
    known: np.ndarray  # discs of both colours a minute, wanting both and learning no more


def row_of(reading, task, name, seed, k, pieces=PIECES, piece=PIECE, measured=MEASURED):
    """Run ten hours in one way: a `Row`."""
    way = WAYS[name]
    agent = agent_of(reading)
    changes = {"learning_rate": way.rate * agent.learning.learning_rate} | ({} if way.sinks else {"absent_decay": 0.0})
    agent = varied(replace(agent, policy=replace(agent.policy, exploration=way.exploration)), **changes)
    first, later, idle = (desiring(agent, wanted) for wanted in ("green, fearing red", "both", "nothing"))
    run, found = Restless(first, WORLD, seed, k), []
    for at in range(pieces):
        turned, cycle, hits = task == "turned" and at >= TURN, min(way.cycle, piece), np.zeros(2)
        wanting = later if turned else first
        if way.fear and (turned or task == "kept"):
            wanting = fearing(wanting, way.fear)
        for _ in range(round(piece / cycle)):
            for desire, minutes in ((wanting, cycle - way.rest), (idle, way.rest)):
                if minutes > 0:
                    run.change(desire)
                    run.learns = at < way.learns
                    hits += run.met(round(60 * minutes * WORLD.fps))
        found.append((*hits / piece, caught(run, k, measured)))
    return Row(reading, task, name, k, *np.array(found).T)


def fearing(agent, valence):
    """The agent with a place as one more element of interest of each node, feared by a valence."""
    return replace(agent, desires=[*agent.desires, *(Desire(Place(0.5, 0.5), node.name, -valence)
                                                     for node in agent.nodes)])


class Restless(Run):
    """A `neorl.Run` whose agent's places of interest are where it was at the beginning of a second, if it has any."""

    def met(self, steps):
        """Take some steps, and return the things of each kind that were met, (kinds,)."""
        places = [e for e, desire in enumerate(self.agent.desires) if isinstance(desire.source, Place)]
        hits, second = 0, self.world.fps if places else steps
        for begin in range(0, steps, second):
            # Written where it is read, since a change of the agent takes as long as thousands of steps.
            self._record["desires"]["place"][places] = self.world_state.scene.position / self.world.size
            hits = hits + self.record(min(second, steps - begin), every=second).hits.sum(axis=0)
        return hits


def read(path=SHIPPED):
    """The rows of a recorded table: a list of `Row`."""
    with open(path, newline="") as file:
        return [Row(line["reading"], line["task"], line["way"], int(line["run"]),
                    *(np.array(line[name].split(), float) for name in ("green", "red", "known")))
                for line in csv.DictReader(file)]


@cache
def recorded(path=SHIPPED):
    """The recorded numbers: {(reading, task, way): (runs, 3, pieces)}."""
    rows = {}
    for row in sorted(read(path), key=lambda row: row.run):
        rows.setdefault((row.reading, row.task, row.way), []).append(row[4:])
    return {key: np.array(found) for key, found in rows.items()}


# What was searched and what is reported: (reading, task, ways).
SEARCH = [("calibrated", task, [*WAYS]) for task in TASKS]
REPORTED = [("calibrated", "kept", ["today", "ε = .02", "ε = .1"]),
            ("calibrated", "turned", ["today", "ε = .2", "trail −2", "trail −3, ε = .2"]),
            ("letter", "kept", ["today", "ε = .1", "trail −1", "a tenth of the learning rate",
                                "1 minute in 10 without desire"]),
            ("letter", "turned", ["today", "ε = .2", "trail −1"])]
PLANS = {"search": (SEARCH, SEARCH_SEED, SEARCH_RUNS), "report": (REPORTED, SEED, RUNS)}


def main(plan, path):
    """Append the runs of a plan that the table at `path` does not have."""
    wanted, seed, runs = PLANS[plan]
    new = not Path(path).exists()
    done = set() if new else {row[:4] for row in read(path)}
    with open(path, "a", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        if new:
            writer.writerow(["version", "source", "seed", *Row._fields])
        for key in [(*each, way, k) for k in range(runs) for *each, ways in wanted for way in ways]:
            if key not in done:
                row = row_of(*key[:3], seed, key[3])
                series = (" ".join(f"{number:.4g}" for number in numbers) for numbers in row[4:])
                writer.writerow([VERSION, source_digest()[:12], seed, *row[:4], *series])
                file.flush()


if __name__ == "__main__":
    main(*sys.argv[1:])
