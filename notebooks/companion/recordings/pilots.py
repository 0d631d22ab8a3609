"""Pilots, who push a walker to a goal by what was learned from a recording. Places are in the unit square."""

import numpy as np

from neorl import Scene


def by_desire(learner):
    """A pilot that follows the desire vector of a learner's place cells."""
    def to(goal):
        learner.want(goal)
        return lambda place: learner.output("PC", Scene(place), normalised=True).desire
    return to


def by_graph(path, n, ends=False):
    """A pilot without values: the fewest moves between n × n cells among those that a path made, found breadth first.

    ends: whether each step, (steps,), is no move, since frames are missing.
    """
    def cell(place):
        x, y = np.minimum((np.asarray(place) * n).astype(int), n - 1).T
        return x + n * y

    cells = cell(path)
    moved = (cells[1:] != cells[:-1]) & ~np.asarray(ends, bool)
    before = {}  # the cells from which each was entered
    for left, entered in sorted({*zip(cells[:-1][moved].tolist(), cells[1:][moved].tolist())}):
        before.setdefault(entered, []).append(left)

    def to(goal):
        onward, edge = {int(cell(goal)): None}, [int(cell(goal))]
        for entered in edge:
            new = [left for left in before.get(entered, ()) if left not in onward]
            onward.update(dict.fromkeys(new, entered))
            edge += new

        def push(place):
            following = onward.get(int(cell(place)))
            if following is None:
                return np.zeros(2)
            ahead = (np.array([following % n, following // n]) + 0.5) / n - place
            return ahead / np.abs(ahead).max()
        return push
    return to
