"""Experiments, figures and sentences of chapter 1."""
