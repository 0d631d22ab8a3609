"""``python -m neorl``: run an experiment described by a file, or inspect the cache on disk."""

import sys

from neorl.experiments.command import main

if __name__ == "__main__":
    sys.stdout.reconfigure(errors="backslashreplace")  # names may have letters that a terminal lacks
    sys.exit(main())
