"""The public names that compute: those for which `public_calls.TABLE` must have an entry."""

import inspect

import neorl
from neorl.agents import agent, forager, individual, learner, papers
from neorl.core import coordinates, horde, maps, modality, policy, scene, stream
from neorl.gym import environment, playing, vector
from neorl.kernels import annotations, kernel
from neorl.worlds import arena, arm, vessel, walls, water_maze, waterworld, world

MODULES = (neorl, agent, annotations, forager, coordinates, individual, learner, papers, horde, kernel, maps, modality,
           policy, scene, stream, arena, arm, vessel, walls, water_maze, waterworld, world, environment, playing,
           vector)
# Classes that only kernels or the package itself instantiate; kernels refuse to be called.
MADE_INSIDE = {f"neorl.{name}" for name in (
    "agents.individual.Individual", "agents.individual.Output", "agents.learner.Here", "agents.learner.Imagining",
    "core.scene.Scene", "kernels.annotations.Record", "kernels.annotations.Signature", "kernels.kernel.Kernel",
    "gym.playing.Played", "experiments.result.Result", "experiments.run.Trajectory", "worlds.arena.ArenaRules",
    "worlds.arena.ArenaState", "worlds.waterworld.Rules",
    *(f"worlds.{name}{part}" for name in ("arm.Arm", "vessel.Vessel", "water_maze.WaterMaze")
      for part in ("Rules", "State")),
    "worlds.waterworld.WaterWorldState", "worlds.world.Dynamics", "worlds.world.World")}
# Functions for authors of kernels and worlds with types and sizes of their own. They check nothing, since they are
# called often or at import.
FOR_AUTHORS = {f"neorl.{name}" for name in (
    *(f"kernels.annotations.{name}" for name in (
        "array", "arrays", "fields", "function", "is_again", "is_tuple", "length", "mapped", "marks", "new_tuple",
        "tabled")),
    *(f"kernels.kernel.{name}" for name in (
        "Kernel.compiled_for", "check_kernel", "full_name", "function_of", "inlined", "inlined_kernel")),
    *(f"core.coordinates.{name}" for name in (
        "as_radians", "as_turns", "check_faults")),
    "core.modality.Modality.check_axes",
    "gym.vector.VectorWorldEnv.advance",
    "agents.papers.paper_agent", "kernels.execution.execute", "kernels.kernel.jit_is_off",
    "core.scene.checked_scene", "worlds.world.check_arrays", "worlds.world.check_kind",
    "worlds.walls.checked", "worlds.world.check_definition", "worlds.world.check_outcome",
    "worlds.world.check_rules", "worlds.world.checked_rules")}
NOTHING_TO_REPLACE = {"neorl.agents.papers.brownian", "neorl.kernels.kernel.interpreting"}  # they take no arguments


def public_names():
    """The public functions and classes of `MODULES`, and the methods that take arguments and that these define."""
    found = set()
    for module in MODULES:
        for name, value in vars(module).items():
            ours = name in module.__all__ if module is neorl else getattr(value, "__module__", "") == module.__name__
            if ours and not name.startswith("_") and callable(value) and not isinstance(value, kernel.Kernel):
                full = f"{value.__module__}.{value.__qualname__}"
                found |= {full, *(f"{full}.{method}" for method in methods(value))}
    return found - MADE_INSIDE - FOR_AUTHORS


def methods(value):
    for name, each in vars(value).items() if inspect.isclass(value) else ():
        each = getattr(each, "__func__", each)
        if not name.startswith("_") and inspect.isfunction(each) and len(inspect.signature(each).parameters) > 1:
            yield name
