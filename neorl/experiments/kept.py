"""Listing and clearing of the files that neorl keeps on disk.

A file counts as neorl's if its folder and name follow neorl's scheme; a file of claims must also describe itself. No
other file is listed or removed.

A file is *older* if it was not made by the present sources of neorl: conditions and claims record the digest of theirs,
and any other file is older if it was written before the sources were.
"""

import io
import json
import re
import zipfile
from pathlib import Path
from typing import NamedTuple

import numpy as np

from neorl import checks, files
from neorl.agents.agent import Agent
from neorl.agents.rules import CALIBRATED, GREEDY
from neorl.core.description import described
from neorl.experiments.cache import PARTS, Condition, source_digest
from neorl.experiments.exchange import OF_A_CONDITION
from neorl.worlds.arena import Arena
from neorl.worlds.waterworld import WaterWorld

DIGEST = "[0-9a-f]{64}"
KINDS = {"conditions": ("finished conditions", DIGEST),
         "runs": ("single runs of conditions that are not finished", DIGEST + r"-\d+"),
         "compiled": ("compiled kernels", DIGEST), "wasm": ("WebAssembly modules", DIGEST),
         "claims": ("claims of pages of the book", r"[a-z0-9_]+\.json")}
WHICH = ("all", "compiled", "older")
USUAL = {"learning": described(CALIBRATED), "policy": described(GREEDY), "own_cell": Agent.own_cell}
USUAL_WORLDS = {kind.__name__: described(kind()) for kind in (WaterWorld, Arena)}


class Kept(NamedTuple):
    """A file of neorl's. about: its record of a condition or of claims, or None."""

    kind: str
    path: Path
    size: int  # bytes
    about: dict | None
    is_older: bool


def kept():
    """All files that neorl keeps: a list of `Kept`."""
    found, sources = [], _sources_changed()
    for kind, (_, pattern) in KINDS.items():
        for path in sorted((files.cache_folder() / kind).glob("*")):
            if not re.fullmatch(pattern, path.name) or not path.is_file():
                continue
            try:
                about, status = NOTES[kind](path) if kind in NOTES else None, path.stat()
            except FileNotFoundError:  # removed by another process in the meantime
                continue
            if kind == "claims" and not about:
                continue
            is_older = (about or {}).get("source") != source_digest() if kind in NOTES else status.st_mtime < sources
            found.append(Kept(kind, path, status.st_size, about, is_older))
    return found


def conditions():
    """Every complete `Condition` on disk that was computed with the present source and can be restored: a list."""
    found = []
    for each in kept():
        if each.kind == "conditions" and each.about and not each.is_older:
            try:
                condition = Condition.from_dict({name: each.about[name] for name in OF_A_CONDITION})
                found += [condition] if condition.path == each.path else []  # else a kernel or a constant has changed
            except (ValueError, KeyError):  # a kernel that is not defined in a module
                continue
    return found


def clear(which="all"):
    """Remove files that neorl keeps: "all", "compiled" code (kernels and WebAssembly), or "older" files.

    which: one of these three. Raises ValueError for anything else, OSError without permission.
    Returns the list of `Kept` that were removed.
    """
    checks.one_of("which", which, WHICH)
    removed = [each for each in kept() if which == "all" or which == "older" and each.is_older
               or which == "compiled" and each.kind in ("compiled", "wasm")]
    for each in removed:
        each.path.unlink(missing_ok=True)
    return removed


def in_words(about):
    """A condition described in a line, from its plain data (`neorl.experiments.exchange.about`)."""
    changes = "".join(f", from step {step:,} on {_agent(agent)}" for step, agent in about["changes"])
    return (f"{_agent(about['agent'])} in {_world(about['world'])}{changes}, {about['steps']:,} steps, "
            f"{about['runs']} run{'s' * (about['runs'] != 1)}, seed {about['seed']}")


def _agent(data):
    """An agent: its maps, and its departures from the defaults."""
    if not isinstance(data, dict):
        return str(data)
    nodes = " and ".join(f"{node['name']} {'+'.join(f'N{n}' for n in node['resolutions'])}" for node in data["nodes"])
    unusual = [f"{name} {_value(value)}" for table in ("learning", "policy") for name, value in data[table].items()
               if value != USUAL[table].get(name)]
    unusual += [f"own_cell {data['own_cell']}"] * (data["own_cell"] != USUAL["own_cell"])
    return f"{nodes} ({', '.join(unusual)})" if unusual else nodes


def _world(data):
    """A world: its name, and its departures from the defaults, where these are known."""
    if not isinstance(data, dict):
        return str(data)
    usual = USUAL_WORLDS.get(data["is"], {})
    unusual = [f"{name} {_value(value)}" for name, value in data.items() if name != "is" and value != usual.get(name)]
    name = data["is"].rpartition(":")[2]
    return f"{name} ({', '.join(unusual)})" if unusual else name


def _value(value):
    if isinstance(value, dict) and "kernel" in value:
        name = value["kernel"].rpartition(":")[2]
        return f"{name}({', '.join(map(str, value['of']))})" if "of" in value else name
    return str(value)


def _about_condition(path):
    """The record of a condition beside its arrays, or None if an earlier version did not write it or it is damaged."""
    try:
        with zipfile.ZipFile(path) as archive:
            about = json.loads(str(np.load(io.BytesIO(archive.read("about.npy")))))
        in_words(about)
        return about
    except FileNotFoundError:
        raise
    except Exception:  # whatever zip, NumPy and JSON raise
        return None


def _about_claims(path):
    try:
        about = json.loads(path.read_text(encoding="utf-8"))
    except ValueError:
        return None
    return about if isinstance(about, dict) and {"page", "source", "claims"} <= about.keys() else None


NOTES = {"conditions": _about_condition, "claims": _about_claims}


def _sources_changed():
    """When the sources that take part in a run were last written."""
    package = Path(files.__file__).parent
    return max(path.stat().st_mtime for part in PARTS
               for path in [*package.glob(f"{part}.py"), *(package / part).rglob("*.py")])
