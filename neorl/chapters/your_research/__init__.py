"""What the page "In your research" runs: neoRL agents whose scenes are read from the firing of simulated neurons."""
