"""Saved files: altered, or shared by the caches of tests."""

import json

import numpy as np

from neorl.common import files
from neorl.common.array_files import write_arrays


def share_compiled(folder):
    """Link to what the cache has compiled, and to the lock of doing so, from an empty folder for another cache."""
    cache = files.cache_folder().resolve()
    for name in ("compiled", "wasm"):
        (cache / name).mkdir(parents=True, exist_ok=True)
    (cache / "wasm.lock").touch()
    for name in ("compiled", "wasm", "wasm.lock"):
        (folder / name).symlink_to(cache / name)


def contents(path):
    """The metadata of a file, and its arrays {name: array}."""
    with np.load(path) as file:
        arrays = {name: file[name] for name in file.files if name != "digest"}
    return json.loads(str(arrays.pop("about"))), arrays


def rewrite(path, forge, into=None):
    """Write a file again, with its digest, after forge(about, arrays) has changed its content."""
    about, arrays = contents(path)
    forge(about, arrays)
    write_arrays(into or path, about.pop("is", "nothing"), about, arrays)
