"""Purpose: an animal that knows how to get everywhere goes where it wants to be (thesis section 2.1.2)."""

LONGEST_WAY = 20  # steps, after which the animal is taken out


def steps_to(goal, grid, q, start):
    """The number of steps from start to goal in a `Grid` by the best actions of q (states, 4), None if they fail.

    Of several best actions the first is taken. The limit is `LONGEST_WAY` steps.
    """
    state = start
    for steps in range(LONGEST_WAY + 1):
        if state == goal:
            return steps
        state = int(grid.next_state[state, q[state].argmax()])
    return None
