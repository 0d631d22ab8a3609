"""Small things that all rooms use: checks of arguments, files, warnings, optional packages, a container's limits."""

import numpy

if int(numpy.__version__.partition(".")[0]) < 2:
    raise ImportError(f"neorl must have numpy 2.0 or later, but {numpy.__file__} is of {numpy.__version__}: update it, "
                      "or install neorl into an environment of its own")
