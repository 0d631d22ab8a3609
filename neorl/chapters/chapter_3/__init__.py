"""What the notebook of chapter 3 runs and draws: decision processes, ensembles, hybrid reward."""
