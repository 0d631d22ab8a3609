"""A neoRL agent in a Gymnasium environment.

The agent perceives a `Scene`, which a user-defined function makes from an observation: where the agent is in some
space, and where things are in it. Any space in which near means similar will do, such as the position and velocity of a
car. Rewards are recorded but not perceived, except by desires of learned valence: the agent's goals are its desires.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from neorl.agents.agent import Agent
from neorl.agents.learner import Learner
from neorl.common import checks
from neorl.common.extras import require
from neorl.core.scene import Actions, Scene

gymnasium = require("gymnasium", extra="gym")


@dataclass(frozen=True, eq=False)
class Played:
    """The outcome of running an agent in an environment.

    learner: the agent with all that it has learned, a `neorl.Learner`. rewards: float64 (steps,).
    terminated, truncated: bool (steps,), whether an episode was over after a step.
    """

    learner: Learner
    rewards: NDArray[np.float64]
    terminated: NDArray[np.bool]
    truncated: NDArray[np.bool]

    __eq__ = checks.equal_fields

    @property
    def ends(self) -> NDArray[np.int64]:
        """int64 (episodes,): the number of steps taken when each episode was over, without an unfinished last one."""
        return 1 + np.flatnonzero(self.terminated | self.truncated)

    @property
    def lengths(self) -> NDArray[np.int64]:
        """int64 (episodes,): the number of steps of each finished episode."""
        return np.diff(self.ends, prepend=0)

    @property
    def returns(self) -> NDArray[np.float64]:
        """float64 (episodes,): the sum of the rewards of each finished episode."""
        return np.diff(np.cumsum(self.rewards)[self.ends - 1], prepend=0.0)


def play(agent: Agent | Learner, env: Any, scene: Callable[[Any, dict[str, Any]], Scene], *, steps: int,
         actions: Actions | None = None, commands: Sequence[Any] | None = None, seed: int = 0,
         **surroundings: Any) -> Played:
    """Run a learning agent in a Gymnasium environment, and return the outcome, a `Played`.

    agent: an `Agent`, which begins untrained, or a `Learner`, which continues from what it has learned.
    env: a `gymnasium.Env`. A finished episode is followed by another.
    scene: a function of (observation, info) that returns the `Scene` perceived by the agent.
    steps: the number of steps to take, ≥ 0.
    actions: the agent's `Actions`; by default one for each command, with pushes of 0, which suffices unless the source
        of a desire is a node.
    commands: the argument of `env.step` for each of the actions, in the order of `Actions.all_names`, idleness last; by
        default the numbers of the Discrete space in order.
    seed: integer ≥ 0, of the environment and of the agent's random numbers.
    surroundings: things, kinds, size and fps, as in `Learner`, for an `Agent`.

    Raises ValueError for anything else, for scenes that do not fit, and for rewards that are not numbers.
    """
    checks.instance("env", env, gymnasium.Env)
    steps, seed = checks.integer("steps", steps, at_least=0), checks.integer("seed", seed, at_least=0)
    if not callable(scene):
        raise checks.error("scene", "a function of (observation, info) that returns a Scene", scene)
    if commands is None and not isinstance(env.action_space, gymnasium.spaces.Discrete):
        raise checks.error("commands", "the values that env.step takes, one for each action, since the action space is "
                           f"{env.action_space}", commands)
    first = _seen(scene, *env.reset(seed=seed))
    if commands is None:
        commands = range(env.action_space.start, env.action_space.start + env.action_space.n)
    commands = checks.several("commands", commands)
    learner = _learner(agent, actions, len(commands), len(first.position), seed, surroundings)
    names = learner.world.actions.all_names
    if len(commands) != len(names):
        raise checks.error("commands", f"{len(names)} values, one for each of {names}", commands)
    rewards, terminated, truncated = np.zeros(steps), np.zeros(steps, bool), np.zeros(steps, bool)
    learner.begin(first)
    for now in range(steps):
        observation, reward, terminated[now], truncated[now], info = env.step(commands[learner.act()])
        rewards[now] = checks.real("the reward that env.step returns", +reward if isinstance(reward, bool) else reward)
        learner.observe(_seen(scene, observation, info), float(rewards[now]))
        if (terminated[now] or truncated[now]) and now + 1 < steps:
            learner.begin(_seen(scene, *env.reset()))
    return Played(learner, rewards, terminated, truncated)


def _learner(agent, actions, n_actions, axes, seed, surroundings):
    """The `Learner` that `play` is given, or a new one."""
    if isinstance(agent, Learner):
        if actions is not None or surroundings:
            raise ValueError("actions and surroundings must be left out beside a Learner, which has its own, but are "
                             "given")
        return agent
    if not isinstance(agent, Agent):
        raise checks.error("agent", "an Agent or a Learner", agent)
    if actions is None:
        actions = Actions([str(number) for number in range(n_actions)], [(0.0,) * axes] * n_actions)
    return Learner(agent, actions=actions, seed=seed, **surroundings)


def _seen(scene, observation, info):
    """The scene of an observation."""
    return checks.instance("scene(observation, info)", scene(observation, info), Scene)
