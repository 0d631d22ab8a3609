"""User-defined rules: credit, the feature of an axis, and a policy."""

from neorl import kernel, kernel_maker
from neorl.core.stream import randint, uniform


@kernel
def recent_credit(count, steps, last, activity):
    """Credit for events that happened, twice as much for the last one."""
    if last:
        return 1.0
    return 0.5 if count > 0 else 0.0


@kernel
def wall_distance(scene, point):
    """Distance of the agent from the nearest wall of a unit square."""
    x, y = scene.position[0], scene.position[1]
    return min(min(x, 1.0 - x), min(y, 1.0 - y))


@kernel_maker
def second_best(share):
    """The policy that takes the second-best action in a share of all steps, and otherwise the best."""

    @kernel
    def choose(value, stream):
        best, second = 0, -1
        for action in range(1, value.shape[0]):
            if value[action] > value[best]:
                best, second = action, best
            elif second < 0 or value[action] > value[second]:
                second = action
        if value[best] == value[second]:
            return randint(stream, value.shape[0])
        return second if uniform(stream) < share else best

    return choose
