"""What the page "Bring your own world" says of its runs."""

from lib.own_world import report


def test_the_box_has_what_is_learned_and_what_it_costs():
    text = report.in_short([5, 950, 960, 970], 0.01, 0.002, 1_000, 10)
    assert "The pad was found 4 times in 1,000 steps: 1 in the first tenth of the run and 3 in the last." in text
    assert "A step of the Python loop took 10 microseconds" in text and "it took 0.2 microseconds." in text
