"""Run a row of the table of readings again: ``python notebooks/calibrate.py 17``, from the root, says what differs.

``--set-back 10`` adds rows to the table instead, with ten runs of each condition: the reading to the letter, and the
default reading with one choice at a time set back to it, where the table lacks them.
"""

import argparse
from dataclasses import replace
from pathlib import Path

from companion.study import calibration_table, sensitivity


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("row", type=int, nargs="?", help="its place in the table, 0 for the first")
    parser.add_argument("--set-back", type=int, metavar="RUNS", help="add rows, see above")
    parser.add_argument("--table", type=Path, default=calibration_table.SHIPPED, help="the file (the study's)")
    chosen = parser.parse_args()
    if (chosen.row is None) == (chosen.set_back is None):
        parser.error("name either a row or the runs of --set-back")
    table = calibration_table.read_table(chosen.table)
    if chosen.set_back:
        calibration_table.write_table(sensitivity.set_back(table, chosen.set_back), chosen.table)
    else:
        print(compared(table[chosen.row]))


def compared(row):
    """The statistics of a row, each beside the one that it has when it is run again, as lines."""
    again = replace(row, statistics={})
    for group in row.groups:
        (again,) = calibration_table.run([again], group)
    return "\n".join(f"{'equal' if again.statistics[name] == stored else 'differs'}: {name}, {stored.value} ± "
                     f"{stored.error}, and again {again.statistics[name].value} ± {again.statistics[name].error}"
                     for name, stored in row.statistics.items())


if __name__ == "__main__":
    main()
