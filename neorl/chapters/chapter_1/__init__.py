"""What the notebook of chapter 1 runs and draws."""
