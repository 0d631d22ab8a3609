"""Paper A: agents with one map, and with three."""
