"""Single runs, many runs of a condition, the cache of finished conditions, and sweeps of many.

The room uses `neorl.agents`, `neorl.worlds` and what lies below them.
"""
