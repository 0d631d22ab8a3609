"""Counts of what is reproduced, in the same words everywhere: by kind of claim, which are never added up.

Claims about agents; apart from these what is proved or counted, what is about this book's code, and what the author
reports; and apart from all our own demonstrations.
"""

from companion.page.report import PART_OF
from companion.thesis.reading import NAMES
from companion.thesis.statements import STATEMENTS

KINDS = {"agents": "Claims about agents", "proof": "What is proved or counted", "counting": "What is proved or counted",
         "code": "What is about our code", "report": "What the author reports",
         "demonstration": "Our demonstrations, which are no claims of the thesis"}  # of a statement, in words


def by_kind(names):
    """Names of claims by what they are, {words of `KINDS`: names}, those that have any."""
    found = {words: [] for words in KINDS.values()}
    for name in names:
        found[KINDS[STATEMENTS[name].kind]].append(name)
    return {words: tuple(chosen) for words, chosen in found.items() if chosen}


def reproduced(found, names):
    """How many of some claims are reproduced, and how many are judged. found: claims of a record, under one reading."""
    verdicts = [found[name]["verdict"] for name in names if name in found]
    return verdicts.count("reproduced"), len(verdicts)


def sentence(record, names):
    """How many claims of each kind are reproduced under the readings that judge them, in a sentence; "" without any."""
    parts = []
    for words, chosen in by_kind(names).items():
        several = any(name in record["letter"] for name in chosen)
        counts = {reading: reproduced(record[part], chosen) for reading, part in PART_OF.items()}
        each = [f"{count} of {judged}{f' {NAMES[reading]}' if several else ''}"
                for reading, (count, judged) in counts.items() if judged]
        parts += [f"of {words[0].lower()}{words[1:]}: {', '.join(each)}"] if each else []
    return f"Reproduced, {'; apart from these, '.join(parts)}." if parts else ""
