"""A figure whose kernels run in the page, in WebAssembly.

Modules that are not on disk take a minute or more to compile. Where a reader waits at the page, as in JupyterLab, the
notebook goes on meanwhile: the figure has the modules when they are ready, and says until then what is going on. A
notebook without a reader, as run by Papermill, waits for them, or what it saves would lack them.
"""

import os
import threading
import time
from importlib import resources

from neorl.browser import wasm
from neorl.browser.figure import Figure
from neorl.common.extras import require

traitlets = require("traitlets", extra="wasm")


def text_of(*names):
    """The content of text files beside this one, one after the other."""
    return "\n".join((resources.files(__package__) / name).read_text(encoding="utf-8") for name in names)


class Living(Figure):
    """A `Figure` with the engine of `engine.js` and the WebAssembly modules `MODULES`."""

    MODULES = tuple(wasm.MODULES)
    _engine = traitlets.Unicode(text_of("machine.js", "views.js", "changing.js", "engine.js")).tag(sync=True)
    _wasm = traitlets.Dict().tag(sync=True)
    _layout = traitlets.Dict().tag(sync=True)
    _compiling = traitlets.Dict().tag(sync=True)  # {"since": in seconds from 1970}, or {"failed": why}

    def __init__(self, **traits):
        found = wasm.modules() if not _has_reader() else wasm.found()
        super().__init__(_wasm=self._own(found), _layout={name: wasm.layout(name) for name in self.MODULES},
                         _compiling={} if found else {"since": time.time()}, **traits)
        if not found:
            threading.Thread(target=self._compile, daemon=True).start()

    def _own(self, modules):
        return {name: modules[name] for name in self.MODULES if name in modules}

    def _compile(self):
        try:
            self._wasm = self._own(wasm.modules())
        except Exception as error:  # nobody could catch it
            self._compiling = {"failed": str(error)}


def _has_reader():
    """Whether this is the kernel of a session of Jupyter's server, which names it so."""
    return "JPY_SESSION_NAME" in os.environ
