"""What the notebook of chapter 2 runs, draws and says, namely how animals learn, and cells that are tuned."""
