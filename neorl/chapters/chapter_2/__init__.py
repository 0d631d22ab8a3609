"""What the notebook of chapter 2 runs, draws and says: how animals learn, latent learning, cells that are tuned."""
