"""What the notebook of chapter 1 runs, draws and says."""
