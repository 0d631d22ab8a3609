"""Does latent learning depend on our choices? The experiment with one of them changed at a time.

The choices are the rates of learning and exploration of all kinds of animal, the order of turns, and the number of
places from one choice point to the next; an exercise also varies the day of the first meal.
"""

from lib.chapter_2.latent_learning import LEARNERS, Animal, compare_learners, judge, simulate_groups
from lib.chapter_2.maze import Maze, random_maze

RATES = {"learning_rate": ("α", (0.01, 1.0)), "discount": ("γ", (0.5, 0.99)), "exploration": ("ε", (0.0, 0.3)),
         "trace": ("λ", (0.0, 0.5))}  # fields of `Animal`: symbol, and values other than the default


def settings(maze):
    """The settings, the unchanged one first: {name: (changed fields of `Animal`, `Maze`)}."""
    rates = {f"{symbol} {value:g}": ({rate: value}, maze) for rate, (symbol, values) in RATES.items()
             for value in values}
    orders = {f"turns {name}": ({}, random_maze(order)) for order, name in enumerate("AB")}
    places = {f"{places} places per unit": ({}, Maze(alley=places - 1)) for places in (2, 3)}
    return {"as above": ({}, maze), **rates, **orders, **places}


def vary(maze, runs, seed=0):
    """Latent learning in each of the `settings`, each with animals of its own: two dictionaries.

    The first has the findings "below" and "one meal" of `findings`, {setting: {learner: [Estimate, Estimate]}}, the
    second demonstration H1, {setting: `Claim`}.
    """
    rows, judged = {}, {}
    for number, (setting, (changes, where)) in enumerate(settings(maze).items()):
        by_learner = {name: simulate_groups(Animal(name, **changes), where, runs, seed + number) for name in LEARNERS}
        rows[setting] = {name: [found["below"].here, found["one meal"].here]
                         for name, found in compare_learners(by_learner).items()}
        judged[setting] = judge(by_learner)
    return rows, judged


def first_meals(days, maze, runs, seed=0):
    """Mean errors of the delayed group of neoRL on the day of its first meal and on the next: {day: (errors, errors)}.

    days: of the first meal, from 1 to 16, each with the same animals.
    """
    errors = {day: simulate_groups(Animal(), maze, runs, seed, day)["delayed"].errors.mean(axis=0) for day in days}
    return {day: (each[day - 1], each[day]) for day, each in errors.items()}
