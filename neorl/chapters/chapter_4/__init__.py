"""What the notebook of chapter 4 runs and draws, namely credit, superposition, time scales, cost."""
