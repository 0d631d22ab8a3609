"""Files that are complete or absent, whatever moment the process is killed at."""

import os
import tempfile
from pathlib import Path


def write_whole(path, content):
    """Write bytes to a file that others see complete or not at all."""
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.NamedTemporaryFile(dir=path.parent, prefix=".", delete=False) as file:
        file.write(content)
        file.flush()
        os.fsync(file.fileno())
    os.replace(file.name, path)
