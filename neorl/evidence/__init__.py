"""Statistics, claims with their rules and verdicts, readings of the text, and their calibration.

The room uses `neorl.experiments` and the rooms below it, and draws nothing.
"""
