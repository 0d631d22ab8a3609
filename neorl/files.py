"""Files that are complete or absent, whatever moment the process is killed at, and the folder of those that may go.

What takes long to make is kept in the folder that the environment variable ``NEORL_CACHE`` names, or in the user's
cache folder; all of it may be deleted at any time. What a killed process was writing is removed by a later one.
"""

import contextlib
import functools
import hashlib
import io
import json
import os
import time
import uuid
from pathlib import Path

import numpy as np
import platformdirs

DIGEST_BYTES = hashlib.sha256().digest_size
UNFINISHED = (".neorl-", ".tmp")  # how the name of a file that is being written begins and ends
STALE_SECONDS = 3_600  # since its last byte: no process writes on after that
FORMAT = 1  # of files of arrays


def cache_folder():
    """Where what may be deleted is kept: a `pathlib.Path`."""
    return Path(os.environ.get("NEORL_CACHE") or platformdirs.user_cache_path("neorl-companion"))


def write_whole(path, content):
    """Write bytes to a file that others see complete or not at all. Raises OSError, and leaves nothing behind then."""
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    _remove_stale(path.parent)
    prefix, suffix = UNFINISHED
    unfinished = path.parent / f"{prefix}{uuid.uuid4().hex}{suffix}"  # `tempfile` would shut others out of the file
    try:
        with open(unfinished, "xb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        os.replace(unfinished, path)
    except BaseException:
        with contextlib.suppress(OSError):
            os.unlink(unfinished)
        raise


@functools.cache  # a look at every name in the folder, so once a process is enough
def _remove_stale(folder):
    """Remove what killed processes have left half-written in a folder."""
    with contextlib.suppress(OSError):
        for path in folder.glob("*".join(UNFINISHED)):
            if time.time() - path.stat().st_mtime > STALE_SECONDS:
                path.unlink()


def write_checked(path, content):
    """Write bytes to a file, after a digest of them."""
    write_whole(path, hashlib.sha256(content).digest() + content)


def read_checked(path):
    """What `write_checked` has written, or None if there is no such file or it is damaged."""
    try:
        content = path.read_bytes()
    except OSError:
        return None
    return content[DIGEST_BYTES:] if hashlib.sha256(content[DIGEST_BYTES:]).digest() == content[:DIGEST_BYTES] else None


def write_arrays(path, kind, about, arrays, write=np.savez):
    """Write arrays to an npz file, with a readable text about them in JSON, and a digest.

    kind, about: what is written, and a dict about it. write: `numpy.savez` or `numpy.savez_compressed`.
    """
    about = {"format": FORMAT, "is": kind, **about, "digest": _digest(arrays)}
    content = io.BytesIO()
    write(content, about=np.array(json.dumps(about)), **arrays)
    write_whole(path, content.getbuffer())


def read_arrays(path, kind):
    """What `write_arrays` has written: (about, arrays).

    Raises OSError if there is no such file, ValueError if it is damaged, or of another kind or version.
    """
    with Path(path).open("rb") as opened:
        try:
            with np.load(opened, allow_pickle=False) as file:
                arrays = {name: file[name] for name in file.files}
            about = json.loads(str(arrays.pop("about")))
            digest, known, holds = about["digest"], about.get("format"), about.get("is")
        except Exception as error:  # whatever zip, NumPy and JSON make of the content of another file
            raise ValueError(f"{path} is damaged, or was not written by neorl: {error!r}") from error
    if isinstance(known, int) and known > FORMAT:
        raise ValueError(f"{path} is of format {known}, which a newer neorl has written, allowed is {FORMAT}")
    if (known, holds) != (FORMAT, kind) or digest != _digest(arrays):
        raise ValueError(f"{path} holds a {holds} of format {known}, or is damaged; allowed is a {kind} of format "
                         f"{FORMAT}")
    return about, arrays


def _digest(arrays):
    digest = hashlib.sha256()
    for name in sorted(arrays):
        digest.update(f"{name} {arrays[name].dtype} {arrays[name].shape}".encode())
        digest.update(np.ascontiguousarray(arrays[name]).data)
    return digest.hexdigest()
