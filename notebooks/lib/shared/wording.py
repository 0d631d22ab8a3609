"""Building blocks of text in Markdown: tables, lists of names, numbers, phrases selected by an interval."""


def table(header, rows):
    """A Markdown table from a header and rows, each a sequence of cells of any type that converts to text."""
    first, *others = (f"| {' | '.join(map(str, cells))} |" for cells in (header, *rows))
    return "\n".join([first, "|---" * len(header) + "|", *others])


def listed(names, nothing="none"):
    """Names separated by commas, or `nothing` if there are none."""
    return ", ".join(names) or nothing


def of_all(count, total):
    """How many of a total, as text: "all 8", or "2 of the 8"."""
    return f"all {total}" if count == total else f"{count} of the {total}"


def number(value, digits=2):
    """A number with `digits` decimals, and a minus sign in place of a hyphen."""
    return f"{value:z.{digits}f}".replace("-", "−")


def scientific(value, digits=0):
    """A number above 0 with `digits` decimals as a multiple of a power of ten, in Markdown; 0 as "0"."""
    factor, power = f"{value:.{digits}e}".split("e")
    return f"{factor} × 10<sup>{int(power)}</sup>".replace("-", "−") if value else "0"


def by_interval(estimate, above, below, undecided):
    """One of three texts, by whether the interval of an `Estimate` lies above 0, below it, or leaves the sign open."""
    return above if estimate.low > 0 else below if estimate.high < 0 else undecided
