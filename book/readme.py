"""Write the claims of the last build into the README, by verdict: ``make readme``, after ``make book``."""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.append(str(ROOT / "notebooks"))  # has what pages share

# ruff: noqa: E402
import ledger
from lib.shared import report, wording
from lib.shared.marks import NOT_COMPUTED, symbol
from neorl.evidence.statements import CLAIMS, DEMONSTRATIONS, STATEMENTS
from neorl.evidence.verdict import VERDICTS

BETWEEN = re.compile(r"(?<=<!-- claims: make readme -->\n).*(?=<!-- end of claims -->)", re.S)


def main():
    readme = ROOT / "README.md"
    written = by_verdict(report.load(sorted((ROOT / "book" / "chapters").glob("*.claims.json"))))
    readme.write_text(BETWEEN.sub(lambda _: written, readme.read_text(encoding="utf-8")), encoding="utf-8")


def by_verdict(record):
    """The sentence of the first page, then claims and demonstrations by verdict, in Markdown.

    Our number stands where the thesis prints one. record: as `report.load` returns it.
    """
    claims, demonstrations = (
        wording.table(["Verdict", "Claims"], [
            [f"{symbol(kind)}\u00a0{kind}", "; ".join(_beside_thesis(record, name) for name in some
                                                       if report.verdict(record, name) == kind)]
            for kind in (*VERDICTS, NOT_COMPUTED) if any(report.verdict(record, name) == kind for name in some)])
        for some in (CLAIMS, DEMONSTRATIONS))
    return "\n\n".join([ledger.sentence(record), claims, report.BESIDE, demonstrations]) + "\n"


def _beside_thesis(record, name):
    statement, found = STATEMENTS[name], record["claims"].get(name)
    numbers = ""
    if found and statement.bounds.number is not None:
        numbers = f" ({statement.thesis}; here {report.number(found)})"
    return f"**{name}** {statement.text}{numbers}"


if __name__ == "__main__":
    main()
