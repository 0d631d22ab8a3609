"""The kernels of random streams, modalities, maps, the Horde, networks of nodes, and the life of an agent.

Kernels take flat arrays and scalars (`neorl.core.kernel` has their rules); they compute every number of the book. This
room depends on `neorl.checks`, `neorl.extras` and `neorl.files` alone.
"""
