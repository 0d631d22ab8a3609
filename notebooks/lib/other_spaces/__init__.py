"""The page "Is it general?": one learning rule in several spaces, and Kaelbling's properties."""
