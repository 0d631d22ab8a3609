"""What the notebook of chapter 3 runs and draws, namely decision processes, ensembles, hybrid reward."""
