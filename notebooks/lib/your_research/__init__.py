"""The page "In your research": neoRL agents whose scenes are decoded from the firing of simulated neurons."""
