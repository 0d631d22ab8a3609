"""Sentences and tables on two reference frames, and on the information in the spikes of tuned cells."""

import numpy as np

from lib.chapter_2.further_cells import mistakable
from lib.chapter_2.tuning import SHIFTS
from lib.shared import wording
from neorl.evidence.statistics import estimate

OWN = {"head-direction cell": "direction", "speed cell": "speed"}  # the variable of a cell's modality, if not position
SAME = 1e-9  # lengths that differ by less are equal


def describe_frames(seconds, allocentric, seen, turned):
    """How the vector to a landmark, (steps, 2), changes in two frames while the animal turns, up to second `turned`."""
    spans = [np.ptp(vectors[seconds < turned], axis=0).max() for vectors in (allocentric, seen)]
    apart = np.abs(np.linalg.norm(allocentric, axis=1) - np.linalg.norm(seen, axis=1)).max()
    when = "at every moment" if apart < SAME else f"to within {apart:.1g}"
    return (f"While it turns, the components of the allocentric vector change by {spans[0]:.2f}, and those of the "
            f"egocentric one by up to {spans[1]:.2f}. The distance is the same in both frames {when}.")


def information_table(found):
    """Bits per spike as a Markdown table, bold where they exceed shifted spikes: {cell: {variable: `Information`}}."""
    rows = [[cell, *(f"**{each.bits:.2f}**" if each.clear else f"{each.bits:.2f}" for each in about.values())]
            for cell, about in found.items()]
    return wording.table(["Cell", *next(iter(found.values()))], rows)


def describe_information(found):
    """Which cells inform about their own modality's variable, and which about others. found: as for the table."""
    right, others = 0, []
    for cell, about in found.items():
        own = OWN.get(cell, "position")
        right += about[own].clear and about[own].bits == max(each.bits for each in about.values())
        others += [f"the {cell}'s information about {variable}" for variable, each in about.items()
                   if each.clear and variable != own]
    complete = right == len(found)
    beyond = (f"Beyond that, {', '.join(others)} {'exceeds' if len(others) == 1 else 'exceed'} that of shifted spikes."
              if others else "No other information exceeds that of shifted spikes.")
    return (f"{'All' if complete else right} of the {len(found)} cells are most informative, and above chance, about "
            f"the variable of their own modality{'' if complete else ' in so short a recording'}. {beyond} With "
            f"{SHIFTS} shifts, one in a hundred comparisons does so by chance, and in {2 * len(found)} of the "
            f"comparisons here there is nothing to find"
            + (", unless the animal's path links the variables." if others else ".")
            + (" So each cell informs about the concern of its modality, and hardly about the others."
               if complete and len(others) < 3 else ""))


def describe_sizes(tuned, active):
    """The savings of separate maps: {cell: (`NresMap`, which of its cells)}, {cell: when it is active, (steps,)}."""
    cells = [nres_map.cells for nres_map, _ in tuned.values()]
    joint = wording.scientific(np.prod(cells, dtype=float), 1)
    shares = [100 * np.mean(each) for each in active.values()]
    return (f"Separate maps also save cells. The {len(cells)} maps of this box have {sum(cells)} cells in all. A "
            f"single joint map, with a cell for each combination, would need {joint}. At most a few "
            "cells of each map are active at a time: the cells shown here were active for "
            f"{min(shares):.1f} to {max(shares):.1f} % of the time. Separate maps cannot represent "
            f"combinations: that the animal runs just when it is near a wall, for instance, is in none of them.")


def describe_likeness(found):
    """How alike two maps of each cell are, a line for each: {cell: correlation}."""
    return "\n".join(f"{cell}: correlation of the maps {number:.2f}" for cell, number in found.items())


def describe_modules(scales):
    """The shares of places that a module of the first scale mistakes for distant ones, and modules of all scales."""
    alone, joint = (100 * mistakable(each) for each in (scales[:1], scales))
    return (f"By its phases to a tenth of a period, the module of scale {scales[0]:g} takes {alone:.0f} % of the "
            f"places in the box for some place elsewhere in it; the {len(scales)} modules together {joint:.0f} %.")


def describe_drift(errors):
    """The mean errors of path integration at a quarter of the time and at its end, {name: (runs, steps)}."""
    said = []
    for name, each in errors.items():
        early, late = (estimate(np.mean, each[:, step]) for step in (each.shape[1] // 4 - 1, -1))
        said.append(f"from {early} to {late} with the *{name}*" if name == "sum alone" else f"from {early} to {late} "
                    f"if it is *{name}*")
    return f"From a quarter of the time to its end, the mean error goes {', and '.join(said)}."
