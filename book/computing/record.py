"""Compute and record what is reproduced, as `record.json`: ``make record``, some three core-hours.

1. Claims about the papers' agents are judged by runs of the record's own, under both readings: as many as `RUNS` says
   for each group of conditions, from a seed that no search has seen. Their numbers were fixed before, and they are
   looked at once. Finished runs are cached, so that an interrupted record goes on where it was.
2. All other claims are those of pages, from a build with 100 runs, ``make book RUNS=100``; those that the last build
   lacks stay as they were recorded. Beside them stand paper A's claims at 50 steps per second.
3. The record is committed, and what the front page, the page of claims and the README show. It holds as long as runs
   have the same bits and the readings the same choices. So it has a *sample*, a run of each of some conditions under
   both readings, which a test recomputes (`moved`).
4. Beside it, `curves.json` has the means of all conditions over their runs, which pages draw behind few runs of theirs.
"""

import datetime
import hashlib
import json
import subprocess
import sys
import time
from dataclasses import replace

import numpy as np
from companion.chapter_5 import trials
from companion.page import behind, report
from companion.paper_a import squares_entered
from companion.page.report import RECORD
from companion.paper_b.trials import mean_stays
from companion.thesis import claims
from companion.thesis.reading import GROUPS, LENGTHS, NAMES, PRIMES, READINGS, conditions, judge
from companion.thesis.measures import FINAL
from companion.thesis.statements import STATEMENTS

from computing.compute import ROOT, records
from computing.verify import recomputed
from neorl.common.files import write_whole
from neorl.experiments.condition import source_digest
from neorl.experiments.simulation import sweep
from neorl.statistics import binned_rate, estimate

SEED = 20_261_129
CALIBRATED = {"layers": 500, "single": 200, "modal": 500, "pace": 500, "networks": 1_000, "revaluing": 100,
              "resolutions": 100, "long": 10, "exploring": 100, "grown": 100, "wanted": 50}
RUNS = {"claims": CALIBRATED, "letter": CALIBRATED | dict.fromkeys(
    ("layers", "modal", "pace", "networks"), 200) | {"single": 100}}  # where most is clear
CONTROLS = 1_000  # runs of Brownian motion
OF_PAGES = 100  # runs of claims that pages judge
AT_50 = {"layers": 100, "single": 50}  # of the calibrated reading with paper A at 50 steps per second
FORAGERS = {name: replace(each, runs=OF_PAGES, seed=SEED) for name, each in behind.FORAGERS.items()}
REMEDY = "make record"
SAMPLED = (("brownian", 8), ("layer", 7), "layers", ("single", 50), ("place", "all"), ("objects", "all"), "both",
           *(("network", name) for name in "ABCD"), "revalued")


def main():
    if changed := output("git", "status", "--porcelain", "--", ".",
                         *(f":!{path.relative_to(ROOT)}" for path in (RECORD, behind.CURVES))):
        sys.exit(f"the work tree must be clean, so that the commit has all that was computed, but it has:\n{changed}")
    content = {part: {} for part in report.PARTS}
    if RECORD.exists():
        content |= json.loads(RECORD.read_text(encoding="utf-8"))
    for part, of_pages in built().items():
        content[part] = content[part] | of_pages
    curves = {}
    for name, reading in READINGS.items():
        part = report.PART_OF[name]
        results = results_of(reading, RUNS[part])
        content[part] = content[part] | report.kept(of_reading(results, RUNS[part]).values())
        curves[name] = {behind.words(key): curve(result) for key, result in results.items()}
    curves["calibrated"] |= dict(zip(FORAGERS, map(curve, sweep([*FORAGERS.values()]))))
    at_50 = READINGS["calibrated"].varied(paper_a_fps=50)
    content |= {"paper A at 50": report.kept(judge(results_of(at_50, AT_50)).values()),
                "commit": output("git", "rev-parse", "--short", "HEAD"), "date": f"{datetime.date.today()}"}
    if missing := [name for name in STATEMENTS if name not in content["claims"]]:
        sys.exit(f"every claim must be judged, but not {', '.join(missing)}: make book RUNS={OF_PAGES}, then {REMEDY}")
    content = rounded(content) | {"sample": sample()}
    write_whole(RECORD, (json.dumps(content, indent=1, sort_keys=True, ensure_ascii=False) + "\n").encode())
    write_whole(behind.CURVES, (json.dumps(rounded(curves, 4), sort_keys=True) + "\n").encode())


def built():
    """What the last build has found on claims that pages alone judge, with enough runs and the present source.

    Returns {part of the record: {name of a claim: …}}, as `report.load` does.
    """
    paths = [path for path in records().values()
             if json.loads(path.read_text(encoding="utf-8"))["source"] == source_digest()]
    found = report.load(paths)
    enough = {part: {name: each for name, each in found[part].items()
                     if each["runs"] >= OF_PAGES or STATEMENTS[name].kind in ("code", "report") or name == "A10"}
              for part in ("claims", "letter")}
    return enough | ({"shares": found["shares"]} if found["shares"] else {})


def of_reading(results, runs):
    """The claims about the papers' agents under a reading: {name: `Claim`}. runs: {group of conditions: number}."""
    both, place = (replace(results[key].condition, runs=runs["revaluing"]) for key in ("both", ("place", "all")))
    moved = {"both": trials.distances(both).means, "place cells": trials.distances(place).means}
    stays = mean_stays(replace(place, runs=OF_PAGES))
    squares = {behind.words(key): explored(results[key].condition) for key in GROUPS["layers"]}
    together, chance = (squares.pop(name) for name in ("layers", "brownian 8"))
    return judge(results | {"moved": moved}) | {
        "T8": claims.judge_time_scale(PRIMES, stays.seconds, stays.without),
        "T9": claims.judge_exploration(together, squares, chance)}


def explored(condition):
    """The squares of the board that the first runs of a condition enter in the first tenth of a run, (runs,)."""
    return squares_entered(condition.agent, condition.world, LENGTHS["A"] // 10, OF_PAGES, SEED)[:, -1].astype(float)


def results_of(reading, runs):
    """The results of a reading's conditions: {key: `Result`}, of each the most runs that a group asks for."""
    wanted = {}
    for group, number in sorted(runs.items(), key=lambda item: -item[1]):
        for key, condition in conditions(reading, LENGTHS["B"], number, SEED, [group]).items():
            wanted.setdefault(key, replace(condition, runs=CONTROLS) if key[0] == "brownian" else condition)
    results, began = {}, time.monotonic()
    for key, condition in wanted.items():
        (results[key],) = sweep([condition])
        print(f"{behind.words(key)}: {condition.runs} runs, {time.monotonic() - began:.0f} s", flush=True)
    return results


def curve(result):
    """The mean reward per second of a result's runs over time, in the whole and finally, as `behind.Recorded` has it.

    Intervals are those of a normal distribution, since runs are many.
    """
    rates = binned_rate(result, min(behind.BINS, result.rewards.shape[1]))
    error = 1.96 * rates.std(axis=0, ddof=1) / np.sqrt(result.runs)
    mean = rates.mean(axis=0)
    return {"runs": result.runs, "minutes": result.seconds / 60, "curve": np.array(
        [mean, mean - error, mean + error]).tolist(), "whole": estimate(np.mean, result.rate()),
        "final": estimate(np.mean, result.rate(*FINAL))}


def sample():
    """The first run of each condition under each reading, as `summary` has it: {reading: {condition: [...]}}."""
    wanted = {NAMES[name]: conditions(reading, LENGTHS["B"], 1, SEED) for name, reading in READINGS.items()}
    return {name: {behind.words(key): summary(made[key]) for key in SAMPLED} for name, made in wanted.items()}


def summary(condition):
    """The total reward of a condition's first run, and a digest of its rewards in each bin."""
    rewards, _ = recomputed(condition, 0)
    return [float(rewards.sum(dtype=np.float64)), hashlib.sha256(rewards.astype("<f4").tobytes()).hexdigest()[:16]]


def moved(record):
    """The sampled runs of a record that the present source computes otherwise: a list of "reading, condition"."""
    now = sample()
    return [f"{reading}, {key}" for reading, runs in now.items() for key, run in runs.items()
            if record["sample"].get(reading, {}).get(key) != run]


def rounded(found, digits=6):
    """The same findings with numbers of some significant digits."""
    return json.loads(json.dumps(found), parse_float=lambda text: float(f"{float(text):.{digits}g}"))


def output(*command):
    """What a command prints, in the root of the project. Raises CalledProcessError if it fails."""
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout.rstrip()


if __name__ == "__main__":
    main()
