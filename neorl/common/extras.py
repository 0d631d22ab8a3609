"""Packages that only parts of neorl need, imported on use."""

import importlib


def require(module, extra):
    """Import a module by its full name. Raises ImportError naming the extra to install if its package is missing."""
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        if error.name is None or module.split(".")[0] != error.name.split(".")[0]:
            raise
        raise ImportError(f"{error.name} must be installed for this, but is not; pip install "
                          f"'neorl-companion[{extra}]'") from error
