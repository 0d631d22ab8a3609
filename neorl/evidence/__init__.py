"""Statistics, claims with their rules and verdicts, readings of the text, and what the text fixes."""
