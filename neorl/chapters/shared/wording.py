"""What the text of several pages is made of, in Markdown: tables, and lists of names."""


def table(heads, rows):
    """A table in Markdown. heads: what stands above each column. rows: the cells of each row, as text."""
    lines = [heads, *rows]
    head, *others = (f"| {' | '.join(cells)} |" for cells in lines)
    return "\n".join([head, "|---" * len(heads) + "|", *others])


def listed(names, nothing="none"):
    """Names with commas between them; without any name, what `nothing` says."""
    return ", ".join(names) or nothing
