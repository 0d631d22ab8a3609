"""Independent runs side by side, where `neorl.simulate` does not compute them: kernels run in parallel in threads."""

from concurrent.futures import ThreadPoolExecutor


def each_run(live, runs, threads=2):
    """What live(0) to live(runs - 1) return: a list. threads: at most; another page is computed beside this one."""
    with ThreadPoolExecutor(threads) as cores:
        return list(cores.map(live, range(runs)))
