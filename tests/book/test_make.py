"""``make book``: what it recomputes and keeps, and what it leaves when it is killed, interrupted or out of disk space.

However a build of a small book (`small_book`) ends, every page in place is whole, the last book is there, and the next
build ends with the same book.
"""

import os
import random
import re
import shutil
import signal
import subprocess
import time

import psutil
import pytest
import small_book

from neorl import WaterWorld, place_cells, simulate


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    """A tree with a built book, for tests to copy."""
    tree = small_book.make_tree(tmp_path_factory.mktemp("finished") / "tree")
    code, said = small_book.build(tree)
    assert code == 0, said
    small_book.assert_no_half_page(tree)
    alone = simulate(place_cells([3]), WaterWorld(), steps=10_000, runs=2, progress=False)
    assert f"{alone.totals.sum():.6f}" in small_book.pages(tree)["chapters/assumptions.html"]
    return tree


def copied(finished, tree):
    subprocess.run(["cp", "--archive", finished, tree], check=True)  # with the times of files
    return tree


@pytest.fixture
def built(finished, tmp_path):
    return copied(finished, tmp_path / "tree")


def change(tree):
    small_book.write_notebook(tree, "paper_a", small_book.REPEAT, small_book.DRAW, "print('changed')",
                              small_book.SAVE.format("paper_a"))


@pytest.fixture(scope="module")
def changed(finished, tmp_path_factory):
    """The same tree, built again after a change."""
    tree = copied(finished, tmp_path_factory.mktemp("changed") / "tree")
    change(tree)
    code, said = small_book.build(tree)
    assert code == 0, said
    assert "changed" in small_book.pages(tree)["chapters/paper_a.html"]
    return tree


def outdated(tree):
    """The notebooks that make would compute, with the same parameters."""
    _, said = small_book.build(tree, 2, "--dry-run", "--old-file=book/chapters/.parameters")
    return sorted(re.findall(r"compute.py notebooks/(\w+)\.ipynb", said))


def test_what_has_changed_is_computed_again_and_nothing_else(finished, built, changed):
    assert outdated(built) == [] and small_book.build(built) == (0, "")
    change(built)
    assert outdated(built) == ["chapter_5", "paper_a"]
    before, after = small_book.written(finished), small_book.written(changed)
    assert [name for name in after if after[name] != before[name]] == ["chapter_5", "paper_a"]
    assert outdated(changed) == [] and small_book.pages(changed) != small_book.pages(finished)
    (built / "neorl" / "source.py").write_text("")
    assert outdated(built) == [*small_book.NOTEBOOKS]


@pytest.mark.parametrize("runs", ["0", "2.5", "many"])
def test_bad_runs_are_refused_before_anything_runs(tmp_path, runs):
    tree = small_book.make_tree(tmp_path / "tree")
    code, said = small_book.build(tree, runs)
    assert code != 0 and f"RUNS and STEPS must be integers of at least 1, but are '{runs}' and ''" in said
    assert not small_book.written(tree)


def test_the_address_of_the_book_can_be_opened_whatever_its_folder_is_called(tmp_path):
    tree = small_book.make_tree(tmp_path / "a book, 100% #1")
    _, said = small_book.build(tree, 2, "--dry-run", "--old-file=.venv/ready", "book")
    said = subprocess.run(said.splitlines()[-1], shell=True, cwd=tree, capture_output=True, text=True).stdout
    assert said == f"the book is at {tmp_path.as_uri()}/a%20book%2C%20100%25%20%231/_build/html/index.html\n"


def test_without_runs_a_notebook_has_its_own_number(built):
    _, said = small_book.build(built, "", "--dry-run")
    assert "compute.py notebooks/paper_a.ipynb" in said and "--runs" not in said


def test_a_notebook_that_raises_is_named_and_the_last_book_stays(built):
    book = small_book.pages(built)
    small_book.write_notebook(built, "paper_a", "print(1 / 0)")
    (built / "notebooks" / "assumptions.ipynb").touch()
    code, said = small_book.build(built)
    assert code != 0 and "paper_a.ipynb, In [3]: ZeroDivisionError: division by zero" in said
    assert outdated(built) == ["chapter_5", "paper_a"]  # the other one was computed all the same
    assert small_book.pages(built) == book


def wait_for(tree, pattern, process):
    """Wait until a path of a pattern exists or the process has ended."""
    while not any(tree.glob(pattern)) and process.poll() is None:
        time.sleep(0.005)


def test_a_build_that_is_killed_and_interrupted_ends_with_the_same_book_the_next_time(built, changed):
    whole, draw = [small_book.pages(each) for each in (built, changed)], random.Random(5)
    change(built)
    for ending, moment in ((signal.SIGKILL, "book/chapters/.paper_a-*"),
                           (signal.SIGINT, "_build/next/_build/html/index.html")):
        process, started = small_book.start(built), []
        wait_for(built, moment, process)
        time.sleep(draw.uniform(0, 1))
        if process.poll() is None:
            started = psutil.Process(process.pid).children(recursive=True)
            os.killpg(process.pid, ending)
        process.communicate()
        assert not psutil.wait_procs(started, timeout=60)[1]  # a kernel ends with the process that has started it
        small_book.assert_no_half_page(built)
        assert small_book.pages(built) in whole
    assert small_book.build(built)[0] == 0
    assert small_book.pages(built) == whole[1]


def leave_room(disk, size):
    """Resize an in-memory disk so that `size` bytes are free."""
    blocks = -(-(shutil.disk_usage(disk).used + size) // 4096)
    subprocess.run(["mount", "-o", f"remount,size={4096 * blocks}", disk], check=True)


def test_a_full_disk_leaves_the_last_book_as_it_was(finished, changed, mount, tmp_path):
    disk = mount(tmp_path / "disk", "size=100m")
    tree = copied(finished, disk / "tree")
    book = small_book.pages(tree)
    change(tree)
    leave_room(disk, 9_000_000)
    code, said = small_book.build(tree)
    assert code != 0 and re.search("No space left on device", said), said
    small_book.assert_no_half_page(tree)
    assert small_book.pages(tree) == book
    leave_room(disk, 100_000_000)
    code, said = small_book.build(tree)
    assert code == 0 and small_book.pages(tree) == small_book.pages(changed), said
