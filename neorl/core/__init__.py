"""The agent as kernels see it: random streams, modalities, maps, the Horde, networks of nodes, and the loop.

Kernels take flat arrays and scalars (`neorl.kernels.kernel` has their rules); they compute every number of the book.
"""
