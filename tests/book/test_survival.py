"""``make book`` under kills, interruptions, full and read-only disks, a second build, and a notebook that raises.

However a build of a small book (`small_book`) ends, every page in place is whole, pages that were whole are kept, the
cause is named, and the next build resumes from there and ends with the same book.
"""

import random
import re
import resource
import shutil
import signal
import subprocess
import time

import psutil
import pytest
import small_book

from neorl import WaterWorld, place_cells, simulate

KILOBYTE = 1024
FULL = "No space left on device|disk that has no room left"


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    """A tree with a built book, for tests to copy."""
    tree = small_book.make_tree(tmp_path_factory.mktemp("finished") / "tree")
    code, said = small_book.build(tree)
    assert code == 0, said
    assert small_book.whole_pages(tree) == list(small_book.NOTEBOOKS)
    small_book.assert_no_half_page(tree)
    assert_figures(tree, runs=2)
    return tree


def assert_figures(tree, runs):
    """Assert that the numbers on the built pages are those of runs computed here."""
    for seed, name in enumerate(("assumptions", "paper_a")):
        alone = simulate(place_cells([3]), WaterWorld(), steps=10_000, runs=runs, seed=seed, progress=False)
        assert f"{alone.totals.sum():.6f}" in small_book.pages(tree)[f"chapters/{name}.html"]


@pytest.fixture
def tree(tmp_path):
    return small_book.make_tree(tmp_path / "tree")


@pytest.fixture
def built(finished, tmp_path):
    return shutil.copytree(finished, tmp_path / "tree", symlinks=True)


def leave_room(disk, size):
    """Resize an in-memory disk so that `size` bytes are free."""
    blocks = -(-(shutil.disk_usage(disk).used + size) // 4096)
    subprocess.run(["mount", "-o", f"remount,size={4096 * blocks}", disk], check=True)


def written(tree):
    """The time at which each whole page was written: {notebook: time}."""
    return {name: (tree / "book" / "chapters" / f"{name}.ipynb").stat().st_mtime_ns
            for name in small_book.whole_pages(tree)}


def assert_failed_well(tree, code, said, kept, cause):
    """Assert that a build failed, named the cause, and left whole pages as they were."""
    assert code == 1 and re.search(cause, said), said
    small_book.assert_no_half_page(tree)
    assert kept.items() <= written(tree).items()


def assert_goes_on(tree, finished, kept):
    """Assert that the next build computes only the rest, and ends with the same book."""
    code, said = small_book.build(tree)
    assert code == 0, said
    assert said.count("nothing has changed") == len(kept)
    assert kept.items() <= written(tree).items()
    assert small_book.pages(tree) == small_book.pages(finished)


def test_a_book_on_a_full_disk_goes_on_as_soon_as_there_is_room(finished, mount, tmp_path):
    disk = mount(tmp_path / "disk", "size=100m")
    tree = small_book.make_tree(disk / "tree")
    leave_room(disk, 9_000 * KILOBYTE)
    assert_failed_well(tree, *small_book.build(tree), {}, FULL)
    assert not (tree / "_build" / "html").exists()
    leave_room(disk, 100_000 * KILOBYTE)
    assert_goes_on(tree, finished, written(tree))


def test_a_full_disk_leaves_the_last_book_as_it_was(built, mount, tmp_path):
    disk = mount(tmp_path / "disk", "size=100m")
    tree = shutil.copytree(built, disk / "tree", symlinks=True)
    book = small_book.pages(tree)
    leave_room(disk, 9_000 * KILOBYTE)
    code, said = small_book.build(tree, runs=3)
    assert code == 1 and re.search(FULL, said), said
    small_book.assert_no_half_page(tree)
    assert small_book.pages(tree) == book
    assert len(written(tree)) == 3
    leave_room(disk, 100_000 * KILOBYTE)
    code, said = small_book.build(tree, runs=3)
    assert code == 0 and said.count("nothing has changed") == 3, said
    assert_figures(tree, runs=3)


def test_a_file_that_cannot_be_written_whole_is_no_page(tree):
    """A limit on file size ends a write half-way, as a full disk does; it needs no mount."""
    limit = (100 * KILOBYTE, resource.getrlimit(resource.RLIMIT_FSIZE)[1])
    code, said = small_book.build(tree, limits={resource.RLIMIT_FSIZE: limit})
    assert_failed_well(tree, code, said, {}, "File too large")
    assert not written(tree) and not (tree / "_build" / "html").exists()


def offspring(process):
    return psutil.Process(process.pid).children(recursive=True)


def wait_for(path, process):
    """Wait until a path exists or the process has ended."""
    while not path.exists() and process.poll() is None:
        time.sleep(0.005)


# What a build writes, in this order; it is killed soon after each.
MOMENTS = ("book/chapters/.paper_a", "_build/next/_build/html/index.html")


def test_a_build_that_is_killed_again_and_again_ends_with_the_same_book(tree, finished):
    moments, draw = [*MOMENTS], random.Random(5)
    while moments:
        kept, process = written(tree), small_book.start(tree)
        wait_for(tree / moments.pop(0), process)
        time.sleep(draw.uniform(0, 1))
        started = offspring(process) if process.poll() is None else []
        process.kill()
        process.communicate()
        assert not psutil.wait_procs(started, timeout=60)[1]  # all processes that it had started end with it
        small_book.assert_no_half_page(tree)
        assert kept.items() <= written(tree).items()
    assert_goes_on(tree, finished, written(tree))


def test_an_interrupted_build_says_so_and_a_second_one_meanwhile_is_refused(tree):
    process = small_book.start(tree)
    wait_for(tree / "book" / "chapters" / ".paper_a", process)
    process.send_signal(signal.SIGSTOP)  # so that it does not end before the second one begins
    started = offspring(process)
    code, said = small_book.build(tree)
    assert code == 1 and f"another make book is at work in this tree, process {process.pid} since" in said, said
    process.send_signal(signal.SIGINT)
    process.send_signal(signal.SIGCONT)
    said, _ = process.communicate()
    assert_failed_well(tree, process.returncode, said, {}, "\ninterrupted; make book resumes from here")
    assert "Traceback" not in said
    assert not psutil.wait_procs(started, timeout=60)[1]


@pytest.mark.parametrize("folder", [".cache", "book/chapters", "_build"])
def test_a_folder_that_is_read_only_is_named_and_the_book_stays(built, mount, folder):
    mount(built / folder, "ro")
    code, said = small_book.build(built)
    assert code == 1 and said == f"{built / folder} cannot be written to: [Errno 30] Read-only file system: " + (
        said.partition("system: ")[2]), said


def test_a_notebook_that_raises_is_named_and_all_others_are_kept(built):
    book, kept = small_book.pages(built), written(built)
    small_book.write_notebook(built, "paper_a", "print(1 / 0)")
    code, said = small_book.build(built)
    assert_failed_well(built, code, said, kept, r"paper_a.ipynb, In \[3\]: ZeroDivisionError: division by zero")
    assert "not computed, see above: paper_a.ipynb, chapter_5.ipynb; all others are kept" in said
    assert small_book.pages(built) == book


def test_the_cache_folder_may_be_relative_to_where_the_build_starts(tree):
    """Notebooks run in a folder of their own, yet a relative `NEORL_CACHE` is relative to where the build starts."""
    code, said = small_book.build(tree, only="assumptions", NEORL_CACHE=".cache")
    assert code == 0 and (tree / "book" / "chapters" / "assumptions.claims.json").exists(), said
