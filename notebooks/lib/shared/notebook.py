"""The beginning of every notebook: check its parameters, set the style of its figures."""

import ast
import inspect

from IPython import get_ipython
from IPython.display import Markdown
from matplotlib import pyplot as plt
from matplotlib_inline.backend_inline import set_matplotlib_formats

from neorl import checks
from neorl.core.kernel import function_of
from neorl.drawing.style import use_style

FINEST = 90  # intervals per axis, of the finest map in the thesis


def begin(runs, steps, seed, fewest_steps=1, **others):
    """Check the parameters of a notebook, and set the style of its figures.

    others: further parameters of the notebook, which it checks itself.
    Raises ValueError for anything else, and for a parameter that papermill has injected but the notebook does not have.
    """
    known = {"runs": checks.integer("runs", runs, at_least=1),
             "steps": checks.integer("steps", steps, at_least=fewest_steps),
             "seed": checks.integer("seed", seed, at_least=0), **others}
    for name in injected_names():
        if name not in known:
            raise ValueError(f"a parameter must be one of {', '.join(known)}, but is {name}")
    set_matplotlib_formats("svg")
    plt.switch_backend(plt.get_backend())  # otherwise only the first figure would switch it
    plt.uninstall_repl_displayhook()  # its hook draws all figures of a cell, and displaying them draws them again
    use_style()


def injected_names():
    """The names assigned in the cell that papermill has injected, if there is one."""
    shell = get_ipython()
    cells = shell.user_ns["In"] if shell else []
    injected = [ast.parse(cell) for cell in cells if cell.startswith("# Parameters\n")]
    return [target.id for tree in injected for statement in tree.body for target in statement.targets]


def resolutions(name, given, fewest=1):
    """The resolutions in a parameter of a page: a tuple of integers.

    given: `fewest` different integers or more from 1 to 90, in a list or, as papermill's option -p passes it, in text.
    Raises ValueError for anything else.
    """
    try:
        listed = ast.literal_eval(given) if isinstance(given, str) else given
    except (ValueError, SyntaxError):
        raise checks.error(name, "a list of resolutions", given, "write it as [5, 11]") from None
    found = tuple(checks.integer(name, each, 1, FINEST) for each in checks.several(name, listed))
    if len(set(found)) < max(fewest, len(found)):
        raise checks.error(name, f"a list of {fewest} or more resolutions, all different", given)
    return found


def source(*values):
    """The source code of modules, classes or kernels, as Markdown."""
    sources = [inspect.getsource(function_of(each)) for each in values]
    return Markdown("\n".join(["```python", *sources, "```"]))
