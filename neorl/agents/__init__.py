"""Agents as data (nodes, desires, learning, policy), the agents of the papers, and what the kernels take of them.

The room uses `neorl.core`.
"""
