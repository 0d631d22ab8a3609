"""A condition: everything that determines a set of runs, and the key under which their result is kept.

The key covers the agent, steps, runs, seed, all that runs take from the world, the source of every module that takes
part in a run, and every kernel of the user's own with all that it looks up (`neorl.kernels.identity`).
"""

import hashlib
from dataclasses import dataclass, fields

from neorl.agents.agent import Agent
from neorl.common import checks
from neorl.description import Described
from neorl.kernels.identity import digest_of_source, identity
from neorl.worlds.world import World

# Everything that takes part in a run.
PARTS = ("common", "kernels", "core", "description", "worlds", "agents", "experiments")


@dataclass(frozen=True)
class Condition(Described):
    """Everything that determines a `neorl.Result`. The fields are those of `neorl.simulate` of the same names.

    Raises ValueError for what `neorl.simulate` would refuse.
    """

    agent: Agent
    world: World
    steps: int
    runs: int
    seed: int = 0
    changes: tuple[tuple[int, Agent], ...] = ()

    def __post_init__(self):
        checks.instance("agent", self.agent, Agent)
        checks.instance("world", self.world, World)
        steps = checks.integer("steps", self.steps, at_least=1)
        checks.assign(self, steps=steps, runs=checks.integer("runs", self.runs, at_least=1),
                     seed=checks.integer("seed", self.seed, at_least=0), changes=_checked_changes(self.changes, steps))

    @property
    def choices(self):
        """The condition as keyword arguments."""
        return {field.name: getattr(self, field.name) for field in fields(self)}

    @property
    def key(self):
        """A digest of the condition and the source that it runs with: 64 hexadecimal digits."""
        return hashlib.sha256(f"{identity(self)} {source_digest()}".encode()).hexdigest()


def _checked_changes(changes, steps):
    """`changes` as a tuple. Raises ValueError unless they are (step, agent) pairs in order, within the run."""
    pairs, least = [], 0
    for pair in checks.several("changes", changes):
        if len(checks.several("changes", pair)) != 2:
            raise checks.error("changes", "pairs (step, agent)", pair)
        least = checks.integer("step of a change", pair[0], at_least=least, at_most=steps)
        pairs.append((least, checks.instance("agent of a change", pair[1], Agent)))
    return tuple(pairs)


def source_digest():
    """A digest of the source of every module that takes part in a run."""
    return digest_of_source(*PARTS)


source_digest()  # on import, since the files may change while this process goes on with their code
