"""Extensions of Sphinx: docstrings, terms, buttons, and how pages are typeset."""
