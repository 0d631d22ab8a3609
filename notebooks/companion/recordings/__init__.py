"""Learning from recordings: animals that were recorded, pilots that watched them, and files of recordings."""
