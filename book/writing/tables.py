"""Write what the book's other pages include of the computed ones: claims, rules, errata, contents in pictures, and
the living part of the front page."""

from companion.page import report
from computing.compute import CHAPTERS, ROOT

from neorl.common.files import write_whole
from writing import contents, front, ledger, rules


def pages(chapters):
    """The texts to include, {name of the file: text}. chapters: the folder of the computed pages."""
    record, toc = report.record(), (ROOT / "book" / "_toc.yml").read_text(encoding="utf-8")
    return {"claims-rules.md": rules.page(record), "claims-front.html": ledger.front(record),
            "star.html": front.page(), "errata-table.md": report.errata(),
            "contents.md": contents.pictures(toc, chapters), "claims-table.md": ledger.page(record)}


if __name__ == "__main__":
    for name, text in pages(CHAPTERS).items():  # last the one that make looks for
        write_whole(CHAPTERS / name, text.encode())
