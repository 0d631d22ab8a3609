"""What it wanted while it learned: the page's yoked experiment, its predictions, and what its recorded runs show."""
