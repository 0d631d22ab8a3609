"""What deep agents are tuned by: the ranges of the search, and what it draws."""

from neorl import checks
from neorl.chapters.alternatives.search import drawn
from neorl.chapters.alternatives.stored import METHODS

REPLAY = {"learning_rate": (1e-4, 2e-3), "gamma": [0.95, 0.97, 0.98, 0.99], "batch_size": [32, 64, 128],
          "target_update_interval": [500, 1_000, 2_500, 5_000], "exploration_final_eps": [0.02, 0.05, 0.1],
          "exploration_steps": [10_000, 20_000, 40_000], "buffer_size": [20_000, 50_000, 150_000]}
RANGES = {"DQN": REPLAY,
          "QR-DQN": REPLAY,
          "PPO": {"learning_rate": (1e-4, 2e-3), "gamma": [0.95, 0.97, 0.98, 0.99], "batch_size": [64, 128],
                  "n_steps": [256, 512, 1_024, 2_048], "n_epochs": [4, 10], "gae_lambda": [0.8, 0.9, 0.95],
                  "ent_coef": [0.0, 0.003, 0.01, 0.03]}}
SEARCH_SEED = 1_000


def settings_of(method, number):
    """The settings of a method, {name: value}, that the search draws in place `number`."""
    checks.one_of("method", method, METHODS)
    return drawn(RANGES[method], SEARCH_SEED, METHODS.index(method), checks.integer("number", number, at_least=0))
