"""The yoked experiment: agents that learned from the same streams in different ways, and what they know.

1. A *stream* is what an agent of paper B with both modalities does in 100 simulated minutes of learning, with one of
   `WANTED` as its desire. Its *own* lesson is what it has learned itself.
2. The other `LESSONS` are those of partners that learn from the same stream, scene by scene and action by action
   (`companion.wanted.yoked`), or of the agent at another time. `predictions.toml` beside this file says why each.
3. Run k of a reading begins in the same tank whatever is desired, and random motion of a reading is one stream, which
   the lessons of the others refer to. *Untrained* agents are the measure of chance.

``python -m companion.wanted.lessons lessons.csv`` records the table: `RUNS` runs of each, from a seed that no other
run of the book has. It resumes when rerun, and takes about twenty minutes of one core.
"""

import csv
import sys
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

from companion.thesis.reading import READINGS, conditions
from companion.wanted.measures import Knowledge, Stream, knowledge, stream_of, wanting, wanting_place
from companion.wanted.yoked import Partner
from neorl import Place, Run
from neorl.common.version import VERSION
from neorl.experiments.condition import source_digest

SHIPPED = Path(__file__).with_name("lessons.csv")
RUNS, SEED = 24, 761_000
MINUTES, SHORT = 100, 10  # of a stream, and of its beginning and its end
PLACE = Place(0.3, 0.3)
WANTED = ("nothing", "green, fearing red", "green", "both", "a place")
LESSONS = ("own", "first", "last", "wide", "unsunk", "slow", "credited", "other", "mended")
UNTRAINED = "untrained"


class Row(NamedTuple):
    """One agent that has been measured."""

    reading: str  # a name in `READINGS`, the rule that the stream's agent learns by
    wanted: str  # in `WANTED`, or `UNTRAINED`
    lesson: str
    run: int
    knowledge: Knowledge
    stream: Stream | None  # beside its own lesson
    end: Stream | None  # of the last minutes


def agent_of(reading):
    """The agent of paper B with both modalities under a reading."""
    return conditions(READINGS[reading], 1, 1)["both"].agent


WORLD = conditions(READINGS["calibrated"], 1, 1)["both"].world


def desiring(agent, wanted):
    """The agent with one of `WANTED` as its desire."""
    if wanted == "a place":
        return wanting_place(agent, PLACE)
    return wanting(agent, *{"nothing": (0.0, 0.0), "green, fearing red": (1.0, -1.0), "green": (1.0, 0.0),
                            "both": (1.0, 1.0)}[wanted])


def varied(agent, **learning):
    """The agent with another rule of learning."""
    return replace(agent, learning=replace(agent.learning, **learning))


def rows_of_run(reading, k, minutes=MINUTES, short=SHORT, wanted=WANTED, measured_minutes=None):
    """Yield a `Row` of each lesson of each stream, in run k of a reading, which begin with "nothing"."""
    agent, fps = agent_of(reading), WORLD.fps
    whole, begin = 60 * minutes * fps, 60 * short * fps
    measure = {} if measured_minutes is None else {"minutes": measured_minutes}
    yield Row(reading, UNTRAINED, "own", k, knowledge(Run(agent, WORLD, SEED, k), k, **measure), None, None)
    random = None
    for desire in wanted:
        run = Run(desiring(agent, desire), WORLD, SEED, k)
        path = run.record(begin)
        first, rest = run.copy(), run.record(whole - begin)
        random = random or first
        actions = path.actions, rest.actions
        learned = {"own": run, "first": first, **partners(agent, reading, k, actions, begin, random)}
        learned["mended"] = run.copy()
        learned["mended"].change(desiring(agent, "nothing"))
        learned["mended"].advance(begin)
        whole_stream, end = stream_of(_joined(path, rest), agent, WORLD), stream_of(_last(rest, begin), agent, WORLD)
        for lesson in LESSONS:
            of_own = (whole_stream, end) if lesson == "own" else (None, None)
            yield Row(reading, desire, lesson, k, knowledge(learned[lesson], k, **measure), *of_own)


def partners(agent, reading, k, actions, short, random):
    """The partners that learn from the actions of a stream, by their lesson, as `Partner`s.

    actions: of the first minutes, and of all others. short: the steps that "last" learns from. random: a run that has
    moved at random in the first minutes.
    """
    other = next(name for name in READINGS if name != reading)
    kinds = {"last": agent, "wide": agent, "unsunk": varied(agent, absent_decay=0.0), "slow": agent,
             "credited": varied(agent, credit="last"), "other": agent_of(other)}
    made = {lesson: Partner(kind, WORLD, SEED, k) for lesson, kind in kinds.items()}
    first, rest = actions
    made["last"].learns = made["wide"].learns = False
    for partner in made.values():
        partner.follow(first)
    made["wide"].transfer(random)
    made["wide"].learns = True
    made["slow"].change(varied(agent, learning_rate=agent.learning.learning_rate / 10))
    made["last"].follow(rest[:-short])
    made["last"].learns = True
    made["last"].follow(rest[-short:])
    for lesson, partner in made.items():
        if lesson != "last":
            partner.follow(rest)
    return made


def _joined(path, rest):
    return replace(path, positions=np.concatenate([path.positions[:-1], rest.positions]),
                   actions=np.concatenate([path.actions, rest.actions]), hits=np.concatenate([path.hits, rest.hits]))


def _last(path, steps):
    return replace(path, positions=path.positions[-steps - 1 :], actions=path.actions[-steps:], hits=path.hits[-steps:])


def read(path=SHIPPED):
    """The rows of a recorded table: a list of `Row`."""
    with open(path, newline="") as file:
        return [Row(line["reading"], line["wanted"], line["lesson"], int(line["run"]),
                    Knowledge(*(float(line[name]) for name in Knowledge._fields)),
                    *(Stream(*(float(line[f"{part}_{name}"]) for name in Stream._fields))
                      if line[f"{part}_covered"] else None for part in ("stream", "end")))
                for line in csv.DictReader(file)]


def main(path):
    """Append the runs of the plan that the table at `path` does not have."""
    new = not Path(path).exists()
    done = {} if new else {(row.reading, row.run) for row in read(path)}
    numbers = [*Knowledge._fields, *(f"{part}_{name}" for part in ("stream", "end") for name in Stream._fields)]
    with open(path, "a", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        if new:
            writer.writerow(["version", "source", "seed", "reading", "wanted", "lesson", "run", *numbers])
        for k in range(RUNS):
            for reading in READINGS:
                if (reading, k) in done:
                    continue
                rows = list(rows_of_run(reading, k))
                for row in rows:
                    streams = [*(row.stream or [""] * 4), *(row.end or [""] * 4)]
                    writer.writerow([VERSION, source_digest()[:12], SEED, *row[:4],
                                     *(f"{each:.4g}" if each != "" else "" for each in (*row.knowledge, *streams))])
                file.flush()


if __name__ == "__main__":
    main(*sys.argv[1:])
