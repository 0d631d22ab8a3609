"""The toolkit of pages: what every notebook needs beside its own experiment.

`answer` opens a page with what the record says of its claims. `begin` checks the parameters, `judge` and `judge_papers`
judge the claims about what was run, `verdicts` shows these beside the record, and `save` keeps them. The rest is
numbers, tables and parts of figures.
"""

from companion.page.behind import (add_recorded_levels, add_recorded_numbers, add_recorded_points,
                                   add_recorded_rates, add_recorded_totals, curves_of)
from companion.page.beginning import begin, listed, source
from companion.page.captions import final_levels, found, last_levels
from companion.page.judging import by_condition, judge, judge_papers, papers_conditions
from companion.page.panels import UNDER_WHITE, add_arrow, add_curves, draw_means
from companion.page.recorded import answer
from companion.page.report import comparison, errata, save, verdicts
from companion.page.thesis_figures import mark_levels
from companion.page.wording import number, scientific, table

__all__ = ["UNDER_WHITE", "add_arrow", "add_curves", "add_recorded_levels", "add_recorded_numbers",
           "add_recorded_points", "add_recorded_rates", "add_recorded_totals", "answer", "begin", "by_condition",
           "comparison", "curves_of", "draw_means", "errata", "final_levels", "found", "judge", "judge_papers",
           "last_levels", "listed", "mark_levels", "number", "papers_conditions", "save", "scientific", "source",
           "table", "verdicts"]
