"""Toy systems and figures of chapter 2."""
