"""The toolkit of pages: what every notebook needs beside its own experiment.

`begin` checks the parameters, `judge` and `judge_papers` the claims about what was run; `found` is the box that opens a
page, `verdicts` its table of claims, and `save` the record of them. The rest is numbers, tables and parts of figures.
"""

from companion.page.beginning import begin, listed, source
from companion.page.judging import by_condition, judge, judge_papers, papers_conditions
from companion.page.opening import found
from companion.page.panels import UNDER_WHITE, add_arrow, add_curves, draw_means
from companion.page.report import comparison, errata, load, save, verdicts
from companion.page.thesis_figures import mark_levels
from companion.page.wording import number, scientific, table

__all__ = ["UNDER_WHITE", "add_arrow", "add_curves", "begin", "by_condition", "comparison", "draw_means", "errata",
           "found", "judge", "judge_papers", "listed", "load", "mark_levels", "number", "papers_conditions", "save",
           "scientific", "source", "table", "verdicts"]
