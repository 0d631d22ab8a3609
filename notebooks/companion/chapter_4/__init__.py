"""Toy systems and figures of chapter 4: walks and series, sums, two levers."""
