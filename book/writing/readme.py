"""Write what the record says of the thesis into the README: ``make readme``, after ``make record``."""

import re

from companion.page import report, wording
from computing.compute import ROOT
from computing.record import of_book

from writing.answer import BLOCKS, counts, headline

BETWEEN = re.compile(r"(?<=<!-- claims: make readme -->\n).*(?=<!-- end of claims -->)", re.S)


def main():
    readme, build = ROOT / "README.md", report.load(sorted((ROOT / "book" / "chapters").glob("*.claims.json")))
    written = found(of_book(build))
    readme.write_text(BETWEEN.sub(lambda _: written, readme.read_text(encoding="utf-8")), encoding="utf-8")


def found(record):
    """The headline of the first page, and the verdicts of both readings, in Markdown.

    record: as `report.load` returns it, or committed.
    """
    table = wording.table(["Claims", "", "To the letter", "Calibrated"], [
        [title, len(names), *(_verdicts(record[reading], names) for reading in ("letter", "claims"))]
        for title, names in BLOCKS.items()])
    return f"{headline(record)}\n\n{table}\n"


def _verdicts(found, names):
    judged = counts({"claims": found}, [name for name in names if name in found])
    return ", ".join(f"{number} {verdict}" for verdict, number in judged.items())


if __name__ == "__main__":
    main()
