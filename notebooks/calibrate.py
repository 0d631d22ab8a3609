"""Make the table of calibrated readings, or add to it: ``python notebooks/calibrate.py --minutes 45``, from the root.

It continues the existing table; ``--anew`` starts a new one. ``--refine 20`` searches near the leading readings for 20
minutes instead, ``--screen 12`` runs promising readings again, ``--rescale 2 4`` then tries these scales for the
leading one, ``--confirm 20 --fresh-runs 100`` runs the leading ones again, and once more if it is called again, and
``--set-back 10`` runs the default reading with one choice at a time set back to the letter.
``--memory 20 45`` confines refining and confirming to such memories. ``--try learning_rate=0.01,memory=30`` first adds
the default reading with these choices, so that a search can begin there. With ``--minutes 0`` nothing else is run. It
can be interrupted at any time: the file is written whenever readings are finished, and results are cached as those of
pages are.
"""

import argparse
import time
from ast import literal_eval
from pathlib import Path

from companion.study import calibration
from companion.study.calibration_results import progress
from companion.study.calibration_table import SHIPPED, read_table, write_table
from companion.study.calibration_targets import GROUPS
from companion.thesis.reading import Reading


def main():
    chosen = parse_arguments()
    table = [] if chosen.anew or not chosen.table.exists() else read_table(chosen.table)
    chosen.table.parent.mkdir(parents=True, exist_ok=True)
    begin = time.monotonic()

    def keep(rows):
        write_table(rows, chosen.table)
        print(f"{(time.monotonic() - begin) / 60:.1f} minutes: {summary(rows)}", flush=True)

    if chosen.attempts:
        table = calibration.attempt(table, chosen.attempts, chosen.refined_runs, chosen.seed)
        keep(table)
    if chosen.screen:
        table = calibration.screen(table, chosen.screen, seed=chosen.seed)
        keep(table)
    elif chosen.set_back:
        table = calibration.set_back(table, chosen.set_back, seed=chosen.seed)
        keep(table)
    elif chosen.refine:
        table = calibration.refine(chosen.refine, table, chosen.refined_runs, seed=chosen.seed, keep=keep,
                                   memories=chosen.memory)
    else:
        table = calibration.calibrate(chosen.minutes, table, seed=chosen.seed, runs=chosen.runs, steps=chosen.steps,
                                      keep=keep)
    if chosen.rescale:
        table = calibration.rescale(table, chosen.rescale, chosen.screen or chosen.refined_runs)
        keep(table)
    if chosen.confirm:
        keep(calibration.confirm(table, chosen.confirm, chosen.fresh_runs, seed=chosen.seed,
                                 memories=chosen.memory))


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--minutes", type=float, default=45, help="how long (default 45)")
    parser.add_argument("--runs", type=int, default=calibration.RUNS, help=f"runs per condition ({calibration.RUNS})")
    parser.add_argument("--steps", type=int, default=calibration.STEPS, help=f"steps per run ({calibration.STEPS})")
    parser.add_argument("--refine", type=float, metavar="MINUTES", help="search near the leading readings instead")
    parser.add_argument("--refined-runs", type=int, default=6, help="runs per condition of these (6)")
    parser.add_argument("--memory", type=float, nargs=2, metavar=("LOW", "HIGH"),
                        help="search and confirm only readings with a memory in this range, in cells")
    parser.add_argument("--try", type=varied, action="append", dest="attempts", metavar="CHOICES", default=[],
                        help="run a reading first: the default one with choices such as learning_rate=0.01,memory=30")
    parser.add_argument("--rescale", type=float, nargs="*", default=(),
                        help="scales of desires to try in paper C, for the leading one (none)")
    parser.add_argument("--screen", type=int, metavar="RUNS", help="run promising readings of the waves again instead")
    parser.add_argument("--set-back", type=int, metavar="RUNS",
                        help="run the default reading with single choices of the letter instead")
    parser.add_argument("--confirm", type=int, default=12, help="nearest readings to run again at the end (12)")
    parser.add_argument("--fresh-runs", type=int, default=20, help="runs per condition of these (20)")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--table", type=Path, default=SHIPPED, help="the file (by default the study's)")
    parser.add_argument("--anew", action="store_true", help="start a new table in place of the existing one")
    return parser.parse_args()


def varied(text):
    """The default reading with the choices of a text, such as "learning_rate=0.01,memory=30,credit=share"."""
    reading = Reading()
    for name, value in (each.split("=") for each in text.split(",")):
        is_word = isinstance(reading.choices.get(name), str)
        reading = reading.varied(**{name: value if is_word else type(reading.choices.get(name))(literal_eval(value))})
    return reading


def summary(rows):
    """The number of readings, in all and in each group, and the smallest distance so far."""
    groups = ", ".join(f"{sum(group in row.groups for row in rows)} {group}" for group in GROUPS)
    last = max(row.wave for row in rows)
    return f"wave {last}, {len(rows)} readings ({groups}), nearest {progress(rows)[last]:.2f}"


if __name__ == "__main__":
    main()
