"""Separation of concerns: the game and its learners against a plain Python implementation and closed forms."""

from collections import defaultdict
from itertools import combinations

import numpy as np
import pytest

from companion.chapter_3 import hybrid_reward
from companion.chapter_3.hybrid_reward import KINDS, Game, Learner, play, settled_values
from companion.shared.grid import Grid

JUNCTION = Grid(("o.....o", "###.###", "###.###", "###o###"))
SMALL = Game(rows=("ao.", ".#.", "o.g"), fruits=1, chase=0.5, limit=9)


def plainly(game, learner, steps, seed, run):
    """Rewards by step, ends of games and number of known states, by dictionaries, sets and NumPy's random numbers."""
    draw = np.random.Generator(np.random.SFC64(np.random.SeedSequence(seed, spawn_key=(run,)))).random
    grid, toward, places = game.grid, hybrid_reward._board(game).toward, game.places
    q = defaultdict(lambda: np.zeros(4))
    rewards, ends, begins = [], [], True
    for _ in range(steps):
        if begins:
            left, needed, age = set(), game.fruits, 0
            for i, place in enumerate(places):
                if int(draw() * (len(places) - i)) < needed:
                    left.add(place)
                    needed -= 1
            (agent,), (ghost,) = grid.marked("a"), grid.marked("g")
        before = agent, ghost, frozenset(left)
        if learner.kind == "one learner":
            value = q[before]
        else:
            value = q[before[:2]] + sum(q["fruit", place, agent] for place in places if place in left)
        if draw() < learner.exploration:
            action = int(draw() * 4)
        else:
            best = [0]
            for other in range(1, 4):  # ties are broken at random, one by one
                if value[other] > value[best[0]]:
                    best = [other]
                elif value[other] == value[best[0]]:
                    best.append(other)
                    if int(draw() * len(best)) == 0:
                        best[0], best[-1] = best[-1], best[0]
            action = best[0]
        agent = int(grid.next_state[agent, action])
        fruit = float(agent in left)
        left.discard(agent)
        if agent != ghost:
            ghost = int(toward[ghost, agent] if draw() < game.chase else grid.next_state[ghost, int(draw() * 4)])
        caught, age = agent == ghost, age + 1
        penalty = -10.0 * caught

        def learn(row_tm1, reward, row_t, terminal):
            target = reward + (0 if terminal else learner.discount * max(q[row_t]))
            q[row_tm1][action] += learner.learning_rate * (target - q[row_tm1][action])

        if learner.kind == "one learner":
            learn(before, fruit + penalty, (agent, ghost, frozenset(left)), caught or not left)
        else:
            learn(before[:2], penalty, (agent, ghost), caught)
            for place in places:
                if learner.kind == "latent heads" or place in before[2]:
                    learn(("fruit", place, before[0]), float(agent == place), ("fruit", place, agent), agent == place)
        rewards.append(fruit + penalty)
        begins = caught or not left or age == game.limit
        if begins:
            ends.append("caught" if caught else "all eaten" if not left else "out of time")
    return np.array(rewards), ends, sum(np.any(row != 0) for row in q.values())


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("game", [SMALL, Game(chase=0.1)])
def test_the_game_and_its_learners_are_what_the_rules_say(game, kind):
    learner = Learner(kind, learning_rate=0.3, discount=0.7, exploration=0.3)
    rewards, ends, known = plainly(game, learner, 2_000, seed=4, run=1)
    played = play(game, learner, steps=2_000, runs=2, seed=4)
    assert list(played.edges[-2:]) == [1_600, 2_000]  # the last bin is the last fifth
    sums = np.add.reduceat(rewards, played.edges[:-1])
    np.testing.assert_allclose(played.rewards[1], 100 * sums / np.diff(played.edges))
    assert [int(n) for n in played.ends[1].sum(axis=0)] == [ends.count(end) for end in hybrid_reward.ENDS]
    assert played.known[1] == known > 0


def test_states_are_counted():
    cells, sets = 8, [each for n in range(3) for each in combinations(SMALL.places, n)]
    assert SMALL.states("one learner") == cells * cells * len(sets)
    assert SMALL.states("heads") == SMALL.states("latent heads") == 2 * cells + cells * cells


def test_a_ghost_that_chases_comes_nearer_with_every_step():
    game = Game()
    toward, grid = hybrid_reward._board(game).toward, game.grid
    for agent in range(grid.states):
        steps, at = np.zeros(grid.states, int), np.arange(grid.states)
        for _ in range(grid.states):
            steps += at != agent
            assert np.all((toward[at, agent] == grid.next_state[at].T).any(axis=0) | (at == agent))
            at = toward[at, agent]
        away = steps > 0
        distance = settled_values(grid, agent, 0.5).max(axis=1)  # a half to the power of the steps after the first
        np.testing.assert_allclose(0.5 ** (steps[away] - 1), distance[away])


def test_settled_values_solve_the_bellman_equation():
    grid, place, discount = Game().grid, 12, 0.8
    q = settled_values(grid, place, discount)
    there = grid.next_state == place
    np.testing.assert_allclose(q, np.where(there, 1, discount * q.max(axis=1)[grid.next_state]))


@pytest.mark.parametrize("discount", [0.2, 0.45, 0.55, 0.9])
def test_three_fruits_equally_far_hold_the_agent_above_a_discount_of_one_half(discount):
    """Staying is worth 3 γ³ there, and going to one of them γ² + 2 γ⁴."""
    values = sum(settled_values(JUNCTION, fruit, discount) for fruit in JUNCTION.marked("o"))
    assert (values[3].argmax() == 0) == (discount > 0.5)
    np.testing.assert_allclose(values[3], [3 * discount**3, *3 * [discount**2 + 2 * discount**4]])
