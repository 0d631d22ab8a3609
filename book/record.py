"""Record what a build with 100 runs has found, as `record.json`: ``make record``, after ``make book RUNS=100``.

1. The record has the claims of all pages with their numbers, runs and verdicts, under both readings, and the shares of
   readings. It is committed, and what the front page, the page of claims and the README show. A build to the letter,
   ``make book RUNS=100 READING=letter``, replaces the claims to the letter, and any other build all else.
2. It holds as long as runs have the same bits and the readings the same choices. So it has a *sample*, a run of each of
   some conditions under both readings, which a test recomputes (`moved`).
"""

import datetime
import hashlib
import json
import subprocess
import sys
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[1] / "notebooks"))  # has what pages share

# ruff: noqa: E402
from compute import ROOT, records
from companion.page import report
from verify import recomputed

from companion.thesis.reading import LENGTHS, NAMES, READINGS, conditions
from companion.thesis.statements import AGENTS, STATEMENTS
from neorl.experiments.condition import source_digest
from neorl.files import write_whole

RECORD = ROOT / "book" / "record.json"
RUNS = 100
REMEDY = f"make book RUNS={RUNS} && make record"
READ = [name for name in AGENTS if name != "A10"]  # of agents that are run; A10 is about stored runs of deep learners
SAMPLED = (("brownian", 8), ("layer", 7), "layers", ("single", 50), ("place", "all"), ("objects", "all"), "both",
           *(("network", name) for name in "ABCD"), "revalued")
SEED = 0  # of the pages


def main():
    found = report.load(records().values())
    if changed := output("git", "status", "--porcelain", "--", ".", f":!{RECORD.relative_to(ROOT)}"):
        sys.exit(f"the work tree must be clean, so that the commit has all that was computed, but it has:\n{changed}")
    sources = {json.loads(path.read_text(encoding="utf-8"))["source"] for path in records().values()}
    before = of_book({"letter": {}})
    if "claims" in before and not few(found["letter"], READ) and sources == {source_digest()}:
        content = before | rounded({"letter": found["letter"]})
    elif reason := unfit(found, sources):
        sys.exit(f"{reason}: {REMEDY}")
    else:
        about = {"commit": output("git", "rev-parse", "--short", "HEAD"), "date": f"{datetime.date.today()}"}
        content = about | rounded(found | {"letter": before["letter"]})
    content |= {"sample": sample()}
    write_whole(RECORD, (json.dumps(content, indent=1, sort_keys=True, ensure_ascii=False) + "\n").encode())


def of_book(build):
    """The committed record, or without one the build's own."""
    return json.loads(RECORD.read_text(encoding="utf-8")) if RECORD.exists() else build


def unfit(found, sources):
    """Why findings, as `report.load` returns them, are not to be recorded, in words; "" if they are.

    sources: digests of the sources that computed them.
    """
    missing = [name for name in STATEMENTS if name not in found["claims"]]
    if missing or not found["shares"]:
        return f"every claim must be judged, but not {', '.join(missing) or 'under other readings'}"
    if short := few(found["claims"], READ):
        return f"claims about agents must have {RUNS} runs of each condition, but not {', '.join(short)}"
    return "" if sources == {source_digest()} else "every page must be computed with the present source"


def few(claims, names):
    """The names of claims that are not among some, or have fewer than 100 runs: a list."""
    return [name for name in names if claims.get(name, {"runs": 0})["runs"] < RUNS]


def sample():
    """The first run of each condition under each reading, as `summary` has it: {reading: {condition: [...]}}."""
    wanted = {NAMES[name]: conditions(reading, LENGTHS["B"], 1, SEED) for name, reading in READINGS.items()}
    return {name: {key if isinstance(key, str) else " ".join(map(str, key)): summary(made[key]) for key in SAMPLED}
            for name, made in wanted.items()}


def summary(condition):
    """The total reward of a condition's first run, and a digest of its rewards in each bin."""
    rewards, _ = recomputed(condition, 0)
    return [float(rewards.sum(dtype=np.float64)), hashlib.sha256(rewards.astype("<f4").tobytes()).hexdigest()[:16]]


def moved(record):
    """The sampled runs of a record that the present source computes otherwise: a list of "reading, condition"."""
    now = sample()
    return [f"{reading}, {key}" for reading, runs in now.items() for key, run in runs.items()
            if record["sample"].get(reading, {}).get(key) != run]


def rounded(found):
    """The same findings with numbers of six significant digits."""
    return json.loads(json.dumps(found), parse_float=lambda text: float(f"{float(text):.6g}"))


def output(*command):
    """What a command prints, in the root of the project. Raises CalledProcessError if it fails."""
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout.rstrip()


if __name__ == "__main__":
    main()
