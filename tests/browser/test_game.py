"""The game of the front page: both tanks are what Python runs, and it is played by keys, by touch and by links."""

import re
from pathlib import Path

from writing import front, game
import numpy as np
import pytest
from axe_playwright_python.sync_playwright import Axe

ROOT = Path(__file__).parents[2]
LESSON = 3_000  # steps
SCORE = r"−?\d+"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("game")
    (folder / "_static").mkdir()
    for name in ("book.css", "star.png"):
        (folder / "_static" / name).write_bytes((ROOT / "book" / "vendor" / name).read_bytes())
    page = front.page(LESSON)
    for text, other in (("const COUNTDOWN = 3;", "const COUNTDOWN = 0;"), ("const PACE = 1;", "const PACE = 4;")):
        assert text in page
        page = page.replace(text, other)  # so that tests wait less
    (folder / "index.html").write_text(
        '<!doctype html><html lang="en"><meta charset="utf-8"><title>Game</title><link rel="icon" href="data:,">'
        '<link rel="stylesheet" href="_static/book.css">'
        f'<main class="bd-content"><section><h1>Game</h1>{page}</section></main>')
    return folder


@pytest.fixture
def board(open_page, folder):
    page = open_page(folder, "index.html")
    page.locator(".neorl-game").scroll_into_view_if_needed()
    return page


def begin(page):
    page.locator("[data-action=begin]").click()
    page.wait_for_selector(".neorl-game[data-state=running]")


def end(page):
    page.wait_for_selector(".neorl-game[data-state=over]")
    return page.locator(".neorl-game .said").inner_text()


def scores(page):
    return [int(each.replace("−", "-")) for each in page.locator(".neorl-game output").all_inner_texts()]


def worth(first, second):
    return first @ (1, -1), second.sum()


def test_red_becomes_good_half_way_and_the_agent_does_what_it_does_in_python(board):
    begin(board)
    said = end(board)
    before, after = (int(each) for each in worth(*game.round_of_agent(1, LESSON)))
    _, agent = scores(board)
    assert agent == before + after
    assert re.search(rf"You scored {SCORE}, {SCORE} of it after red had become good", said)
    assert f"the agent {agent}, {after} of it after that".replace("-", "−") in said


def test_it_is_played_by_keys_and_by_drawing_and_a_link_carries_the_board_and_the_score(board):
    begin(board)
    at = [*map(float, board.get_attribute(".neorl-game", "data-at").split())]
    board.keyboard.down("ArrowLeft")
    board.wait_for_function("before => document.querySelector('.neorl-game').dataset.at.split(' ')[0] < before - 0.1",
                            arg=at[0])
    board.keyboard.up("ArrowLeft")
    box = board.locator(".neorl-game .its canvas").bounding_box()
    board.mouse.move(box["x"] + 50, box["y"] + 50)
    board.mouse.down()
    board.mouse.move(box["x"] + 90, box["y"] + 55, steps=4)
    board.wait_for_function("before => document.querySelector('.neorl-game').dataset.at.split(' ')[0] > before",
                            arg=at[0])
    board.mouse.up()
    end(board)
    mine, _ = scores(board)
    board.locator("[data-action=share]").click()
    board.wait_for_function("document.querySelector('.neorl-game .said').textContent.includes('#game_board-1_beat-')")
    link = re.search(r"#game_board-1_beat--?\d+", board.locator(".neorl-game .said").inner_text()).group()
    assert link == f"#game_board-1_beat-{mine}"
    board.evaluate("link => { location.hash = link; }", link)
    board.wait_for_function("document.querySelector('.neorl-game .said').textContent.startsWith('Somebody has scored')")
    begin(board)
    assert re.search("You have beaten|to beat", end(board))


def test_both_tanks_begin_alike_and_the_game_is_accessible(board):
    begin(board)
    board.wait_for_function("Number(document.querySelector('.neorl-game').dataset.step) > 5")
    assert Axe().run(board, options={"resultTypes": ["violations"]}).violations_count == 0
    end(board)
    assert board.get_attribute(".neorl-game", "data-step") == str(game.STEPS)
    assert board.locator("[data-action=begin]").inner_text() == "Once more"


def test_an_agent_that_avoided_red_discs_takes_them_at_once_when_they_are_good():
    rounds = np.array([game.round_of_agent(board) for board in range(1, 4)])  # boards, halves, kinds
    reds = rounds[:, :, 1].sum(axis=0)
    assert reds[1] > 5 * reds[0]
