"""Experiments, figures and sentences of chapter 3: decision processes, ensembles, hybrid reward."""
