"""Purpose: an animal that knows how to get everywhere goes where it wants to be (thesis section 2.1.2)."""

LONGEST_WAY = 20  # steps, after which the animal is taken out


def steps_to(goal, grid, q, start):
    """How many steps the best actions of q (states, 4) take from a start to a goal in a `Grid`, None if they do not.

    Of several best actions it is the first that counts. They have `LONGEST_WAY` steps to get there.
    """
    state = start
    for steps in range(LONGEST_WAY + 1):
        if state == goal:
            return steps
        state = int(grid.next_state[state, q[state].argmax()])
    return None
