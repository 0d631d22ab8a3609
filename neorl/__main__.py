"""``python -m neorl``: run an experiment that a file describes, or see what is kept on disk."""

import sys

from neorl.experiments.command import main

if __name__ == "__main__":
    sys.exit(main())
