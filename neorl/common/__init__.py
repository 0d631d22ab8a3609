"""Small things that all rooms use: checks of arguments, files, warnings, optional packages, a container's limits."""
