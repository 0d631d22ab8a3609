"""The page of the agent in one file: its cells hold for other agents than its own."""

from matplotlib import pyplot as plt
from page_cells import planned

from neorl import place_cells


def test_the_figures_are_of_the_maps_that_the_agent_has():
    def two_maps(resolutions, **given):
        return place_cells([2, *resolutions], **given)

    page = planned("agent_in_one_file", "experiment", "values", runs=1, steps=50, n=5, place_cells=two_maps,
                   multimodal=two_maps, network_d=two_maps)
    assert (page["nres_map"].resolution, page["goal"]) == (2, 2)
    plt.close("all")
