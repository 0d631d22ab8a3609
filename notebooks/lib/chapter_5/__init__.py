"""Experiments and sentences of chapter 5: the two conclusions of the thesis, demonstrated."""
