"""Yoked agents: one learns from exactly what another has done, scene by scene and action by action.

A partner has a world of its own that begins as the actor's did, and takes the actor's actions in it. A world draws its
random numbers from its own state, so all scenes are the same to the last bit. What an agent desires plays no part in
what it learns: a partner with the actor's rule of learning and other desires learns the same values, to the last bit.
"""

import functools

from neorl import Run
from neorl.core.functions import Loop
from neorl.core.layout import Memory, Record
from neorl.core.scene import Scene
from neorl.custom import execute, kernel
from neorl.kernels.annotations import fields
from neorl.kernels.kernel import inlined


class Partner(Run):
    """A `neorl.Run` that takes given actions instead of its own choices."""

    def follow(self, actions):
        """Take these actions, int64 (steps,), as if it had chosen them, and learn from what comes of them."""
        with self._alone.call("follow"):
            execute(_following(self.world.dynamics), *self._loop, self._world_state, self.world.rules, actions)
            self._progress += len(actions)
            self._check_faults()


@functools.cache
def _following(dynamics):
    """The kernel of a partner in a world of given `Dynamics`."""
    reset, step = dynamics.reset, inlined(dynamics.step)
    world_type, rules_type = fields(reset)["state"], fields(reset)["rules"]

    @kernel
    def follow(agent: Record, memory: Memory, scene: Scene, loop: Loop, world_state: world_type, rules: rules_type,
               actions):
        for action in actions:
            agent.last_event = action
            reward, done = step(world_state, rules, action)
            agent.reward = reward
            loop.observe(agent, memory, scene, loop.functions)
            if done:
                reset(world_state, rules)
                if agent.notices_resets:
                    loop.begin(agent, memory, scene, loop.functions)

    return follow
