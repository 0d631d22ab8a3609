"""The compiler is off if numba reads its switch so, whatever is written there, and stays as it was."""

import os
import subprocess
import sys

import pytest

from neorl import Policy, Run, WaterWorld, kernel, place_cells
from neorl.kernels.execution import execute
from neorl.kernels.kernel import jit_is_off


@kernel
def doubled(x):
    return 2 * x


@pytest.mark.parametrize("value, config, is_off", [
    (None, None, False), ("", None, False), ("0", None, False), ("1", None, True), ("01", None, True),
    ("True", None, False), ("no", None, False), (None, "disable_jit: 1", True), (None, "disable_jit: 0", False),
    ("0", "disable_jit: 1", False)])  # numbers count; of other texts numba warns, and is on
def test_the_switch_is_read_as_numba_reads_it(tmp_path, value, config, is_off):
    if config:
        (tmp_path / ".numba_config.yaml").write_text(config)
    environment = {name: each for name, each in os.environ.items() if name != "NUMBA_DISABLE_JIT"}
    done = subprocess.run([sys.executable, "-c", READ], cwd=tmp_path, capture_output=True, text=True, check=True,
                          env=environment | ({} if value is None else {"NUMBA_DISABLE_JIT": value}))
    assert done.stdout.split() == [str(is_off)] * 3


READ = """
from neorl.kernels.kernel import Kernel, jit_is_off, kernel
print(not isinstance(kernel(lambda x: x), Kernel), jit_is_off())
import numba
print(bool(numba.config.DISABLE_JIT))
"""


def test_a_switch_that_is_changed_before_numba_is_imported_is_refused():
    done = subprocess.run([sys.executable, "-c", CHANGE], capture_output=True, text=True,
                          env=os.environ | {"NUMBA_DISABLE_JIT": "0"})
    assert done.stderr.splitlines()[-1].startswith("RuntimeError: numba's compiler must stay on, as it was when neorl")


CHANGE = """
import os
from neorl.kernels.execution import execute
from neorl.kernels.kernel import kernel
os.environ["NUMBA_DISABLE_JIT"] = "1"
execute(kernel(lambda x: x), 1)
"""


def test_a_switch_that_is_changed_later_is_refused_by_whatever_uses_a_kernel(monkeypatch):
    import numba

    made = agent, world = place_cells([2]), WaterWorld()
    run = Run(agent, world)
    monkeypatch.setattr(numba.config, "DISABLE_JIT", int(not jit_is_off()))
    for use in (lambda: run.advance(1), lambda: world.reset(0), lambda: execute(doubled, 2), lambda: Run(*made),
                lambda: kernel(lambda x: x), lambda: Policy(choose=len)):
        with pytest.raises(RuntimeError, match="numba's compiler must stay o.*, but numba.config.DISABLE_JIT is . now"):
            use()

