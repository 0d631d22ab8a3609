"""The package as it is installed, in an environment of its own; ``make package`` runs this on every system.

    python tests/installation.py WHEEL ARGUMENTS…    WHEEL may be "", for one that is built here

First the wheel alone: README's first example prints what it says, every module either imports or names the extra that
it needs, and the WebAssembly modules that the wheel carries are those of its sources. Then the wheel with `EXTRAS`: the
tests in `FOLDERS`, with ARGUMENTS for pytest. All of this runs in another folder, so that the installation is tested.
With VERSIONS=oldest in the environment, what is installed is of the oldest versions that ``pyproject.toml`` allows.
"""

import os
import subprocess
import sys
import tempfile
import tomllib
import venv
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
EXTRAS = "plot,wasm,gym,data,cluster"
FOLDERS = [str(ROOT / "tests" / name) for name in ("kernels", "core", "worlds", "agents", "experiments")]
ALONE = """
import contextlib, importlib, io, pkgutil, re, sys
from pathlib import Path
root = Path(sys.argv[1])
import neorl
assert root not in Path(neorl.__file__).parents, neorl.__file__
example = re.search("```python\\n(.*?)```", (root / "README.md").read_text(encoding="utf-8"), re.DOTALL)[1]
with contextlib.redirect_stdout(io.StringIO()) as printed:
    exec(example, {})
assert printed.getvalue().splitlines() == re.findall("# → (.*)", example), printed.getvalue()
needing = {}
for module in pkgutil.walk_packages(neorl.__path__, "neorl."):
    if module.name != "neorl.__main__":
        try:
            importlib.import_module(module.name)
        except ImportError as error:
            needing[module.name] = str(error)
assert all("pip install 'neorl-companion[" in error for error in needing.values()), needing
from neorl.browser import wasm
carried = [path for path in wasm.SHIPPED.values() if path.exists()]
assert not carried or list(wasm.modules()) == list(wasm.MODULES)
print(f"without extras: README's example, and all modules but {', '.join(needing)}; {len(carried)} in WebAssembly")
"""


def oldest():
    """The lower bounds of the dependencies, those of `EXTRAS` included, as pins."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    extras = [each for extra in EXTRAS.split(",") for each in project["optional-dependencies"][extra]]
    return [each.replace(">=", "==") for each in (*project["dependencies"], *extras) if ">=" in each]


def main(wheel, *arguments):
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    environment.setdefault("NEORL_CACHE", str(ROOT / ".cache"))  # has compiled kernels
    with tempfile.TemporaryDirectory() as folder:
        def run(*command):
            subprocess.run(list(map(str, command)), check=True, cwd=folder, env=environment)

        venv.create(Path(folder, "venv"), with_pip=True)
        python = Path(folder, "venv", "Scripts" if os.name == "nt" else "bin", "python")
        if not wheel:
            run(python, "-m", "pip", "wheel", "--quiet", "--no-deps", "--wheel-dir", folder, ROOT)
            (wheel,) = Path(folder).glob("*.whl")
        constraints = Path(folder, "constraints.txt")
        constraints.write_text("\n".join(oldest() if os.environ.get("VERSIONS") == "oldest" else []))
        install = python, "-m", "pip", "install", "--quiet", "--no-compile", "--constraint", constraints
        wheel = Path(wheel).resolve()
        run(*install, wheel)
        run(python, "-c", ALONE, ROOT)
        run(*install, f"{wheel}[{EXTRAS}]", "pytest", "hypothesis")
        run(python, "-m", "pytest", *FOLDERS, *arguments)


if __name__ == "__main__":
    try:
        main(*sys.argv[1:])
    except subprocess.CalledProcessError as error:
        sys.exit(error.returncode)
