"""Experiments and sentences of paper C: networks of desires."""
