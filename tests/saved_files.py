"""Saved files: altered, or shared by the caches of tests."""

import json

import numpy as np

from neorl.common import files


def share_compiled(folder):
    """Link to what the cache has compiled, and to the lock of doing so, from an empty folder for another cache."""
    cache = files.cache_folder().resolve()
    for name in ("compiled", "wasm"):
        (cache / name).mkdir(parents=True, exist_ok=True)
    (cache / "wasm.lock").touch()
    for name in ("compiled", "wasm", "wasm.lock"):
        (folder / name).symlink_to(cache / name)


def rewrite(path, forge):
    """Rewrite an npz file after forge(about, kept) has changed its metadata, or its arrays {name: array}."""
    with np.load(path) as file:
        kept = {name: file[name] for name in file.files}
    about = json.loads(str(kept.pop("about")))
    forge(about, kept)
    with path.open("wb") as file:
        np.savez(file, about=np.array(json.dumps(about)), **kept)
