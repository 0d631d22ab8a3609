"""What the page of paper C computes and reports: its four networks, and how strongly the last of them recurs.

The paper prints an order of four curves and no numbers, so ours stand beside Brownian motion and beside one another.
"""

from dataclasses import replace

import numpy as np

from neorl.evidence.reading import conditions
from neorl.evidence.report import SIGNS
from neorl.evidence.statistics import estimate
from neorl.evidence.verdict import FINAL, RUNS_FOR_A_VERDICT, VERDICTS
from neorl.experiments.sweep import sweep

NETWORKS = tuple("ABCD")


def live(readings, steps, runs, seed=0):
    """The results of networks A to D, and of Brownian motion, under each reading: {name: {key: Result}}.

    readings: {name: Reading}. steps, runs, seed, and the keys: as in `conditions`.
    """
    made = {(name, key): condition for name, reading in readings.items()
            for key, condition in conditions(reading, steps, runs, seed, groups=("networks",)).items()}
    results = dict(zip(made, sweep(list(made.values()))))
    return {name: {key: result for (of, key), result in results.items() if of == name} for name in readings}


def networks(results):
    """The networks among the results of one reading: {"A": Result, …}."""
    return {name: results["network", name] for name in NETWORKS}


def recur(readings, weights, steps, runs, seed=0):
    """The results of network D over its weight of recursion: {name: [Result for each weight]}.

    readings: {name: Reading}. weights: numbers; with 0, D is C. steps, runs, seed: as in `conditions`, but that there
    are 10 runs at most of what `live` does not have.
    """
    made = {}
    for name, reading in readings.items():
        for weight in weights:
            some = runs if weight in (0, reading.recursion) else min(runs, RUNS_FOR_A_VERDICT)
            found = conditions(replace(reading, recursion=weight), steps, some, seed, groups=("networks",))
            made[name, weight] = found["network", "D" if weight else "C"]
    results = dict(zip(made, sweep(list(made.values()))))
    return {name: [results[name, weight] for weight in weights] for name in readings}


def in_words(results, judged):
    """What was found under one reading, in Markdown: verdicts, and the numbers behind them.

    results: of the reading, as `live` has them. judged: its claims.
    """
    by_verdict = {verdict: ", ".join(claim.name for claim in judged if claim.verdict == verdict)
                  for verdict in VERDICTS}
    verdicts = "; ".join(f"{SIGNS[verdict]} {verdict}: {names}" for verdict, names in by_verdict.items() if names)
    final = {name: result.rate(*FINAL).mean() for name, result in networks(results).items()}
    order = " < ".join(f"{name} ({_number(final[name])})" for name in sorted(final, key=final.get))
    return (f"{verdicts}. By reward per second in the last fifth of a run the order is {order}, where the thesis has "
            f"A < B < C ≪ D; Brownian motion earns {_number(results['brownian', 3].rate().mean())}.")


def final_rates(by_reading):
    """What networks finally earn and take under each reading, as a Markdown table: {name: results as `live` has them}.
    """
    rows = ["| Network | Reading | Reward per second | Green a minute | Red a minute |", "|---|---|---|---|---|"]
    for network in NETWORKS:
        for name, results in by_reading.items():
            result = results["network", network]
            green, red = 60 * result.hit_rate(*FINAL).mean(axis=0)
            rows.append(f"| {network} | {name} | {estimate(np.mean, result.rate(*FINAL))} | {green:.1f} | {red:.1f} |")
    return "\n".join(rows)


def _number(value):
    return f"{value:z.2f}".replace("-", "−")
