"""Runs of 600,000 steps of all learners except deep ones, stored because they take minutes.

``python -m lib.alternatives.long_runs long_runs.csv`` makes the table; rerunning resumes.
"""

import sys

from lib.alternatives.contestants import TIMED_STEPS, neorl_agents, seconds_of_a_step
from lib.alternatives.living import BOARDS, live
from lib.alternatives.search import best_settings
from lib.alternatives.stored import MINUTE, RUN_FIELDS, append, finished, row_of_run
from lib.alternatives.tabular_learners import TABULAR
from neorl.agents.compile import n_bytes
from neorl.experiments.run import bin_steps
from neorl.experiments.simulation import simulate

STEPS, RUNS = 600_000, 10


def rewards_of(name, creeps, runs, steps=STEPS):
    """Run a contestant: (rewards of each minute, (runs, minutes); seconds of a run; kB)."""
    board, minutes = BOARDS[creeps], steps // MINUTE
    if name in TABULAR:
        lived = live(TABULAR[name](best_settings()[name]), board, steps=steps, runs=runs, bins=minutes)
        return lived.rewards, lived.seconds.mean(), lived.bytes / 1e3
    _, agent = neorl_agents()[name]
    result = simulate(agent, board, steps=steps, runs=runs, progress=False)
    rewards = result.rewards.reshape(runs, minutes, MINUTE // bin_steps(board)).sum(axis=2, dtype=float)
    return rewards, steps * seconds_of_a_step(agent, board, TIMED_STEPS), n_bytes(agent, board) / 1e3


def main(path):
    """Compute all runs that the table at `path` does not have yet."""
    for creeps in BOARDS:
        for name in (*TABULAR, *neorl_agents()):
            if (name, creeps, STEPS, RUNS - 1) not in finished(path):
                rewards, seconds, kilobytes = rewards_of(name, creeps, RUNS)
                for run in range(RUNS):
                    append(path, RUN_FIELDS, row_of_run(name, creeps, STEPS, run, seconds, kilobytes, rewards[run]))


if __name__ == "__main__":
    main(*sys.argv[1:])
