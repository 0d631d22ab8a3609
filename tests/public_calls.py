"""The public callables with valid arguments, of which `test_fuzzing` replaces one at a time by a hostile value."""

from functools import partial

import numpy as np
from fuzzing import entry
from hypothesis import strategies as st
from public_uses import (BOARD, CONDITION, MAZE, POOL, RESULT, SCENE, SCENES, VESSEL, acted, agents, begun,
                         described_paths, fields_of, in_a_loop, live, live_in, live_in_state, make_with, method,
                         new_env, new_learner, paper, paths, q, reals, resolutions, saved, saved_as, scene_of,
                         scene_then, seeds, shares, states, step_with, tile, tile_by, use_modality, want_it)

import neorl
from neorl import (CARDINAL, Actions, Agent, Condition, Contacts, Desire, Learner, Learning, Node, NresMap, Place,
                   Policy, Result, Run, Scene, WaterWorld)
from neorl.custom import Axis, Modality, greedy, softmax
from neorl.worlds import Arena, Arm, Vessel, WaterMaze
from neorl.agents import learner
from neorl.agents.forager import forager
from neorl.agents.individual import Individual
from neorl.core import horde
from neorl.core.coordinates import sense, tune
from neorl.core.modality import MODALITIES, OBJECT_VECTOR_CELL, PLACE_CELL, cartesian, polar
from neorl.core.stream import new_stream
from neorl.gym import environment, playing, vector
from neorl.kernels import kernel
from neorl.kernels.annotations import arrays
from neorl.kernels.identity import identity
from neorl.worlds import walls, world

TABLE = {
    "neorl.core.modality.Axis": entry(
        Axis, of=["position", "objects", "landmarks"], feature=["component", "length"], along=[0, 1],
        low=st.floats(-1, 0), high=st.floats(0.1, 1), closed=[False, True], intervals=[None, 2], boundaries=[()],
        name=["", "x"], then=tile, also=("margin", "kernel")),
    "neorl.core.modality.Axis, cut": entry(
        Axis, of=["position"], boundaries=[(0, 0.2, 0.9), [0, 1]], also="low", then=tile),
    "neorl.core.modality.Modality": entry(
        Modality, name=["cell"], axes=[cartesian("position", (0, 1), (0, 1)), polar("objects", 1)],
        landmarks=[()], then=use_modality),
    "neorl.core.modality.Modality, of landmarks": entry(
        Modality, name=["cell"], axes=[polar("landmarks", 1)], landmarks=[[(0.1, 0.2)], ((0, 1), (1, 1))],
        then=use_modality),
    "neorl.core.coordinates.tune": entry(
        tune, modality=[OBJECT_VECTOR_CELL], vectors=[np.ones((3, 2)), [1, 2], ((0.5, 0.5),)]),
    "neorl.core.coordinates.sense": entry(
        sense, modality=[PLACE_CELL], scene=[Scene(np.array([0.5, 0.5]))], size=st.floats(0.1, 10)),
    "neorl.core.modality.cartesian": entry(
        lambda of, first, second, intervals: cartesian(of, first, second, intervals=intervals), of=["position"],
        first=[(0, 1)], second=[(-1, 1), [0.5, 3]], intervals=[None, 4], also=("ranges", "low", "high"),
        then=lambda axes: use_modality(Modality("cell", axes))),
    "neorl.core.modality.polar": entry(
        polar, of=["objects", "boundaries"], reach=st.floats(0.1, 3), intervals=[None, 4], also=("high", "resolution"),
        then=lambda axes: use_modality(Modality("cell", axes))),
    "neorl.core.maps.NresMap": entry(
        NresMap, resolution=st.integers(1, 50), modality=st.sampled_from(MODALITIES),
        then=lambda nres_map: nres_map.encode(np.zeros(len(nres_map.intervals)))),
    "neorl.core.maps.NresMap.encode": entry(
        NresMap(5).encode, points=[np.full((2, 3, 2), 0.5), [0.1, 0.9], [(0, 0), (-1, 2)], np.zeros((0, 2))]),
    "neorl.core.horde.learn": entry(
        lambda **each: (horde.learn(**each), each["q"][each["cell_tm1"]]), q=q, cell_tm1=st.integers(0, 3),
        cell_t=st.integers(0, 3),
        credit=[(0.5, 0.5), [1, 0]], learning_rate=shares, discount=shares, terminal=[True, False]),
    "neorl.core.horde.superpose": entry(
        horde.superpose, q=q, cell=st.integers(0, 3), goals=[(1, 2), [3, 3]], valences=[(1, -1), [0.5, 2]],
        own_cell=["counts", "silent"]),
    "neorl.core.horde.as_vectors": entry(
        horde.as_vectors, values=[np.ones((3, 4)), np.zeros(4), [1, 2, 3, 4]],
        actions=[CARDINAL]),
    "neorl.kernels.kernel.kernel": entry(
        lambda function: live(neorl.place_cells([3], policy=Policy(choose=kernel.kernel(function)))),
        function=[lambda value, stream: 1], also="kernel"),
    "neorl.kernels.kernel.kernel_maker": entry(make_with, function=[lambda t: kernel.kernel(lambda value, stream: 1)]),
    "neorl.core.policy.softmax": entry(
        softmax, temperature=st.floats(0.01, 5),
        then=lambda choose: live(neorl.place_cells([3], policy=Policy(choose=choose)))),
    "neorl.core.scene.Actions": entry(
        Actions, names=[("left", "right"), ["a", "b"]], pushes=[((-1, 0), (1, 0)), [[0.5], [1]]],
        idle=[None, "stay"], then=lambda actions: in_a_loop(Learner(Agent([Node("X", Modality("x", cartesian(
            "position", (0, 1))), [3])]), actions=actions))),
    "neorl.core.stream.new_stream": entry(
        new_stream, seed_sequence=[np.random.SeedSequence(3), np.random.SeedSequence(2**70, spawn_key=(1,)),
                                   np.random.SeedSequence(5, pool_size=8)]),
    "neorl.worlds.waterworld.WaterWorld": entry(
        WaterWorld, width=st.integers(11, 500), n_creeps=st.integers(1, 9), fps=st.integers(1, 100),
        win_reward=reals, contact=["rounded", "truncated"], then=live_in),
    "neorl.worlds.arena.Arena": entry(
        Arena, places=[(("food", 0.3, 0.4),), [("a", 0, 1), ("b", 0.2, 0.2)], ()], pay=[(), (1.5,)][:1],
        obstacles=[(), [(0.1, 0.1, 0.2, 0.2)]], shape=["round", "square"], motion=["inertia", "steps"],
        step_length=st.floats(0.001, 0.5), radius=st.floats(0.01, 1), ends=[True, False], start=[(), (0.5, 0.5)],
        trial_seconds=st.floats(0.1, 99), fps=st.integers(1, 100), then=live_in),
    "neorl.worlds.arena.Arena, pay": entry(
        Arena, places=[[("a", 0.5, 0.5), ("b", 0.2, 0.2)]], pay=[(), (1.5,), [2, 3]], start=[(0.4, 0.4)], also="pay",
        then=live_in),
    "neorl.worlds.arm.Arm": entry(
        Arm, lengths=[(1, 1), [3, 2.5, 1]], targets=st.integers(1, 3), obstacles=st.integers(0, 3),
        radius=st.floats(0.01, 0.2), fps=st.integers(1, 100), then=live_in),
    "neorl.worlds.vessel.Vessel": entry(
        Vessel, traffic=st.integers(0, 5), current=[(0, 0), [0.05, -0.02]], speed=st.floats(0.05, 1),
        turning=st.floats(0.01, 5), lag=st.floats(1, 9), radius=st.floats(0.001, 0.1), fps=st.integers(1, 100),
        then=live_in),
    "neorl.worlds.water_maze.WaterMaze": entry(
        WaterMaze, places=[((0.3, 0.4),), [(0.5, 0.5), (0.6, 0.4)]], trials_a_day=st.integers(1, 5),
        radius=st.floats(0.01, 0.25), trial_seconds=st.floats(0.1, 99), fps=st.integers(1, 100), then=live_in),
    "neorl.worlds.walls.table": entry(walls.table, walls=[[(0, 0.5, 0.25, 1)], ()]),
    "neorl.worlds.walls.distance": entry(walls.distance, walls=[[(0, 0.5, 0.25, 1)]], then=tile_by),
    "neorl.worlds.walls.distance_along": entry(
        walls.distance_along, walls=[[(0, 0.5, 0.25, 1)]], x=st.floats(0.1, 2), y=reals, also="length", then=tile_by),
    "neorl.worlds.world.World.reset": entry(BOARD.reset, seed=seeds, then=lambda state: list(arrays(state).values())),
    "neorl.worlds.world.World.step": entry(
        BOARD.step, state=states, action=["N", 0, "no-op", np.int8(4)]),
    "neorl.worlds.world.World.step, fields": entry(step_with, **fields_of(BOARD.reset(0)), also="state"),
    "neorl.worlds.world.World.check_state": entry(BOARD.check_state, state=states),
    "neorl.worlds.waterworld.WaterWorld.check_state": entry(BOARD.check_state, state=states),
    "neorl.worlds.vessel.Vessel.check_state": entry(VESSEL.check_state, state=st.integers(0, 5).map(VESSEL.reset)),
    "neorl.worlds.water_maze.WaterMaze.check_state": entry(MAZE.check_state, state=st.integers(0, 5).map(MAZE.reset)),
    "neorl.agents.rules.Learning": entry(
        Learning, learning_rate=shares, discount=shares, update_on=["cell"], credit=["happened", "activity", "share"],
        activity=st.floats(0, 9), absent_decay=shares, absent_form=["decay", "away"], terminal=[True, False],
        memory=st.floats(0, 9), bootstrap=[True, False],
        then=lambda learning: live(neorl.multimodal([3], learning=learning))),
    "neorl.agents.rules.Contacts": entry(
        Contacts, horizon=st.floats(0.01, 9), learning_rate=shares, familiarity=st.floats(0, 99), first_value=shares,
        trace_rate=shares, caution=st.floats(0, 9), fear=["avoidance", "approach"], rivals=shares,
        efference=st.floats(0.1, 9), lookahead=st.integers(0, 3),
        then=lambda contacts: live(forager([3, 5], contacts=contacts))),
    "neorl.agents.forager.forager": entry(
        forager, resolutions=[(3,), (3, 5)], valence_green=[1.0, "learned"], valence_red=[-1.0, "learned"],
        contacts=[Contacts()], then=live, also=("resolution", "valence", "modality")),
    "neorl.agents.rules.Policy": entry(
        Policy, exploration=shares, when_indifferent=["random", "no-op"],
        choose=st.sampled_from([greedy, softmax(1.0)]),
        then=lambda policy: live(neorl.multimodal([3], policy=policy)), also="kernel"),
    "neorl.agents.agent.Node": entry(
        Node, name=["PC"], modality=st.sampled_from([PLACE_CELL, OBJECT_VECTOR_CELL]), resolutions=resolutions,
        weighting=["equal", "cells"], gain=reals, also="resolution",
        then=lambda node: live(Agent([node], [Desire("green", node.name, 1.0)]))),
    "neorl.agents.agent.Place": entry(
        lambda x, y: Place(x, y), x=reals, y=reals, also="coordinates",
        then=lambda place: want_it(Desire(place, "PC", 1.0))),
    "neorl.agents.agent.Place.of_fields": entry(
        Place.of_fields, coordinates=[(0.5, 0.5), [1, 0]], then=lambda place: want_it(Desire(place, "PC", 1.0))),
    "neorl.agents.agent.Desire": entry(
        Desire, source=st.sampled_from(["red", Place(0.5, 0.5), (0.3, 0.4)]), target=["PC"], valence=reals, of=[()],
        scale=st.floats(0, 3), signed=[True, False], then=want_it, also=("desire", "node", "coordinates", "name")),
    "neorl.agents.agent.Desire, of a node": entry(
        Desire, source=["PC"], target=["OVC"], valence=[None, 0.5], of=[(), ("green",), ["green"]],
        scale=st.floats(0, 3), signed=[True, False], then=want_it, also=("desire", "node", "coordinates")),
    "neorl.agents.agent.Agent": entry(
        Agent, nodes=[(Node("PC", PLACE_CELL, [3]),)], desires=[[Desire("green", "PC", 1.0)], ()],
        learning=[Learning()], policy=[Policy()], own_cell=["counts", "silent"],
        shared_cell=["each", "once"], resets=["noticed", "unnoticed"], then=live, also="node"),
    "neorl.agents.agent.Agent.comes_from_node": entry(
        neorl.place_cells([3]).comes_from_node, desire=[Desire("green", "PC", 1.0)]),
    "neorl.agents.learner.Surroundings": entry(
        learner.Surroundings, things=st.integers(0, 5), kinds=[(), ("a",)], actions=[CARDINAL],
        size=st.floats(0.1, 9), fps=st.floats(1, 99)),
    "neorl.agents.learner.Learner": entry(
        Learner, agent=agents, things=st.integers(0, 5), kinds=[("green", "red"), ["green", "red", "blue"]],
        actions=[CARDINAL], seed=seeds, size=st.floats(0.1, 9), fps=st.floats(1, 99), then=in_a_loop,
        also=("kind", "axes")),
    "neorl.agents.learner.Learner.begin": entry(method(Learner.begin, new_learner), scene=SCENES),
    "neorl.agents.learner.Learner.begin, fields": entry(
        scene_then(Learner.begin, new_learner), **{name: [each] for name, each in SCENE._asdict().items()},
        also="scene"),
    "neorl.agents.learner.Learner.observe": entry(method(Learner.observe, acted), scene=SCENES),
    "neorl.agents.learner.Learner.observe, fields": entry(
        scene_then(Learner.observe, acted), **{name: [each] for name, each in SCENE._asdict().items()}, also="scene"),
    "neorl.agents.learner.Learner.watch": entry(
        method(Learner.watch, new_learner), positions=[np.full((5, 2), 0.5), [(0.1, 0.2), (0.3, 0.2), (0.3, 0.9)]],
        actions=[None], ends=[(), [1]], rewards=[None], progress=[False]),
    "neorl.agents.learner.Learner.watch, actions": entry(
        method(Learner.watch, new_learner), positions=[np.full((3, 2), 0.5)], progress=[False],
        actions=[[0, 4], np.ones((2, 2))], rewards=[None, [1.0, 2]], ends=[[True, False], [2]]),
    "neorl.agents.learner.Learner.output": entry(
        method(Learner.output, new_learner), name=["PC"], scene=SCENES, normalised=[True, False]),
    "neorl.agents.individual.Individual.want": entry(
        lambda source, valence: new_learner().want(source, valence=valence), source=["green", (0.2, 0.3)],
        valence=reals, also=("sources", "coordinates")),
    "neorl.agents.individual.Individual.q": entry(method(Individual.q, new_learner), index=[0]),
    "neorl.agents.individual.Individual.output": entry(method(Individual.output, new_learner), name=["PC"]),
    "neorl.agents.individual.Individual.change": entry(method(Individual.change, acted), agent=agents),
    "neorl.agents.individual.Individual.transfer": entry(
        method(Individual.transfer, new_learner), other=st.builds(new_learner), also="maps"),
    "neorl.agents.individual.Individual.save": entry(saved, path=paths, errors=(OSError,)),
    "neorl.agents.individual.Individual.load": entry(Run.load, path=paths, errors=(OSError,)),
    **{f"{kind.__name__}.{name}": each for kind, value in (
        (Agent, neorl.network_d([2])), (Condition, CONDITION), (Arena, Arena()), (world.World, BOARD), (Arm, Arm()))
       for name, each in {
           "from_dict": entry(kind.from_dict, data=[{"is": type(value).__name__} | value.to_dict()], then=identity,
                              also=("is", *value.to_dict())),
           "save": entry(saved_as(value), path=described_paths, errors=(OSError,)),
           "load": entry(kind.load, path=described_paths, errors=(OSError,)),
       }.items()},
    "neorl.experiments.result.Result.save": entry(saved_as(RESULT), path=paths, errors=(OSError,)),
    "neorl.experiments.result.Result.load": entry(Result.load, path=paths, errors=(OSError,)),
    "neorl.experiments.run.Run": entry(
        lambda **each: Run(**each).advance(40), agent=agents, world=[BOARD], seed=seeds, run=st.integers(0, 9),
        after=st.builds(lambda: Run(neorl.place_cells([3]), BOARD))),
    "neorl.experiments.run.Run.advance": entry(
        method(Run.advance, lambda: Run(neorl.place_cells([3]), BOARD)), steps=st.integers(0, 50), long=("steps",),
        also="rewards",
        rewards=st.just(0).map(lambda _: np.zeros(5, np.float32)),
        hits=st.just(0).map(lambda _: np.zeros((5, 2), np.int16)), every=st.integers(1, 60)),
    "neorl.experiments.run.Run.record": entry(
        method(Run.record, lambda: Run(neorl.place_cells([3]), BOARD)), steps=st.integers(0, 50), long=("steps",),
        every=st.integers(1, 60), then=lambda path: [path.positions, path.rewards, path.returns]),
    "neorl.experiments.run.Run.world_state": entry(live_in_state, **fields_of(BOARD.reset(0)), also="state"),
    "neorl.experiments.simulation.simulate": entry(
        partial(neorl.simulate, progress=False), long=("steps", "runs", "threads"), agent=agents, world=[BOARD],
        steps=st.integers(1, 60), runs=st.integers(1, 2), seed=seeds,
        changes=[(), [(20, neorl.place_cells([2]))]], threads=[None, 1],
        cache=[False, True], also=("change",)),
    "neorl.experiments.condition.Condition": entry(
        Condition, agent=agents, world=[BOARD], steps=st.integers(1, 60), runs=st.integers(1, 2), seed=seeds,
        changes=[(), [(20, neorl.place_cells([2]))]], also=("change",),
        then=lambda condition: (condition.key, repr(condition))),
    "neorl.experiments.simulation.sweep": entry(
        lambda **each: list(neorl.sweep(**each, progress=False)), executor=[None],
        cache=[True, False], threads=[None, 1], long=("threads",),
        conditions=[[Condition(neorl.place_cells([2]), BOARD, 40, 1)]], also="condition"),
    "neorl.experiments.result.Result.rate": entry(RESULT.rate, begin=[0.0, 0.2], end=[0.5, 1.0]),
    "neorl.experiments.result.Result.hit_rate": entry(RESULT.hit_rate, begin=[0.0, 0.2], end=[0.5, 1.0]),
    "neorl.agents.papers.place_cells": paper(neorl.place_cells, valence_green=reals, valence_red=reals),
    "neorl.agents.papers.object_vector_cells": paper(neorl.object_vector_cells, valence_green=reals, valence_red=reals),
    "neorl.agents.papers.multimodal": paper(neorl.multimodal, place_gain=reals, object_gain=reals),
    "neorl.agents.papers.network_a": paper(neorl.network_a, scale=st.floats(0, 2), signed=[True, False]),
    "neorl.agents.papers.network_b": paper(neorl.network_b, scale=st.floats(0, 2), signed=[True, False]),
    "neorl.agents.papers.network_c": paper(neorl.network_c, scale=st.floats(0, 2), signed=[True, False],
                                           place_gain=reals, object_gain=reals),
    "neorl.agents.papers.network_d": paper(neorl.network_d, recursion=reals, scale=st.floats(0, 2),
                                           signed=[True, False], place_gain=reals, object_gain=reals),
    "neorl.gym.environment.WorldEnv.reset": entry(
        lambda **each: new_env().reset(**each)[0], seed=[None, 0, 5], options=[None], also="run"),
    "neorl.gym.environment.WorldEnv.step": entry(
        method(environment.WorldEnv.step, lambda: begun(new_env())), action=[0, np.int64(4)]),
    "neorl.gym.environment.WorldEnv": entry(
        lambda **each: begun(environment.WorldEnv(**each)).step(0)[0], world=[BOARD, POOL],
        render_mode=[None, "rgb_array"], egocentric=[True, False], continuing=[None, True, False]),
    "neorl.gym.playing.play": entry(
        lambda **each: playing.play(**each).rewards, agent=[neorl.place_cells([3])], env=st.builds(new_env),
        scene=st.just(scene_of), steps=st.integers(0, 5), seed=st.integers(0, 99), things=[0], kinds=[("green", "red")],
        actions=[None], commands=[None, range(5)], long=("steps",), also=("Discrete", "surroundings", "kind", "axes")),
    **{f"neorl.gym.vector.VectorWorldEnv{name}": each for name, each in {
        "": entry(lambda **each: vector.VectorWorldEnv(**each).reset(seed=0)[0], world=[BOARD, POOL],
                  num_envs=st.integers(1, 3), max_episode_steps=[None, 5],
                  render_mode=[None, "rgb_array"], egocentric=[True, False], continuing=[None, True],
                  long=("num_envs",)),
        ".reset": entry(lambda **each: vector.VectorWorldEnv(BOARD, 2).reset(**each)[0], seed=[None, 3, [1, 2]],
                        options=[None], also="run"),
        ".step": entry(method(vector.VectorWorldEnv.step, lambda: begun(vector.VectorWorldEnv(BOARD, 2))),
                       actions=[[0, 1], np.array([4, 0])])}.items()},
}
