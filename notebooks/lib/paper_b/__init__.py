"""Experiments, figures and sentences of paper B: agents with place cells, with object-vector cells, and with both."""
