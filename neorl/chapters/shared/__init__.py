"""What the notebooks of several chapters use."""
