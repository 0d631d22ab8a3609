"""The toy systems of chapter 3, and its figures."""
