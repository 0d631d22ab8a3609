"""What the page "Beyond the thesis: the agent" needs beside its experiments: the searches for settings, and figures."""
