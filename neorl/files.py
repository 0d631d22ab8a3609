"""Files that are complete or absent, whatever moment the process is killed at, and the folder of those that may go.

What takes long to make is kept in the folder that the environment variable ``NEORL_CACHE`` names, or in the user's
cache folder; all of it may be deleted at any time. What a killed process was writing is removed by a later one.
"""

import contextlib
import functools
import hashlib
import os
import tempfile
import time
from pathlib import Path

import platformdirs

DIGEST_BYTES = hashlib.sha256().digest_size
UNFINISHED = (".neorl-", ".tmp")  # how the name of a file that is being written begins and ends
STALE_SECONDS = 3_600  # since its last byte: no process writes on after that


def cache_folder():
    """Where what may be deleted is kept: a `pathlib.Path`."""
    return Path(os.environ.get("NEORL_CACHE") or platformdirs.user_cache_path("neorl-companion"))


def write_whole(path, content):
    """Write bytes to a file that others see complete or not at all. Raises OSError, and leaves nothing behind then."""
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    _remove_stale(path.parent)
    prefix, suffix = UNFINISHED
    file = tempfile.NamedTemporaryFile(dir=path.parent, prefix=prefix, suffix=suffix, delete=False)
    try:
        with file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        os.replace(file.name, path)
    except BaseException:
        with contextlib.suppress(OSError):
            os.unlink(file.name)
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
