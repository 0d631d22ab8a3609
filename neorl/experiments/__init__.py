"""Single runs, the runs of a condition, sweeps over conditions, and the cache of finished ones."""
