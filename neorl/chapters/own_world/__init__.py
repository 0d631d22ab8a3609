"""What the page "Bring your own world" runs: worlds, an environment and rules as a user of the package writes them."""
