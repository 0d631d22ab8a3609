"""The beginning of every notebook: check its parameters, set the style of its figures."""

import ast
import inspect

from IPython import get_ipython
from IPython.display import Markdown
from matplotlib import pyplot as plt
from matplotlib_inline.backend_inline import set_matplotlib_formats

from companion.page import parameters
from neorl.drawing.style import use_style
from neorl.kernels.kernel import function_of

listed = parameters.listed


def begin(fewest=(), /, **given):
    """Check the parameters of a notebook, and set the style of its figures.

    given: all its parameters, by name. fewest: of this page, see `parameters.check`.
    Raises ValueError for a bad one, and for a name that papermill has injected but the notebook does not have.
    """
    for name in injected_names():
        if name not in given:
            raise ValueError(f"a parameter must be one of {', '.join(given)}, but is {name}")
    parameters.check(fewest, **given)
    set_matplotlib_formats("svg")
    plt.switch_backend(plt.get_backend())  # otherwise only the first figure would switch it
    plt.uninstall_repl_displayhook()  # its hook draws all figures of a cell, and displaying them draws them again
    use_style()


def injected_names():
    """The names assigned in the cell that papermill has injected, if there is one, but for papermill's own."""
    shell = get_ipython()
    cells = shell.user_ns["In"] if shell else []
    injected = [ast.parse(cell) for cell in cells if cell.startswith("# Parameters\n")]
    names = [target.id for tree in injected for statement in tree.body for target in statement.targets]
    return [name for name in names if not name.startswith("PAPERMILL_")]


def source(*values):
    """The source code of modules, classes or kernels, as Markdown."""
    sources = [inspect.getsource(function_of(each)) for each in values]
    return Markdown("\n".join(["```python", *sources, "```"]))
