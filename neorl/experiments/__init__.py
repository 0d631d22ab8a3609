"""Single runs, the runs of a condition, sweeps over conditions, and the cache of finished ones.

The room uses `neorl.agents`, `neorl.worlds` and what lies below them.
"""
