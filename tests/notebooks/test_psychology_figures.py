"""Figures of learning in boxes, mazes and neurons."""

import numpy as np
from matplotlib import pyplot as plt

from lib.chapter_2 import psychology_figures


def test_curves_over_sessions_are_named_where_they_differ():
    curves = {"high": np.array([[9.0, 9, 9, 8, 8, 8]]), "low": np.array([[9.0, 9, 9, 2, 2, 8]])}
    psychology_figures.draw_sessions(curves, {"first": 0, "then": 3}, "presses")
    names = {text.get_text(): text.xy for text in plt.gca().texts if text.get_text() in curves}
    assert names == {"high": (5, 8), "low": (5, 2)}
