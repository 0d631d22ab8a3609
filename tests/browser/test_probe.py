"""Probing values where the agent is not, and adding a second player, leave the agent's knowledge unchanged."""

import numpy as np
import pytest
from same import assert_same

from neorl import Agent, Node, NresMap, Run, WaterWorld, multimodal, network_d, object_vector_cells, place_cells
from neorl.core.horde import superpose
from neorl.agents.embodiment import loop_of
from neorl.core.coordinates import sense, tune
from neorl.core.modality import OBJECT_VECTOR_CELL, PLACE_CELL, Axis, Modality
from neorl.kernels.annotations import mapped
from neorl.kernels.execution import execute
from neorl.browser.probe import cell_seen_at, step_alone, step_second, survey
from neorl.worlds.waterworld import GREEN, RED

TANK = WaterWorld(n_creeps=5)
CALLS = loop_of(place_cells(), whole=True).functions


def surveyed(run, side):
    values = np.zeros((side * side, 4))
    there = run.world_state.scene._replace(position=np.zeros(2))
    execute(survey, run._record, run._record.copy(), mapped(np.copy, run._memory), there, CALLS, side, values)
    return values


def test_a_survey_is_the_superposition_at_every_place():
    run = Run(place_cells([5, 7], weighting="equal"), TANK, seed=1)
    run.advance(5_000)
    expected = np.zeros((9, 4))
    for m, nres_map in enumerate(run.agent.maps):
        goals = nres_map.encode(run.world_state.scene.things / TANK.width)
        valences = np.where(run.world_state.scene.kinds == GREEN, 1.0, -1.0)
        for tile in range(9):
            cell = int(nres_map.encode([(tile % 3 + 0.5) / 3, (tile // 3 + 0.5) / 3]))
            expected[tile] += 0.5 * superpose(run.q(m), cell, goals, valences, run.agent.own_cell)
    assert expected.any() and surveyed(run, 3) == pytest.approx(expected)


@pytest.mark.parametrize("agent", [multimodal([3, 5]), network_d([3, 5])])
def test_a_survey_changes_nothing(agent):
    run, other = (Run(agent, TANK, seed=3) for _ in range(2))
    for each in (run, other):
        each.advance(2_000)
    surveyed(run, 7)
    assert run.advance(2_000) == other.advance(2_000)
    assert_same(run, other)


def test_a_place_is_seen_in_the_cell_that_is_as_it_lies_and_otherwise_as_the_agent_is():
    conjunctive = Modality("place and speed", (*PLACE_CELL.axes, Axis("velocity", "length", high=2.0)))
    run = Run(Agent([Node("OVC", OBJECT_VECTOR_CELL, [3, 5]), Node("PC", conjunctive, [4])]), TANK, seed=6)
    run.advance(200)
    scene, (x, y) = run.world_state.scene, (0.7, 0.2)
    from_agent = np.array([x, y]) - scene.position / TANK.width
    expected = [*(NresMap(n, OBJECT_VECTOR_CELL).encode(tune(OBJECT_VECTOR_CELL, from_agent)) for n in (3, 5)),
                NresMap(4, conjunctive).encode([x, y, np.hypot(*scene.velocity) / TANK.width])]
    assert expected == [execute(cell_seen_at, run._record.copy(), run._memory, scene, CALLS, m, x, y) for m in range(3)]


def test_a_creep_that_somebody_else_takes_is_gone_and_nothing_is_learned_from_it():
    run = Run(object_vector_cells([5], object_state="object", object_beyond="outermost"), TANK, seed=4)
    run.advance(3_000)
    run.world_state.scene.kinds[:] = [GREEN, GREEN, RED, GREEN, RED]
    before, board = run.copy(), run.world_state
    second = board.scene._replace(position=board.scene.things[2].copy(), velocity=np.zeros(2))
    paid = execute(step_second, run._record, run._memory, board.scene, CALLS, board, TANK.rules, second, 4)
    taken = second.met != 0
    assert second.met[2] == 1 + RED and paid == sum(second.met == 1 + GREEN) - sum(second.met == 1 + RED)
    assert np.array_equal(run.memory.q, before.memory.q)
    coordinates = sense(run.agent.maps[0].modality, board.scene, TANK.size)
    assert np.array_equal(run.memory.tracks.cell[taken], run.agent.maps[0].encode(coordinates)[taken])
    assert not run.memory.events[taken].any() and not run.memory.tracks.remembered[taken].any()
    assert np.array_equal(run.memory.tracks.cell[~taken], before.memory.tracks.cell[~taken])
    assert np.array_equal(run.memory.events[~taken], before.memory.events[~taken])


@pytest.mark.parametrize("resets", ["noticed", "unnoticed"])
def test_when_somebody_else_takes_the_last_green_creep_the_tank_starts_afresh(resets):
    run = Run(multimodal([5], resets=resets), WaterWorld(n_creeps=1), seed=5)
    run.advance(100)
    board = run.world_state
    while board.scene.kinds[0] != GREEN:
        run.advance(1)
    paid = 0.0
    for _ in range(50):  # until the fresh creep is red, which ends the episode
        second = board.scene._replace(position=board.scene.things[0].copy(), velocity=np.zeros(2))
        paid = execute(step_second, run._record, run._memory, board.scene, CALLS, board, run.world.rules,
                       second, 4)
        if np.array_equal(board.scene.position, [125.0, 125.0]):
            break
    assert np.array_equal(board.scene.position, [125.0, 125.0]) and board.scene.kinds[0] == GREEN and paid == 1
    assert run.memory.events.any() == (resets == "unnoticed")


def test_a_reader_who_is_alone_on_a_board_meets_what_an_agent_would_meet():
    state, other = TANK.reset(6), TANK.reset(6)
    log, paid, met = Run(multimodal([5]), TANK)._log(500, np.zeros(4, np.float32), np.zeros((4, 2), np.int16)), 0.0, 0
    for action in np.random.default_rng(0).integers(5, size=2_000).tolist():
        execute(step_alone, state, TANK.rules, log, action)
        expected, done = execute(TANK.dynamics.step, other, TANK.rules, action)
        paid, met = paid + expected, met + np.count_nonzero(other.scene.met)
        if done:
            execute(TANK.dynamics.reset, other, TANK.rules)
        assert log.paid[0] == paid and np.array_equal(state.scene.met, other.scene.met)
    assert np.array_equal(state.scene.position, other.scene.position)
    assert log.clock[0] == 2_000 and log.rewards.sum() == paid and log.hits.sum() == met
