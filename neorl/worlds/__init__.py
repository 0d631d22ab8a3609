"""Worlds for agents to live in, so far `WaterWorld`, with the rollout of an agent and kernels that probe one.

The room uses `neorl.core`.
"""
