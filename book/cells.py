"""The cells of a built page: those of its notebook, in their order.

The parameters show the values used for the page, and the cell that papermill injects is left out.
"""

import re

PARAMETERS, INJECTED = "parameters", "injected-parameters"


def of_page(cells, values):
    """The cells of a computed notebook as its page shows them. values: of its parameters, {name: value}."""
    kept = [each for each in cells if INJECTED not in tags(each)]
    for cell in kept:
        if PARAMETERS in tags(cell):
            cell.source = with_values(cell.source, values)
    return kept


def tags(cell):
    """The tags of a cell, a set."""
    return set(cell.metadata.get("tags", ()))


def with_values(source, values):
    """The source of a cell of parameters, ``name: type = default  # comment``, with other values for the defaults.

    Raises ValueError for a name that is not there.
    """
    for name, value in values.items():
        shown = f"{value:_}" if isinstance(value, int) else repr(value)
        source, found = re.subn(rf"^({name}: \w+ = ).*?(?=\s*(#|$))", rf"\g<1>{shown}", source, flags=re.MULTILINE)
        if not found:
            raise ValueError(f"a parameter must be one of the notebook's, but is {name}")
    return source
