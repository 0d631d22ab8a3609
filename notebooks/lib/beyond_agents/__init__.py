"""The page "Beyond the thesis: the agent": its experiments, figures and sentences."""
