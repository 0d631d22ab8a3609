"""Looking at a run where the agent is not, and joining in, leave alone what the agent knows."""

import numpy as np
import pytest

from neorl import (Agent, Node, NresMap, Policy, Run, WaterWorld, multimodal, network_d, object_vector_cells,
                   place_cells, superpose)
from neorl.core.modality import HEAD_DIRECTION_CELL
from neorl.worlds.probe import HALF_SECOND, cell_seen_at, step_second, survey

TANK = WaterWorld(n_creeps=5)


def copied(fields):
    return type(fields)(*(value.copy() for value in fields))


def surveyed(run, side):
    values = np.zeros((side * side, 4))
    there = run.state._replace(agent_position=np.zeros(2))
    survey(run.plan, run.memory, copied(run.memory), there, side, values)
    return values


def test_a_survey_is_the_superposition_at_every_place():
    run = Run(place_cells([5, 7], weighting="equal"), TANK, seed=1)
    run.advance(5_000)
    expected = np.zeros((9, 4))
    for m, nres_map in enumerate(run.agent.maps):
        goals = nres_map.encode(run.state.creep_position / TANK.width)
        valences = np.where(run.state.creep_is_green, 1.0, -1.0)
        for tile in range(9):
            cell = int(nres_map.encode([(tile % 3 + 0.5) / 3, (tile // 3 + 0.5) / 3]))
            expected[tile] += 0.5 * superpose(run.q(m), cell, goals, valences, run.agent.own_cell)
    assert expected.any() and surveyed(run, 3) == pytest.approx(expected)


def test_a_survey_at_the_agents_own_place_is_what_it_chooses_by_next():
    run = Run(network_d([4, 5], policy=Policy(exploration=0.0)), TANK, seed=2)
    for _ in range(20):
        run.advance(500)
        run.state.agent_position[:] = TANK.width / 2
        for m, nres_map in enumerate(run.agent.maps):
            cells = nres_map.encode(nres_map.modality.coordinates(TANK, run.state))
            run.memory.cell[run.plan.first_track[m] : run.plan.first_track[m + 1]] = cells
        values = surveyed(run, 1)
        run.advance(1)
        assert values.any() and np.array_equal(values[0], run.memory.value)


@pytest.mark.parametrize("agent", [multimodal([3, 5]), network_d([3, 5])])
def test_a_survey_changes_nothing(agent):
    run, other = (Run(agent, TANK, seed=3) for _ in range(2))
    for each in (run, other):
        each.advance(2_000)
    surveyed(run, 7)
    assert run.advance(2_000) == other.advance(2_000)
    assert all(map(np.array_equal, [*run.memory, *run.state], [*other.memory, *other.state]))


def test_a_direction_is_seen_where_it_takes_the_agent():
    run = Run(Agent([Node("HD", HEAD_DIRECTION_CELL, [16])]), TANK, seed=0)
    x, y = run.state.agent_position / TANK.width
    south_east = NresMap(16, HEAD_DIRECTION_CELL).encode([np.pi / 4])
    assert cell_seen_at(run.plan, run.state, 0, x + 0.1 * HALF_SECOND, y + 0.1 * HALF_SECOND) == south_east


def test_a_creep_that_somebody_else_takes_is_gone_and_nothing_is_learned_from_it():
    run = Run(object_vector_cells([5]), TANK, seed=4)
    run.advance(3_000)
    run.state.creep_is_green[:] = [True, True, False, True, False]
    before = copied(run.memory)
    second = run.state._replace(agent_position=run.state.creep_position[2].copy(), agent_velocity=np.zeros(2))
    contacts = np.zeros(5, np.int8)
    paid = step_second(run.plan, run.memory, TANK.rules, run.state, second, contacts, 4)
    taken = contacts != 0
    assert contacts[2] == -1 and paid == contacts.sum()
    assert np.array_equal(run.memory.q, before.q)
    coordinates = run.agent.maps[0].modality.coordinates(TANK, run.state)
    assert np.array_equal(run.memory.cell[taken], run.agent.maps[0].encode(coordinates)[taken])
    assert not run.memory.events[taken].any() and not run.memory.trace_count[taken].any()
    assert np.array_equal(run.memory.cell[~taken], before.cell[~taken])
    assert np.array_equal(run.memory.events[~taken], before.events[~taken])


def test_when_somebody_else_takes_the_last_green_creep_the_tank_starts_afresh():
    run = Run(multimodal([5]), WaterWorld(n_creeps=1), seed=5)
    run.advance(100)
    while not run.state.creep_is_green[0]:
        run.advance(1)
    paid = 0.0
    for _ in range(50):  # until the fresh creep is red, which ends the episode
        second = run.state._replace(agent_position=run.state.creep_position[0].copy(), agent_velocity=np.zeros(2))
        paid = step_second(run.plan, run.memory, run.world.rules, run.state, second, np.zeros(1, np.int8), 4)
        if np.array_equal(run.state.agent_position, [125.0, 125.0]):
            break
    assert np.array_equal(run.state.agent_position, [125.0, 125.0]) and run.state.creep_is_green[0] and paid == 1
