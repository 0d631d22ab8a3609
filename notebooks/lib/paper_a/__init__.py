"""Experiments, figures and sentences of paper A: agents with one map, and with three."""
