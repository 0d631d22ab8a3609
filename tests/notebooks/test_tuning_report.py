"""Sentences and tables on reference frames and tuned cells."""

import numpy as np
import pytest

from lib.chapter_2.tuning import Information
from lib.chapter_2.tuning_report import (describe_drift, describe_frames, describe_information,
                                                   describe_likeness, describe_modules, describe_sizes,
                                                   information_table)
from neorl import NresMap

CELLS = {"place cell": "position", "head-direction cell": "direction", "speed cell": "speed"}


def informed(*others, unclear=()):
    """Cells with 2 bits about the variable of their own modality, and half a bit about others: (cell, variable)."""
    return {cell: {variable: Information(2.0, cell not in unclear) if variable == own else
                   Information(0.5 if (cell, variable) in others else 0.01, (cell, variable) in others)
                   for variable in CELLS.values()} for cell, own in CELLS.items()}


@pytest.mark.parametrize("length, when", [(1.0, "in both frames at every moment."),
                                          (1.25, "in both frames to within 0.2.")])
def test_the_frames_are_compared_while_the_animal_turns(length, when):
    allocentric = np.array([(1.0, 0.0), (1.0, 0.0), (0.8, -0.6)])
    seen = length * np.array([(1.0, 0.0), (0.0, -1.0), (0.8, -0.6)])
    words = describe_frames(np.arange(3), allocentric, seen, turned=2)
    assert f"change by 0.00, and those of the egocentric one by up to {length:.2f}. The distance" in words
    assert words.endswith(when)


def test_the_table_sets_clear_information_in_bold():
    assert information_table(informed(("speed cell", "position"))).splitlines() == [
        "| Cell | position | direction | speed |", "|---|---|---|---|", "| place cell | **2.00** | 0.01 | 0.01 |",
        "| head-direction cell | 0.01 | **2.00** | 0.01 |", "| speed cell | **0.50** | 0.01 | **2.00** |"]


def test_cells_informative_only_about_their_own_variable_are_reported_as_such():
    words = describe_information(informed())
    assert words.startswith("All of the 3 cells are most informative, and above chance, about the variable of their "
                            "own modality. No other information exceeds that of shifted spikes. With 99 shifts, ")
    assert words.endswith("in 6 of the comparisons here there is nothing to find. So each cell informs about the "
                          "concern of its modality, and hardly about the others.")


def test_further_information_of_cells_is_named():
    words = describe_information(informed(("speed cell", "position")))
    assert "Beyond that, the speed cell's information about position exceeds that of shifted spikes. With 99" in words
    assert "nothing to find, unless the animal's path links the variables. So each cell" in words
    words = describe_information(informed(("speed cell", "position"), ("place cell", "speed")))
    assert "the place cell's information about speed, the speed cell's information about position exceed that" in words
    assert words.endswith("hardly about the others.")
    many = informed(("speed cell", "position"), ("place cell", "speed"), ("place cell", "direction"))
    assert describe_information(many).endswith("links the variables.")


def test_cells_uninformative_about_their_own_variable_are_not_counted():
    words = describe_information(informed(unclear=["place cell"]))
    assert words.startswith("2 of the 3 cells are most informative, and above chance, about the variable of their own "
                            "modality in so short a recording. No other")
    assert words.endswith("nothing to find.")
    outdone = informed(("place cell", "speed"))
    outdone["place cell"]["speed"] = Information(3.0, True)
    assert describe_information(outdone).startswith("2 of the 3 cells")


def test_a_single_map_of_everything_is_as_large_as_the_product_of_all():
    tuned = {"fine": (NresMap(20), 3), "coarse": (NresMap(10), 0), "small": (NresMap(5), 0)}
    active = {"fine": np.arange(1_000) < 23, "coarse": np.arange(1_000) < 100, "small": np.arange(1_000) < 132}
    words = describe_sizes(tuned, active)
    assert "The 3 maps of this box have 525 cells in all." in words and "would need 1.0 × 10<sup>6</sup>. At" in words
    assert "were active for 2.3 to 13.2 % of the time" in words


def test_each_cell_has_a_line_with_the_correlation_of_its_maps():
    assert describe_likeness({"place cell": 0.987, "border cell": -0.25}).splitlines() == [
        "place cell: correlation of the maps 0.99", "border cell: correlation of the maps -0.25"]


def test_one_module_is_said_to_mistake_places_and_several_are_not():
    assert describe_modules((0.3, 0.42)) == ("By its phases to a tenth of a period, the module of scale 0.3 takes "
                                             "100 % of the places in the box for some place elsewhere in it; the 2 "
                                             "modules together 0 %.")


def test_errors_of_path_integration_are_given_early_and_late():
    errors = {"sum alone": np.tile([0.1, 0.2, 0.3, 0.4], (2, 1)), "corrected at walls": np.full((2, 4), 0.05)}
    text = describe_drift(errors)
    assert text.startswith("From a quarter of the time to its end, the mean error goes from 0.10 [0.10, 0.10] to 0.40 "
                           "[0.40, 0.40] with the *sum alone*, and from 0.05")
    assert text.endswith("to 0.05 [0.05, 0.05] if it is *corrected at walls*.")
