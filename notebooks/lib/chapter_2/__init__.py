"""Experiments, figures and sentences of chapter 2: how animals learn, and tuned cells."""
