"""Alter saved files."""

import json

import numpy as np


def rewrite(path, forge):
    """Rewrite an npz file after forge(about, kept) has changed its metadata, or its arrays {name: array}."""
    with np.load(path) as file:
        kept = {name: file[name] for name in file.files}
    about = json.loads(str(kept.pop("about")))
    forge(about, kept)
    with path.open("wb") as file:
        np.savez(file, about=np.array(json.dumps(about)), **kept)
