"""The page of the agent in one file: its cells hold for other agents than its own."""

from page_cells import executed


def test_the_figures_are_of_the_maps_that_the_agent_has():
    page = executed("agent_in_one_file", (("place_cells([n]", "place_cells([2, n]"),), runs=1, n=5)
    assert (page.nres_map.resolution, page.goal) == (2, 2)
