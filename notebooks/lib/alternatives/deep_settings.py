"""Settings of the deep learners: the ranges of the search, and the values that it draws.

The ranges are the second ones tried. In the first, with unscaled positions and γ of 0.95 or more, a search over eight
settings of each method for 51,000 steps found 0.28, 0.34 and 0.14 per second in the last third (DQN, QR-DQN, PPO). Five
runs of DQN by hand, with other scales, discounts and more updates, showed which ranges to widen.
"""

from lib.alternatives.search import LEARNING, drawn
from lib.alternatives.stored import METHODS
from neorl import checks

ANY = {"position_scale": [1.0, 2.0, 3.0, 5.0], "learning_rate": (1e-4, 2e-3), "gamma": LEARNING["discount"]}
REPLAY = ANY | {"batch_size": [32, 64, 128], "train_freq": [2, 4], "target_update_interval": [250, 500, 1_000, 2_500],
                "exploration_final_eps": [0.02, 0.05, 0.1], "exploration_steps": [10_000, 20_000, 40_000],
                "buffer_size": [20_000, 50_000, 150_000]}
RANGES = {"DQN": REPLAY,
          "QR-DQN": REPLAY,
          "PPO": ANY | {"batch_size": [64, 128], "n_steps": [256, 512, 1_024, 2_048], "n_epochs": [4, 10],
                        "gae_lambda": [0.8, 0.9, 0.95], "ent_coef": [0.0, 0.003, 0.01, 0.03]}}
SETTINGS, SEARCH_STEPS, SEARCH_SEED = 6, 36_000, 1_000  # steps: a multiple of three minutes of 3,000


def settings_of(method, number):
    """The settings at place `number` of a method's search: {name: value}."""
    checks.one_of("method", method, METHODS)
    return drawn(RANGES[method], SEARCH_SEED, METHODS.index(method), checks.integer("number", number, at_least=0))
