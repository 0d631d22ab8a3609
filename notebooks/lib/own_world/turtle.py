"""A turtle in a room, with the interface of a Gymnasium environment.

It goes ahead, or turns left or right by 45°.
"""

import numpy as np

from neorl import Actions, Scene

TURTLE_ACTIONS = Actions(("ahead", "left", "right"),
                         ((0, 0), (0, 0), (0, 0)))
STRIDE, REACH, GOAL = 0.06, 0.12, (0.75, 0.25)


class Turtle:
    """`reset` and `step` as in Gymnasium.

    An observation is {"position": (2,), "heading": radians}.
    """

    def reset(self, seed=None):
        """Begin at a random place, in one of eight directions.

        Returns (observation, info).
        """
        self.rng = self.rng if seed is None else np.random.default_rng(seed)
        self.position, self.heading = self.rng.random(2), self.rng.integers(8)
        return self.observation(), {}

    def step(self, action):
        """Take an action.

        Returns (observation, reward, terminated, truncated, info).
        """
        self.heading = (self.heading + (0, -1, 1)[action]) % 8
        if action == 0:
            angle = self.heading * np.pi / 4
            ahead = np.array([np.cos(angle), np.sin(angle)])
            self.position = np.clip(self.position + STRIDE * ahead, 0, 1)
        found = bool(np.hypot(*(self.position - GOAL)) < REACH)
        return self.observation(), float(found), found, False, {}

    def observation(self):
        """The current observation."""
        heading = self.heading * np.pi / 4
        return {"position": self.position, "heading": heading}


def scene_of(observation):
    """The scene of an observation.

    The heading stands in for the direction of the velocity.
    """
    heading = observation["heading"]
    return Scene(observation["position"], (np.cos(heading), np.sin(heading)))
