"""The commands ``python -m neorl run experiment.toml`` and ``python -m neorl cache``."""

import argparse
import os
import sys

from neorl.common import files
from neorl.experiments import store
from neorl.experiments.condition import PARTS, Condition
from neorl.experiments.simulation import label, simulate
from neorl.kernels.identity import can_cache


def main(arguments=None):
    """Run a command from its arguments, by default those of this process. Returns the exit status."""
    parser = argparse.ArgumentParser(prog="python -m neorl", description="Run conditions, and inspect the cache.")
    commands = parser.add_subparsers(required=True, metavar="command")
    run = commands.add_parser("run", help="run the condition described in a file",
                              description="Run the condition in a file, written by neorl.Condition.save or by hand, "
                              "unless it is cached already, and report its reward.")
    run.add_argument("file", help="a name that ends in .toml or .json")
    run.add_argument("--save", metavar="result.npz", help="also write the result there, for neorl.Result.load")
    run.set_defaults(call=lambda given: run_file(given.file, given.save))
    cache = commands.add_parser("cache", help="list the cache on disk, or clear it",
                                description="List the contents of the cache folder, which NEORL_CACHE may name. All "
                                "of it may be removed at any time, and is recreated when needed.")
    cache.add_argument("--clear", action="store_true", help="remove all of it")
    cache.set_defaults(call=lambda given: clear_cache() if given.clear else list_cache())
    given = parser.parse_args(arguments)
    try:
        given.call(given)
        sys.stdout.flush()
    except BrokenPipeError:  # the reader of a pipe, such as head, has closed it
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except (ValueError, OSError, ImportError, MemoryError, RuntimeError) as error:
        print(f"neorl: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("neorl: interrupted; finished runs are kept, and the same command resumes there", file=sys.stderr)
        return 130
    return 0


def run_file(path, save=None):
    """Run the condition in a file, and print its result.

    path: as in `neorl.Condition.load`. save: where to write the result to, or None.
    Raises what `neorl.Condition.load`, `simulate` and `neorl.Result.save` raise.
    """
    condition = Condition.load(path)
    result = simulate(**condition.choices, cache=True)
    if save:
        result.save(save)
    rate = result.rate()
    spread = f", with a standard deviation over runs of {rate.std(ddof=1):.3f}" if result.runs > 1 else ""
    print(f"{label(condition.agent)} in {type(condition.world).__name__}, {condition.steps:,} steps, "
          f"{condition.runs} run{'s' * (condition.runs != 1)}, seed {condition.seed}")
    print(f"  reward per second: {rate.mean():.3f}{spread}")
    if save or can_cache(*PARTS):
        print(f"  kept in {save or files.cache_folder()}")


def list_cache():
    """Print the contents of the cache."""
    print(files.cache_folder())
    everything = store.kept()
    for kind, (words, _) in store.KINDS.items():
        print(f"{words}: {_amount([each for each in everything if each.kind == kind])}")
    print(f"together: {_amount(everything)}")


def clear_cache():
    """Clear the cache, and print how much was removed."""
    print(f"removed from {files.cache_folder()}: {_amount(store.clear())}")


def _amount(some):
    return f"{len(some)} file{'s' * (len(some) != 1)}, {sum(each.size for each in some) / 1e6:,.3f} MB"
