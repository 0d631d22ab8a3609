"""The kernels of random streams, modalities, maps, the Horde, networks of nodes, and the life of an agent.

Kernels take flat arrays and scalars (`neorl.core.kernel` has their rules); they compute every number of the book.
"""
