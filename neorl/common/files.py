"""Files that are complete or absent, even if the process is killed while writing them, and the cache folder.

Whatever takes long to compute is kept in one folder, `cache_folder`; all of it may be deleted at any time. What a
killed process left unfinished is removed by a later one.
"""

import contextlib
import functools
import hashlib
import os
import time
import uuid
from pathlib import Path

import platformdirs

DIGEST_BYTES = hashlib.sha256().digest_size
UNFINISHED = (".neorl-", ".tmp")  # prefix and suffix of the name of a file being written
STALE_SECONDS = 3_600  # since the last write: by then no process is still writing
CHECKOUT = Path(__file__).resolve().parents[2]  # of neorl, unless it is installed


def cache_folder():
    """The folder of files that may be deleted at any time: an absolute `pathlib.Path`.

    It is named by the environment variable ``NEORL_CACHE``. Without it, it is ``.cache`` of the clone that neorl is
    imported from, or else the user's cache folder. A relative name counts from where the command was given, which
    shells leave in ``PWD``: the kernel of a notebook, which runs in another folder, finds the same one.
    Raises OSError if the user has no such folder.
    """
    if named := os.environ.get("NEORL_CACHE"):
        began_in = os.environ.get("PWD", "")
        return Path(began_in if os.path.isdir(began_in) else "", os.path.expanduser(named)).absolute()
    if (CHECKOUT / "notebooks" / "companion").is_dir():
        return CHECKOUT / ".cache"
    try:
        return platformdirs.user_cache_path("neorl-companion")
    except RuntimeError as error:
        raise FileNotFoundError("NEORL_CACHE must name a folder, since this user has no home folder") from error


def write_whole(path, content):
    """Write bytes to a file that is complete or absent at any time, or to the one that a link stands for.

    Raises OSError, which names the file, and then leaves nothing behind.
    """
    path = Path(os.path.realpath(path))
    if path.is_dir():
        raise IsADirectoryError(f"{path} must be a file, but is a folder: add a name for a file in it")
    path.parent.mkdir(parents=True, exist_ok=True)
    _remove_stale(path.parent)
    prefix, suffix = UNFINISHED
    unfinished = path.parent / f"{prefix}{uuid.uuid4().hex}{suffix}"  # `tempfile` would deny other users access
    try:
        with open(unfinished, "xb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        os.replace(unfinished, path)
    except BaseException as error:
        with contextlib.suppress(OSError):
            os.unlink(unfinished)
        if isinstance(error, OSError) and error.errno:
            raise OSError(error.errno, error.strerror, str(path)) from error  # which names no temporary file
        raise


@functools.cache  # it goes through the whole folder, so once per process is enough
def _remove_stale(folder):
    """Remove the unfinished files of killed processes from a folder."""
    with contextlib.suppress(OSError):
        for path in folder.glob("*".join(UNFINISHED)):
            if time.time() - path.stat().st_mtime > STALE_SECONDS:
                path.unlink()


def write_checked(path, content):
    """Write bytes to a file, preceded by their digest."""
    write_whole(path, hashlib.sha256(content).digest() + content)


def read_checked(path):
    """The bytes written by `write_checked`, or None if the file is missing or damaged."""
    try:
        content = path.read_bytes()
    except OSError:
        return None
    return content[DIGEST_BYTES:] if hashlib.sha256(content[DIGEST_BYTES:]).digest() == content[:DIGEST_BYTES] else None
