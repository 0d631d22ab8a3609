"""Write what the record says of the thesis into the README: ``make readme``, after ``make record``."""

import re

from companion.page import report, wording
from computing.compute import ROOT

from writing.answer import REPRODUCED, headline, reproduced, turned

BETWEEN = re.compile(r"(?<=<!-- claims: make readme -->\n).*(?=<!-- end of claims -->)", re.S)


def main():
    readme, written = ROOT / "README.md", found(report.record())
    readme.write_text(BETWEEN.sub(lambda _: written, readme.read_text(encoding="utf-8")), encoding="utf-8")


def found(record):
    """The headline of the first page, and how many claims are reproduced under both readings, in Markdown."""
    parts = headline(record), wording.table(REPRODUCED, reproduced(record)), turned(record)
    return "\n\n".join(filter(None, parts)) + "\n"


if __name__ == "__main__":
    main()
