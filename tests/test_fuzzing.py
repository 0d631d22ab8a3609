"""Public callables with hostile arguments raise a clear error or return a sound value: see `fuzzing`, `public_calls`.

``NEORL_FUZZ=2000 make test ARGS=tests/test_fuzzing.py`` makes that many calls of each, with compiled kernels.
"""

import os
import subprocess
import sys
from pathlib import Path

from public_names import NOTHING_TO_REPLACE, public_names

EXAMPLES = os.environ.get("NEORL_FUZZ")
QUICK = "40"


def test_every_public_name_is_in_the_table():
    from public_calls import TABLE  # here, since it takes long, and all workers import this file

    assert sorted(public_names() - set(TABLE) - NOTHING_TO_REPLACE) == []


def test_hostile_arguments_bring_a_clear_error_or_a_sound_value():
    # A separate process, since a call may end it. A quick run does not compile kernels: an index out of range is then
    # an IndexError, and the many combinations of constants need no compilation.
    environment = os.environ | ({} if EXAMPLES else {"NUMBA_DISABLE_JIT": "1"})
    done = subprocess.run([sys.executable, Path(__file__).with_name("fuzzing.py"), EXAMPLES or QUICK],
                          env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout[-5_000:] + done.stderr[-5_000:]
