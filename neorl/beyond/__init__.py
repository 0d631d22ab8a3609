"""What goes beyond the thesis: learners of maps that hold something else than the values of goal cells."""
