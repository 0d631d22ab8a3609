"""What the notebook of paper C runs and draws, on networks of desires."""
