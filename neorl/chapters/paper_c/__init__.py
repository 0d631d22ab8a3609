"""Paper C: networks of desires."""
