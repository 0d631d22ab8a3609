"""The build step that pyproject.toml cannot express: a wheel carries the WebAssembly module, ready to run."""

import os
import subprocess
import sys

from setuptools import setup
from setuptools.command.build_py import build_py


class BuildWithModule(build_py):
    def run(self):
        super().run()
        if not self.editable_mode:
            package = os.path.abspath(os.path.join(self.build_lib, "neorl"))
            ship = "import sys; from neorl.browser import wasm; wasm.ship(sys.argv[1])"
            path = os.pathsep.join([os.path.dirname(package), *sys.path])
            subprocess.run([sys.executable, "-c", ship, package], env=os.environ | {"PYTHONPATH": path}, check=True)


setup(cmdclass={"build_py": BuildWithModule})
