"""Tables and sentences of the page "Performance", in Markdown.

`python -m lib.performance.report` measures everything and prints the page's main numbers.
"""

import sys

from lib.performance import bandwidth, bound, contest, growth
from lib.shared.wording import listed, number, table

AIM = 2  # times the bound


def summary(loops, bandwidths, rivals, worlds):
    """The page's result in a paragraph."""
    ratios = {name: loop.ratio(bandwidths).value for name, loop in loops.items()}
    within = [name for name, ratio in ratios.items() if ratio <= AIM]
    least, most = min(ratios.values()), max(ratios.values())
    quickest, slowest = (of(loop.loop.min() for loop in loops.values()) for of in (min, max))
    several = " and ".join(f"{_times(ratio.value)} ({name})" for name, ratio in rivals.ratios.items())
    original = "".join(f" {name} takes {_times(ratio.value)} times as long for a step of the world." for name, ratio in
                       worlds.ratios.items())
    return (f"On this machine one core takes {_seconds(quickest)} to {_seconds(slowest)} for a step of world and "
            f"agent. That is {least:.1f} to {most:.1f} times the lower bound set by world and memory; "
            f"the aim of at most {AIM} is met by {' and '.join(within) or 'none'}. The agent's part with one map of "
            f"23 × 23 cells (N23) takes longer in other implementations, by a factor of {several}.{original}")


def bound_table(loops, bandwidths):
    """Each loop beside its bound."""
    return table(
        ["agent", "changes of cell per step", "bytes per step", "working set", "world", "moving bytes", "loop",
         "loop / bound"],
        [[name, number(loop.moved.changes), f"{loop.moved.bytes:,.0f}",
          whole(f"{loop.moved.working_set / 2**20:.1f} MiB"), whole(_seconds(loop.world.min())),
          whole(_seconds(loop.moving(bandwidths))), whole(_seconds(loop.loop.min())),
          _interval(loop.ratio(bandwidths)).replace(", ", whole(", "))] for name, loop in loops.items()])


def spent_table(spent):
    """Where the time of a step goes. spent: as `lib.performance.bound.spent` returns it."""
    parts = list(next(iter(spent.values())))
    return table(["agent", *parts],
                 [[name, *(whole(_seconds(of[part])) for part in parts)] for name, of in spent.items()])


def contest_table(*contests):
    """The time of each implementation, and its ratio to the package."""
    rows = [[each.what, name, whole(_seconds(seconds.min())),
             _interval(each.ratios[name]) if name in each.ratios else "1"]
            for each in contests for name, seconds in each.seconds.items()]
    return table(["task", "implementation", "time", "times as long"], rows)


def absent(*contests):
    """Which rivals are not installed, as a sentence, or nothing."""
    names = [name for each in contests for name in each.absent]
    return f"Not installed here, and so not measured: {listed(names)}." if names else ""


def growth_table(series):
    """Exponents, predicted and fitted."""
    return table(["cost", "grows with", "predicted exponent", "fitted"],
                 [[each.cost, each.of, f"{'at most ' if each.at_most else ''}{each.predicted}", str(each.exponent)]
                  for each in series])


def minutes_table(pages):
    """Where the book's build time goes, or a sentence that no page was computed."""
    if not pages:
        return "No page of the book has been computed here, so there are no times to show."
    parts = ("starting", "importing", "computing", "drawing", "total")
    rows = [[page.page, *(f"{getattr(page, part):,.0f}" for part in parts)] for page in pages]
    sums = [f"{sum(getattr(page, part) for page in pages):,.0f}" for part in parts]
    return table(["seconds of the page", *parts], [*rows, ["all pages", *sums]])


def _times(ratio):
    return f"{ratio:,.1f}" if ratio < 100 else f"{ratio:,.0f}"


def _interval(ratio):
    bounds = "" if ratio.low != ratio.low else f" [{_times(ratio.low)}, {_times(ratio.high)}]"
    return f"{_times(ratio.value)}{bounds}"


def whole(text):
    """A text that is not broken in a narrow column."""
    return text.replace(" ", "\N{NO-BREAK SPACE}")


def _seconds(value):
    """A time in a suitable unit."""
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("µs", 1e-6)):
        if value >= size:
            return f"{value / size:.3g} {unit}"
    return f"{value / 1e-9:.3g} ns" if value >= 1e-9 else "less than 1 ns"


def main(rounds=20, steps=20_000):
    """Print the page's main numbers."""
    bandwidths, loops = bandwidth.measure(rounds), bound.measure(steps, rounds)
    contests = contest.agents(steps, rounds), contest.worlds(steps, rounds)
    series = growth.measure(steps, rounds)
    for size, copied, scattered in zip(*bandwidths):
        print(f"{size / 2**10:10,.0f} KiB   copied {copied / 1e9:6.1f} GB/s   scattered {scattered / 1e9:6.1f} GB/s")
    for part in (summary(loops, bandwidths, *contests), bound_table(loops, bandwidths),
                 spent_table(bound.spent(steps, rounds)), contest_table(*contests), growth_table(series)):
        print(f"\n{part}")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
