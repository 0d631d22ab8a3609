"""Worlds for agents to live in, and the rollout of an agent in any of them.

`WaterWorld` is the world of the papers; an `Arena` has walls and places of interest. Three more have other spaces: the
joints of an `Arm`, the waters of a `Vessel` with a rudder, and the pool of a `WaterMaze`.

**How to write a world.** A world is one file, for which `neorl` has everything: ``from neorl import CARDINAL, Dynamics,
Scene, World, array, kernel, randint, uniform, walls``. It defines

1. a state, a named tuple with a field `scene` (`neorl.Scene`, what agents perceive) and a field `stream`, an array of
   type uint64 (4,) from which random numbers are drawn (`neorl.uniform`, `neorl.randint`); everything else that changes
   is an array of its own, annotated by `neorl.array` with its type and shape;
2. rules, a named tuple of everything that stays constant;
3. two kernels with annotated arguments, `reset` of (state, rules) and `step` of (state, rules, action). `reset` starts
   an episode. `step` returns the reward and whether the episode is over, and records in `scene.met` which things were
   met;
4. a frozen dataclass derived from `neorl.World`, whose fields users choose, with `kinds`, `actions`, `things`,
   `size`, `fps`, `dynamics` and `rules`: see `neorl.worlds.world`.

Nothing else in the package has to change: `neorl.Run`, `neorl.simulate`, `neorl.sweep` and the cache accept it as it
is. `notebooks/own_world.ipynb` has a small example, `neorl.worlds.arena` is a larger one.

Kernels keep to the rules in `neorl.core.kernel`. In particular they allocate nothing, and an index out of range crashes
the interpreter; running a world with ``NUMBA_DISABLE_JIT=1`` finds such mistakes, and lets `breakpoint` stop a kernel.
`neorl.walls` has walls that any world can hold; `neorl.heading` and `neorl.turn` stand in for cosine, sine and the
arctangent.

This room depends on `neorl.core`.
"""
