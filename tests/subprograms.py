"""Test files that run as programs of their own, mostly with the compiler switched off."""

import json
import os
import subprocess
import sys


def printed(file, *arguments, jit=False):
    """What a test file prints when it runs as a program, read as JSON."""
    done = subprocess.run([sys.executable, file, *arguments], capture_output=True, text=True,
                          env=os.environ | {"NUMBA_DISABLE_JIT": str(int(not jit))})
    assert done.returncode == 0, done.stdout[-3_000:] + done.stderr[-3_000:]
    return json.loads(done.stdout)
