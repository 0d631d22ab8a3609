"""Experiments, figures and sentences of chapter 4: credit, superposition, time scales, cost."""
