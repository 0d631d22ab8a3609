"""What the page "Is it general?" runs and draws: one rule of learning in several spaces, and Kaelbling's properties."""
