"""What was recorded of agents that watch recordings, for tables and words: it needs neither OGBench nor RatInABox.

1. `benchmark.csv`, of the point mazes, and `rat.csv` are written by the programs of these names; `paths.csv` by the
   former.
2. `published.csv` has the best of OGBench's six baselines for each data set, mean and standard deviation over eight
   seeds, as others' tables quote arXiv 2410.20092 v2.
3. A success is a share of the episodes of all goals, in percent; ± is the standard deviation over data seeds.
"""

import csv
import functools
from pathlib import Path

import numpy as np
from IPython.display import HTML

from companion.page.recorded import STYLE
from companion.recordings import choosing

FOLDER = Path(__file__).parent
WANTED = 95  # percent, of the search
NEAR = 1.01  # units, of the benchmark's goals, as rounded
PILOTS = "in line", "graph, in line", "out of line", "graph, out of line"


@functools.cache
def rows_of(name):
    """The rows of a table as dictionaries of texts."""
    with (FOLDER / name).open(newline="") as file:
        return tuple(csv.DictReader(file))


def success(row):
    """The success of a row in percent."""
    return 100 * np.mean([int(count) for count in row["successes"].split()]) / int(row["episodes"])


def successes(part, name, pilot):
    """The success in percent of all rows of a part, for a data set and a pilot."""
    return np.array([success(row) for row in rows_of("benchmark.csv")
                     if (row["part"], row["name"], row["pilot"]) == (part, name, pilot)])


def names(part="table"):
    """The data sets in a part, in the order of the table."""
    return list(dict.fromkeys(row["name"] for row in rows_of("benchmark.csv") if row["part"] == part))


def data_seeds():
    """How many data seeds the table has."""
    return len({row["seed"] for row in rows_of("benchmark.csv") if row["part"] == "table"})


def short(name):
    """A data set's name as a page shows it."""
    _, maze, kind, _ = name.split("-")
    return f"{maze}, {kind}"


def spread(sample):
    """A mean and its standard deviation over data seeds, if there are two or more."""
    mean = f"{np.mean(sample):.0f}"
    return f"{mean}\u00a0±\u00a0{np.std(sample, ddof=1):.0f}" if len(sample) > 1 else mean


def table():
    """The rows of the table of data sets: the published best, then each pilot."""
    published = {row["name"]: f"{row['mean']}\u00a0±\u00a0{row['deviation']}" for row in rows_of("published.csv")}
    return [[short(name), published[name], *(spread(successes("table", name, pilot)) for pilot in PILOTS)]
            for name in names()]


def seconds():
    """The least and the most seconds of learning of agents in the table."""
    taken = [float(row["seconds"]) for row in rows_of("benchmark.csv")
             if row["part"] == "table" and "graph" not in row["pilot"]]
    return min(taken), max(taken)


def scans():
    """Success against the offset of the box, {data set: {pilot: (offsets in units, successes in percent)}}."""
    points = {}
    for row in rows_of("benchmark.csv"):
        if row["part"] == "offsets":
            pilot = "graph" if "graph" in row["pilot"] else "agent"
            points.setdefault(short(row["name"]), {}).setdefault(pilot, []).append((float(row["offset"]), success(row)))
    return {name: {pilot: np.transpose(pairs) for pilot, pairs in pilots.items()} for name, pilots in points.items()}


def offset_rows(scanned):
    """A row for each data set: the least success and the mean over offsets, of the agent and of the graph."""
    return [[name, *(f"{statistic(pilots[pilot][1]):.0f}" for pilot in ("agent", "graph")
                     for statistic in (np.min, np.mean))] for name, pilots in scanned.items()]


def offsets_in_words(scanned):
    """The least success over all data sets and offsets."""
    agent, graph = (min(pilots[pilot][1].min() for pilots in scanned.values()) for pilot in ("agent", "graph"))
    return f"The least is {agent:.0f} % for the agent, and {graph:.0f} % for the graph."


def ablation_rows():
    """A row for each changed choice: the mean success over the data sets, the least, and where."""
    changed = dict.fromkeys(row["pilot"] for row in rows_of("benchmark.csv") if row["part"] == "ablations")
    rows = []
    for choice in changed:
        by_name = {name: successes("ablations", name, choice)[0] for name in names("ablations")}
        worst = min(by_name, key=by_name.get)
        rows.append([choice, f"{np.mean(list(by_name.values())):.0f}", f"{by_name[worst]:.0f}", short(worst)])
    return rows


def ahead():
    """On how many data sets the agent in line beats the best baseline, and on how many the graph does as well as it."""
    published = {row["name"]: float(row["mean"]) for row in rows_of("published.csv") if row["name"] in names()}
    means = {pilot: {name: successes("table", name, pilot).mean() for name in published} for pilot in PILOTS}
    return (sum(means["in line"][name] > published[name] for name in published),
            sum(means["graph, in line"][name] >= means["in line"][name] for name in published))


def search_rows():
    """A row for each candidate of the search: its fields, the least success and the mean, and whether it was chosen."""
    rows, rows_of_search = [], choosing.read()
    for candidate in choosing.CANDIDATES:
        sample = choosing.successes(rows_of_search, candidate, choosing.TRIED)
        rows.append([*candidate, f"{min(sample):.0f}", f"{np.mean(sample):.0f}",
                     "chosen" if candidate == choosing.chosen(rows_of_search) else ""])
    return rows


def fresh_rows():
    """A row for each data set: the least success and the mean at fresh offsets, of what was chosen and of the pair."""
    rows = choosing.read()
    samples_of = {name: [choosing.successes(rows, candidate, choosing.FRESH, [name])
                         for candidate in (choosing.chosen(rows), choosing.PLAIN)] for name in names()}
    return [[short(name), *(f"{statistic(sample):.0f}" for sample in samples for statistic in (np.min, np.mean))]
            for name, samples in samples_of.items()]


def search_in_words():
    """Whether the least success of what was chosen is above the level that was wanted, without portals."""
    rows = choosing.read()
    walled = [name for name in names() if "teleport" not in name]
    sample = choosing.successes(rows, choosing.chosen(rows), choosing.FRESH, walled)
    return (f"The least of what was chosen over the sets without portals and {len(choosing.FRESH)} fresh offsets is "
            f"{min(sample):.0f} %, {'above' if min(sample) > WANTED else 'not above'} the {WANTED} % that were wanted.")


def maze_ways():
    """Squares of a maze that are walls, (walls, 2), and for each goal the way of an agent and the goal, in units."""
    kinds = {}
    for row in rows_of("paths.csv"):
        kinds.setdefault((row["kind"], int(row["number"])), []).append((float(row["x"]), float(row["y"])))
    walls = np.array([place for (kind, _), places in kinds.items() if kind == "wall" for place in places])
    ways = [(np.array(places), kinds["goal", number][0]) for (kind, number), places in kinds.items() if kind == "way"]
    return walls, ways


def arrivals_in_words(ways):
    """How many of some ways in the maze arrive."""
    arrived = sum(np.linalg.norm(way[-1] - goal) <= NEAR for way, goal in ways)
    return f"{arrived} of {len(ways)} arrive."


def answer():
    """The answer of the page, as HTML."""
    rat = {row["watched"]: row for row in rows_of("rat.csv")}
    share = {name: 100 * int(row["arrived"]) / int(row["ways"]) for name, row in rat.items()}
    ten, graph = "10 minutes", "graph, 10 minutes"
    more, equal = ahead()
    words = (
        f"Having only watched ten minutes of a rat, an agent reaches <strong>{share[ten]:.3g} %</strong> of random "
        f"places, in {float(rat[ten]['times']):.1f} times the time of a straight line; untrained, it reaches "
        f"{share['nothing']:.3g} %. A graph of the same moves, without values, reaches {share[graph]:.3g} %. On "
        f"{more} of {len(names())} data sets of a maze benchmark the agent succeeds more often than the best published "
        "baseline, if its cells are in line with the walls; the graph succeeds at least as often as the agent on "
        f"{equal}.").replace(" %", "\u00a0%")
    return HTML(f'<div class="recorded"><style>{STYLE.read_text("utf-8")}</style><p class="sentence">{words}</p></div>')
