"""What judges this one thesis: its claims, their rules and verdicts, and readings of the text."""
