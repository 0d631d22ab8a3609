"""Figures of agents, networks, boards and curves.

The room uses `neorl.evidence` and what lies below it.
"""
