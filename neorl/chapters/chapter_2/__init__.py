"""What the notebook of chapter 2 runs and draws: learning by animals, latent learning, and cells that are tuned."""
