"""The code on the book's page about Gymnasium prints what the page says."""

import contextlib
import io
import re
from pathlib import Path

PAGE = Path(__file__).parents[2] / "book" / "gym.md"
BLOCK = re.compile(r"```python\n(.*?)```(?:\n\n```text\n(.*?)```)?", re.DOTALL)


def run(source, scope):
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(source, scope)
    return printed.getvalue()


def test_the_page_prints_what_it_says():
    blocks, scope = BLOCK.findall(PAGE.read_text(encoding="utf-8")), {}
    assert len(blocks) == 5
    for source, output in blocks:
        if "stable_baselines3" not in source:
            assert run(source, scope) == output
