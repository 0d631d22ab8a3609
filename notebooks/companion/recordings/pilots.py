"""Pilots, who push a walker to a goal by what was learned from a recording. Places are in the unit square."""

import numpy as np

from neorl import Agent, Desire, Learner, Learning, Node, Scene, modality

PASSES = 8
LEARNING = Learning(0.02, 0.9, credit="share")


def pupil(path, resolutions, *, ends=(), actions=None, learning=LEARNING, own_cell="silent"):
    """A `Learner` that has watched a path eight times, and learns no more. It desires a thing of the kind "goal"."""
    agent = Agent([Node("PC", modality.PLACE_CELL, resolutions)], [Desire("goal", "PC", 1.0)], learning,
                  own_cell=own_cell)
    learner = Learner(agent, things=1, kinds=["goal"])
    for _ in range(PASSES):
        learner.watch(path, actions, ends=ends, progress=False)
    learner.learns = False
    return learner


def towards_thing(learner, steering="vector"):
    """A pilot by the desire vector of a `pupil`: scaled, as it is ("unscaled"), or its "best" action alone."""
    def to(goal):
        def push(place):
            scene = Scene(place, things=[goal], kinds=["goal"])
            if steering == "best":
                q = learner.output("PC", scene).q
                return np.array(learner.world.actions.pushes[int(q.argmax())]) * q.any()
            return learner.output("PC", scene, normalised=steering == "vector").desire
        return push
    return to


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
