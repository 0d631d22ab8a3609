"""What the notebook of chapter 4 runs and draws: credit, superposition, time scales, cost."""
