"""Sentences of chapter 4 on value functions towards each cell, and on their sums, in Markdown."""

import numpy as np

from lib.shared.wording import table
from neorl.evidence.statistics import estimate


def overlaps(learned, planned, cosines):
    """Whether the value functions of all cells are orthogonal, and whether they are a basis.

    learned: (runs, goals, cells). planned: (goals, cells). cosines: by the distance between goals, {"learned": (runs,
    distances), "planned": (1, distances), "book's rule": (runs, distances)}, the last if there is such a curve.
    """
    runs, cells = learned.shape[:2]
    neighbours, opposite = (estimate(np.mean, cosines["learned"][:, apart]) for apart in (1, -1))
    independent = np.linalg.matrix_rank(learned) == cells
    said = []
    if opposite.low > 0 or runs < 2:
        said.append(f"They are not orthogonal: neighbours have a cosine of {neighbours}, and even opposite corners of "
                    f"{opposite}.")
    else:
        said.append(f"Neighbours have a cosine of {neighbours}, opposite corners of {opposite}.")
    if opposite.value < cosines["planned"][0, -1]:
        said.append("The learned functions overlap less than the planned ones. A likely reason: a drifting agent "
                    "arrives less reliably, so values fall off faster with distance.")
    said.append(f"But they are *independent* in {independent.sum()} of {runs} agents: the {cells} functions have rank "
                f"{cells}, so none of them is a weighted sum of others. The planned ones are too, with rank "
                f"{np.linalg.matrix_rank(planned)}.")
    if independent.all():
        said.append("So the set is a *basis*, as the thesis says: any function on the "
                    f"{cells} cells is a weighted sum of the {cells}.")
    if independent.any():
        typical = np.median(np.linalg.cond(learned[independent]))
        said.append("The condition number, 1 for orthogonal functions, measures their independence: its median "
                    f"over agents is {typical:,.0f}, and for the planned functions it is "
                    f"{np.linalg.cond(planned):,.0f}.")
    if "book's rule" in cosines:
        near, far = (estimate(np.mean, cosines["book's rule"][:, apart]) for apart in (1, -1))
        said.append(f"By the book's default rule, neighbours have a cosine of {near}, and opposite corners of {far}.")
    return " ".join(said)


def shares_of_plan(compared, feared, by_discount):
    """The return from following the sum, as a fraction of the plan's.

    compared: {(n, m): `Comparison`}, of n desired elements and m feared ones. feared: {m: name}, 0 among them.
    by_discount: as `lib.chapter_4.potentials.compare_discounts` returns it.
    """
    wanted = list(dict.fromkeys(n for n, _ in compared))
    header = ["Desired", *feared.values(), "random actions, none feared"]
    rows = [[n, *(estimate(np.mean, compared[n, m].achieved) for m in feared),
             estimate(np.mean, compared[n, 0].at_random)] for n in wanted]
    said = []
    exact = [str(n) for n in wanted if compared[n, 0].achieved.min() > 1 - 1e-9]
    if exact:
        said.append(f"With {' or '.join(exact)} desired and no feared elements, the sum lost nothing in any placement.")
    shares = [each.achieved.mean() for each in compared.values()]
    drawn, beside = ([each.at_random.mean() for (_, m), each in compared.items() if bool(m) == fears]
                     for fears in (False, True))
    n, m = min(zip(shares, compared))[1]
    said.append(f"Following it earns {_range(shares)} of the plan's return. Random actions earn {_range(drawn)} if no "
                f"element is feared, and otherwise {_range(beside)}. The sum does worst with {n} desired and {m} "
                "feared.")
    others = (f"with γ = {discount:g} it earns " + " and ".join(str(estimate(np.mean, each.achieved)) for each in both)
              for discount, both in by_discount.items())
    said.append(f"The share that the sum earns depends on the discount: for six desired and none feared, and for one "
                f"desired and two feared, {'; '.join(others)}.")
    return ("Return from following the sum, as a fraction of the plan's:\n\n" + table(header, rows) + "\n\n"
            + " ".join(said))


def _range(shares):
    return f"{100 * min(shares):z.0f} to {100 * max(shares):z.0f} %".replace("-", "−")


def largest_weights(weights, rewards):
    """The eight largest weights with which value functions add up to a plan, and the valences, as text.

    weights, rewards: (cells,).
    """
    return "\n".join(f"cell {cell}: weight {weights[cell]:+.2f}, valence {rewards[cell]:+.0f}"
                     for cell in np.argsort(-np.abs(weights))[:8])
