"""What computes: the pages of notebooks, the record of claims, and samples of runs that check both."""
