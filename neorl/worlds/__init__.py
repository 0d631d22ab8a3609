"""Worlds for agents to live in, and the rollout of an agent in any of them.

`WaterWorld` is that of the papers, an `Arena` has walls and places that matter. Three more are of other spaces: the
joints of an `Arm`, the waters of a `Vessel` with a rudder, and the pool of a `WaterMaze`.

**How to write a world.** A world is one file. It defines

1. a state, a named tuple with a field `scene` (`neorl.core.scene.Scene`, what agents perceive of it) and a field
   `stream`, an array of type uint64 (4,) that random numbers are drawn from (`neorl.core.stream`); what else changes is
   an array of its own, each annotated by `neorl.core.kernel.array` with its type and shape;
2. rules, a named tuple of all that stays the same;
3. two kernels, `reset` of (state, rules) and `step` of (state, rules, action), whose arguments are annotated. `reset`
   starts an episode. `step` returns the reward and whether the episode is over, and says in `scene.met` which things
   were met;
4. a frozen dataclass derived from `neorl.World`, its fields what users choose, with `kinds`, `actions`, `things`,
   `size`, `fps`, `dynamics` and `rules`: see `neorl.worlds.world`.

Nothing else in the package has to change: `neorl.Run`, `neorl.simulate`, `neorl.sweep` and the cache take it as it is.
`neorl.chapters.own_world.pond` is a small one, `neorl.worlds.arena` a larger one.

Kernels keep to the rules in `neorl.core.kernel`. In particular they allocate nothing, and an index that is out of range
ends the interpreter; running a world with ``NUMBA_DISABLE_JIT=1`` finds such mistakes.

The room uses `neorl.core`.
"""
