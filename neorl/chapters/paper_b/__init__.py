"""What the notebook of paper B runs and draws, on agents with place cells, with object-vector cells and with both."""
