"""The code on the book's page about Gymnasium prints what the page says."""

import contextlib
import io
import re
from pathlib import Path

import pytest

PAGE = Path(__file__).parents[2] / "book" / "gym.md"
BLOCK = re.compile(r"```python\n(.*?)```(?:\n\n```text\n(.*?)```)?", re.DOTALL)
OTHERS = "stable_baselines3"


def run(source, scope):
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(source, scope)
    return printed.getvalue()


def test_the_page_prints_what_it_says():
    blocks, scope = BLOCK.findall(PAGE.read_text(encoding="utf-8")), {}
    assert len(blocks) == 5
    for source, output in blocks:
        if OTHERS not in source:
            assert run(source, scope) == output


def test_an_agent_of_stable_baselines_learns_in_waterworld():
    pytest.importorskip(OTHERS)
    scope = {}
    for source, _ in BLOCK.findall(PAGE.read_text(encoding="utf-8"))[:3]:
        run(source, scope)
    assert scope["learned"] > 1.5 * max(scope["random"], 0.1)
