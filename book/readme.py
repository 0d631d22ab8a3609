"""Write the recorded claims into the README, by verdict: ``make readme``, after ``make record``."""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.append(str(ROOT / "notebooks"))  # has what pages share

# ruff: noqa: E402
import ledger
from companion.page import report, wording
from companion.page.marks import symbol
from companion.thesis.statements import AGENTS, DEMONSTRATIONS, STATEMENTS
from record import of_book

BETWEEN = re.compile(r"(?<=<!-- claims: make readme -->\n).*(?=<!-- end of claims -->)", re.S)


def main():
    readme, build = ROOT / "README.md", report.load(sorted((ROOT / "book" / "chapters").glob("*.claims.json")))
    written = by_verdict(of_book(build))
    readme.write_text(BETWEEN.sub(lambda _: written, readme.read_text(encoding="utf-8")), encoding="utf-8")


def by_verdict(record):
    """The headline of the first page, then claims and demonstrations by verdict, in Markdown.

    Our number stands where the thesis prints one. record: as `report.load` returns it, or committed.
    """
    about_agents, apart, demonstrations = (
        wording.table(["Verdict", "Claims"], [
            [f"{symbol(kind)}\u00a0{kind}", "; ".join(_beside_thesis(record, name) for name in some
                                                       if report.verdict(record, name) == kind)]
            for kind in ledger.counts(record, some)])
        for some in (AGENTS, ledger.APART, DEMONSTRATIONS))
    return "\n\n".join([ledger.headline(record), about_agents, "Counted apart:", apart, report.BESIDE,
                        demonstrations]) + "\n"


def _beside_thesis(record, name):
    statement, found = STATEMENTS[name], record["claims"].get(name)
    numbers = ""
    if found and statement.bounds.number is not None:
        numbers = f" ({statement.thesis}; here {report.number(found)})"
    return f"**{name}** {statement.text}{numbers}"


if __name__ == "__main__":
    main()
