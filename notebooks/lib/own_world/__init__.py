"""The page "Bring your own world": worlds, an environment and rules as a user of the package writes them."""
