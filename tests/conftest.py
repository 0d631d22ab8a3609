"""Settings of the test suite."""

from hypothesis import settings

# No deadline: a kernel compiles on its first call. Derandomised: a test that fails here fails everywhere.
settings.register_profile("neorl", deadline=None, derandomize=True)
settings.load_profile("neorl")
