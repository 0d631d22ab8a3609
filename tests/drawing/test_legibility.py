"""Figures are legible on light and dark pages, by the contrast ratios of WCAG 2."""

import re

import numpy as np
import pytest
from contrast import GROUNDS, STYLE_SHEET, contrast
from matplotlib.colors import to_hex, to_rgb

from neorl import drawing
from neorl.drawing.network_figures import BOX
from neorl.drawing.style import FILL, TEXT, UNDER_WHITE, letters

LINES = (*drawing.CURVES, drawing.INK, drawing.AGENT, drawing.GREEN, drawing.RED)
DISCS = (drawing.AGENT, drawing.GREEN, drawing.RED)  # they carry a white sign


def shown(colour, mode):
    """A figure's colour as a page of the book shows it."""
    (factor,) = re.findall(r"filter: brightness\(([\d.]+)\)", STYLE_SHEET.read_text())
    channels = (int(colour[at : at + 2], 16) * (float(factor) if mode == "dark" else 1.0) for at in (1, 3, 5))
    return "#" + "".join(f"{min(round(channel), 255):02x}" for channel in channels)


def mixed(colour, opacity, ground):
    """The colour that results from a translucent colour on a ground."""
    return to_hex(opacity * np.array(to_rgb(colour)) + (1 - opacity) * np.array(to_rgb(ground)))


@pytest.mark.parametrize("mode", GROUNDS)
def test_lines_stand_out_from_the_page(mode):
    for colour in LINES:
        assert contrast(shown(colour, mode), GROUNDS[mode][0]) >= 3, colour


@pytest.mark.parametrize("mode", GROUNDS)
def test_letters_are_legible(mode):
    for colour in (TEXT, *DISCS, *map(letters, LINES), letters("black"), letters("white"), letters("#ffff00")):
        assert contrast(shown(colour, mode), GROUNDS[mode][0]) >= 4.5, colour


@pytest.mark.parametrize("mode", GROUNDS)
def test_signs_stand_out_from_their_discs(mode):
    for colour in DISCS:
        assert contrast(shown(colour, mode), "#ffffff") >= 3, colour


@pytest.mark.parametrize("mode", GROUNDS)
def test_white_letters_are_legible_on_the_ground_that_is_meant_for_them(mode):
    assert contrast(shown(UNDER_WHITE, mode), "#ffffff") >= 4.5
    assert contrast(shown(UNDER_WHITE, mode), GROUNDS[mode][0]) >= 3


@pytest.mark.parametrize("mode", GROUNDS)
def test_letters_are_legible_in_the_boxes_of_networks(mode):
    ground = mixed(shown(drawing.AGENT, mode), int(BOX, 16) / 255, GROUNDS[mode][0])
    assert contrast(shown(TEXT, mode), ground) >= 4.5


@pytest.mark.parametrize("mode", GROUNDS)
def test_arrows_stand_out_from_the_fills_that_they_cross(mode):
    for colour in DISCS:
        assert contrast(shown(drawing.AGENT, mode), mixed(shown(colour, mode), FILL, GROUNDS[mode][0])) >= 3, colour


def test_the_measure_is_that_of_wcag():
    assert contrast("#000000", "#ffffff") == 21 and contrast("#777777", "#ffffff") == pytest.approx(4.48, abs=0.005)
