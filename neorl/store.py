"""Finished conditions on disk, so that nothing is computed twice.

A condition is kept under a key of all that determines it: agent, world, steps, runs, seed, and the source of every
module that takes part in a run. A file is complete or absent, whatever moment the process is killed at, and carries a
digest of its content: one that is damaged is noticed and computed again.

The files lie in the folder that the environment variable ``NEORL_CACHE`` names, or in the user's cache folder; all of
it may be deleted at any time.
"""

import hashlib
import io
import os
import tempfile
from pathlib import Path

import numpy as np
import platformdirs

from neorl.simulation import Result, checked_changes, simulate

SOURCES = ("agent", "checks", "horde", "kernel", "life", "modality", "network", "nres", "plan", "simulation", "stream",
           "waterworld")
DIGEST_BYTES = hashlib.sha256().digest_size


def simulate_once(agent, world, *, steps, runs, seed=0, changes=(), progress=True):
    """`simulate`, unless the same condition is on disk already; then what was computed is read. Returns a `Result`."""
    changes = checked_changes(changes, steps)
    key = condition_key(agent, world, steps, runs, seed, changes)
    path = folder() / "conditions" / key
    kept = read_checked(path)
    if kept is not None:
        arrays = np.load(io.BytesIO(kept))
        return Result(agent, world, steps, runs, seed, arrays["rewards"], arrays["hits"], changes)
    result = simulate(agent, world, steps=steps, runs=runs, seed=seed, changes=changes, progress=progress)
    content = io.BytesIO()
    np.savez_compressed(content, rewards=result.rewards, hits=result.hits)
    write_checked(path, content.getvalue())
    return result


def folder():
    """Where finished conditions and claims are kept: a `pathlib.Path`."""
    return Path(os.environ.get("NEORL_CACHE") or platformdirs.user_cache_path("neorl-companion"))


def condition_key(agent, world, steps, runs, seed, changes=()):
    """A name for a condition: 64 hexadecimal digits, of all that determines its result."""
    return hashlib.sha256(repr((agent, world, steps, runs, seed, changes, source_digest())).encode()).hexdigest()


def source_digest():
    """A digest of the source of every module that takes part in a run."""
    here = Path(__file__).parent
    return hashlib.sha256(b"".join((here / f"{name}.py").read_bytes() for name in SOURCES)).hexdigest()


def read_checked(path):
    """What `write_checked` has written, or None if there is no such file or it is damaged."""
    try:
        content = path.read_bytes()
    except OSError:
        return None
    return content[DIGEST_BYTES:] if hashlib.sha256(content[DIGEST_BYTES:]).digest() == content[:DIGEST_BYTES] else None


def write_checked(path, content):
    """Write bytes to a file, after a digest of them."""
    write_whole(path, hashlib.sha256(content).digest() + content)


def write_whole(path, content):
    """Write bytes to a file that others see complete or not at all."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.NamedTemporaryFile(dir=path.parent, prefix=".", delete=False) as file:
        file.write(content)
        file.flush()
        os.fsync(file.fileno())
    os.replace(file.name, path)
