"""Toy systems, and figures, that several pages share."""
