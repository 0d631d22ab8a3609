"""neoRL and Gymnasium: the worlds of this package as environments, and its agents in any environment.

Importing this package registers three environments; Gymnasium imports it when it is named before a colon::

    env = gymnasium.make("neorl.gym:neorl/WaterWorld-v0", n_creeps=8)
    env = gymnasium.make("neorl.gym:neorl/Arena-v0", shape="square")
    env = gymnasium.make("neorl.gym:neorl/World-v0", world=Pond())
    envs = gymnasium.make_vec("neorl.gym:neorl/WaterWorld-v0", num_envs=64)

They take the fields of the world, or any `neorl.World` as a whole, and the arguments of `WorldEnv` or, for many
environments, of `VectorWorldEnv`. An episode in WaterWorld lasts a minute, 3,000 steps, unless `max_episode_steps` says
otherwise; one in an arena is a trial. `play` runs a neoRL agent in any Gymnasium environment.

The package needs gymnasium, matplotlib to draw an environment, and pygame to show it in a window: the extra ``gym``.
"""

from neorl.common.extras import require
from neorl.gym.environment import WorldEnv
from neorl.gym.playing import Played, play
from neorl.gym.vector import VectorWorldEnv

__all__ = ["Played", "VectorWorldEnv", "WorldEnv", "play"]

MINUTE = 3_000  # steps

for name, steps in (("WaterWorld", MINUTE), ("Arena", None), ("World", None)):
    require("gymnasium", extra="gym").register(
        f"neorl/{name}-v0", entry_point="neorl.gym:WorldEnv", vector_entry_point="neorl.gym:VectorWorldEnv",
        max_episode_steps=steps, kwargs={} if name == "World" else {"world": name})
