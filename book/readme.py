"""Write the claims of the last build into the README, in short: ``make readme``, after ``make book``."""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.append(str(ROOT / "notebooks"))  # has what pages share

from lib.shared import report  # noqa: E402

BETWEEN = re.compile(r"(?<=<!-- claims: make readme -->\n).*(?=<!-- end of claims -->)", re.S)


def main():
    readme = ROOT / "README.md"
    table = report.in_short(report.load(sorted((ROOT / "book" / "chapters").glob("*.claims.json"))))
    readme.write_text(BETWEEN.sub(lambda _: table, readme.read_text(encoding="utf-8")), encoding="utf-8")


if __name__ == "__main__":
    main()
