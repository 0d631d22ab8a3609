"""Independent runs side by side, where `neorl.simulate` does not compute them: kernels run in parallel in threads."""

import os
from concurrent.futures import ThreadPoolExecutor


def each_run(live, runs, threads=None):
    """What live(0) to live(runs - 1) return: a list. threads: at most, by default one per core."""
    with ThreadPoolExecutor(threads or os.cpu_count()) as cores:
        return list(cores.map(live, range(runs)))
