"""Worlds for agents to live in: `WaterWorld`, the rollout of an agent in it, and kernels that probe a rollout.

The room uses `neorl.core`.
"""
