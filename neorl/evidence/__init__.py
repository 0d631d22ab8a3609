"""Statistics, claims with their rules and verdicts, readings of the text, and their calibration.

The room uses `neorl.experiments` and what lies below it. It draws nothing.
"""
