"""Independent runs side by side, where `neorl.simulate` does not compute them: kernels run in parallel in threads."""

from concurrent.futures import ThreadPoolExecutor


def each_run(run_one, runs, threads=2):
    """What run_one(k) returns of each run k: a list. threads: at most; another page is computed beside this one."""
    with ThreadPoolExecutor(threads) as cores:
        return list(cores.map(run_one, range(runs)))
