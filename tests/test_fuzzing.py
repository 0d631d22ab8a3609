"""Every public name with hostile arguments: a clear error or a sound value. See `fuzzing` and `public_names`.

``NEORL_FUZZ=2000 make test ARGS=tests/test_fuzzing.py`` makes that many calls of each name, with kernels as they are.
"""

import os
import subprocess
import sys
from pathlib import Path

from public_names import NOTHING_TO_REPLACE, TABLE, public_names

EXAMPLES = os.environ.get("NEORL_FUZZ")
QUICK = "40"


def test_every_public_name_is_in_the_table():
    assert sorted(public_names() - set(TABLE) - NOTHING_TO_REPLACE) == []


def test_hostile_arguments_bring_a_clear_error_or_a_sound_value():
    # In a process of its own, which may end as a whole. In a quick run kernels are not compiled: an index out of range
    # is an IndexError then, and there are many combinations of constants to compile for.
    environment = os.environ | ({} if EXAMPLES else {"NUMBA_DISABLE_JIT": "1"})
    done = subprocess.run([sys.executable, Path(__file__).with_name("fuzzing.py"), EXAMPLES or QUICK],
                          env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout[-5_000:] + done.stderr[-5_000:]
