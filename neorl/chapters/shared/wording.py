"""What the text of several pages is made of, in Markdown: tables, lists of names, numbers, what an interval decides."""


def table(header, rows):
    """A Markdown table. header and each of rows: cells, of any kind that has a text."""
    first, *others = (f"| {' | '.join(map(str, cells))} |" for cells in (header, *rows))
    return "\n".join([first, "|---" * len(header) + "|", *others])


def listed(names, nothing="none"):
    """Names with commas between them; without any name, what `nothing` says."""
    return ", ".join(names) or nothing


def number(value, digits=2):
    """A number with so many decimals, and a minus sign in place of a hyphen."""
    return f"{value:z.{digits}f}".replace("-", "−")


def by_interval(estimate, above, below, undecided):
    """One of three texts: whether the interval of an `Estimate` lies above 0, below it, or leaves the sign open."""
    return above if estimate.low > 0 else below if estimate.high < 0 else undecided
