"""Figures and trials of paper B: agents with place cells, with object-vector cells, and with both."""
