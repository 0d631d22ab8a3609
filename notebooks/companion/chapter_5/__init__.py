"""The conclusions of the thesis, and the trials that ask whether they stand."""
