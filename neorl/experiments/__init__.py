"""Experiments: runs, many runs of a condition, what is finished kept on disk, and many conditions at a time.

The room uses `neorl.agents`, `neorl.worlds` and what lies below them.
"""
