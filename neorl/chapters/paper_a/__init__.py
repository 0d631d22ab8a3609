"""What the notebook of paper A runs and draws, on agents with one map, and with three."""
