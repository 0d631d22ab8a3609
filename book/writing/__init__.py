"""What writes the other pages, the README and pictures from what was computed, and from the record."""
