"""What the notebook of chapter 5 runs and reports, namely the two conclusions of the thesis, demonstrated."""
