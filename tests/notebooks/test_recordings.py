"""The page "Learn from recordings": pilots and walkers, and files that are read as they were written."""

import numpy as np
import pytest
from companion.recordings import choosing, pilots, recorded
from page_cells import executed

pytest.importorskip("ratinabox")
pytestmark = pytest.mark.filterwarnings("ignore:invalid escape sequence")  # of RatInABox, where it is first compiled
U_TURN = np.array([[0.1, 0.1], [0.1, 0.5], [0.1, 0.9], [0.5, 0.9], [0.9, 0.9], [0.9, 0.5], [0.9, 0.1]])
STILL = np.zeros((200, 2))


@pytest.fixture(scope="module")
def ways():
    from companion.recordings import ways
    return ways


@pytest.fixture(scope="module")
def page():
    return executed("recordings")


def test_a_graph_goes_by_the_moves_that_were_seen_and_by_no_others(ways):
    push = pilots.by_graph(U_TURN, 3)((0.9, 0.1))
    assert push(np.array([0.1, 0.1])) == pytest.approx([0.4 / 2.4, 1.0], abs=1e-9)  # towards the next cell
    assert push(np.array([0.5, 0.5])).tolist() == push(np.array([0.9, 0.1])).tolist() == [0, 0]
    assert not pilots.by_graph(U_TURN, 3)((0.1, 0.1))(np.array([0.9, 0.1])).any()  # nobody came back
    missing = np.arange(len(U_TURN) - 1) == 2
    broken = pilots.by_graph(U_TURN, 3, missing)((0.9, 0.1))
    assert broken(np.array([0.5, 0.9])).any() and not broken(np.array([0.1, 0.1])).any()


def test_a_graph_takes_the_fewest_moves(ways):
    there_and_across = np.concatenate([U_TURN, U_TURN[::-1], [[0.5, 0.1], [0.9, 0.1]]])
    assert pilots.by_graph(there_and_across, 3)((0.9, 0.1))(np.array([0.1, 0.1]))[0] == 1.0


def test_a_walker_arrives_slides_along_walls_and_never_crosses_one(ways):
    box, maze = ways.box(), ways.box(((0.5, 0.0), (0.5, 0.7)))
    straight = ways.walk(lambda place: np.array([1.0, 0.0]), box, (0.2, 0.4), np.array([0.8, 0.4]), STILL)
    assert len(straight) - 1 == 28 and np.linalg.norm(straight[-1] - (0.8, 0.4)) <= ways.NEAR
    sliding = ways.walk(lambda place: np.array([1.0, 0.5]), maze, (0.4, 0.1), np.array([0.9, 0.9]), STILL)
    through = np.flatnonzero(sliding[:, 0] > 0.5)[0]
    assert sliding[:through, 0].max() <= 0.5 and sliding[through, 1] > 0.68
    assert sliding.min() > 0 and sliding.max() < 1


def test_a_walker_that_knows_no_way_goes_on_as_before(ways):
    noise = np.zeros((20, 2))
    noise[0] = 0.0, 1.0
    path = ways.walk(lambda place: np.zeros(2), ways.box(), (0.5, 0.2), np.array([0.9, 0.9]), noise)
    assert np.allclose(np.diff(path, axis=0), (0.0, ways.SPEED * ways.SECONDS))


def test_all_pilots_walk_between_the_same_places(ways):
    blind, straight = (ways.tour(pilot, ways.box(), 5, 3) for pilot in (
        lambda goal: lambda place: np.zeros(2), lambda goal: lambda place: np.sign(np.array(goal) - place)))
    assert np.array_equal(blind.goals, straight.goals)
    assert [path[0].tolist() for path in blind.paths] == [path[0].tolist() for path in straight.paths]
    assert straight.arrived.all() and straight.times.max() < 4
    again, other = (ways.tour(lambda goal: lambda place: np.zeros(2), ways.box(), 5, seed) for seed in (3, 4))
    assert np.array_equal(again.paths[2], blind.paths[2]) and not np.array_equal(other.goals, again.goals)


def test_the_rat_is_in_its_box_and_its_missing_frames_are_marked(ways):
    (path, missing), (half, _) = ways.rat(10), ways.rat(5)
    assert missing.shape == (len(path) - 1,) and 0 < missing.sum() < 20
    assert np.array_equal(path[:len(half)], half) and 0.45 < len(half) / len(path) < 0.55
    assert path.min() > 0 and path.max() < 1


def test_few_ways_have_no_interval(ways):
    tour = ways.Tour(np.array([True, False]), np.array([1.5, 3.0]), [], [])
    assert ways.rows({"two": tour}) == [["two", "0.50", "1.50"]]
    many = ways.Tour(np.arange(20) < 12, np.linspace(1, 2, 20), [], [])
    assert all("[" in cell for cell in ways.rows({"many": many})[0][1:])
    assert ways.rows({"none": tour._replace(arrived=np.zeros(2, bool))})[0][2] == "–"


def test_an_agent_that_watched_the_rat_finds_places_that_one_without_a_recording_does_not(page):
    arrived = [page.ways.tour(pilot, page.box, 6, 5).arrived.sum() for pilot in (
        page.pupil(page.path[:1]), page.pupil(page.path, page.missing))]
    assert arrived[1] > arrived[0] + 1


def test_what_is_read_from_a_file_is_what_was_written(page):
    lost = page.path.copy()
    lost[page.likely < 0.5] = np.nan
    pupils, fresh = page.pupils, {name: page.Learner(page.places) for name in page.pupils}
    fresh["dlc"].watch(lost, progress=False)
    fresh["sleap"].watch(lost, progress=False)
    fresh["nwb"].watch(page.path, progress=False)
    for part in (page.path[:5_000], page.path[5_000:9_000]):
        fresh["minari"].watch(part, np.diff(part, axis=0), progress=False)
    for name, learner in fresh.items():
        learner.want((0.6, 0.6))
        np.testing.assert_allclose(pupils[name].memory.q, learner.memory.q, atol=1e-6, err_msg=name)
        assert pupils[name].q(0).any()
    assert not np.array_equal(pupils["nwb"].memory.q, pupils["dlc"].memory.q)


def test_the_page_builds_the_pupil_that_the_benchmark_and_the_figure_use(page):
    shown = page.pupil(page.path, page.missing)((0.7, 0.3))
    used = pilots.towards_thing(pilots.pupil(page.path, page.resolutions, ends=page.missing))((0.7, 0.3))
    for place in np.random.default_rng(0).random((20, 2)):
        assert shown(place).tolist() == used(place).tolist()


def test_recorded_successes_are_shares_of_all_episodes():
    assert recorded.success({"successes": "50 25 0 50 0", "episodes": "50"}) == 50
    assert recorded.spread([80.0]) == "80" and recorded.spread([80.0, 90.0, 100.0]) == "90\u00a0±\u00a010"
    for row in recorded.table():
        assert len(row) == 2 + len(recorded.PILOTS)
    assert {row["name"] for row in recorded.rows_of("published.csv")} == {*recorded.names()}
    assert {row["seed"] for row in recorded.rows_of("benchmark.csv") if row["part"] == "table"} == {
        str(seed) for seed in range(recorded.data_seeds())}
    assert len(recorded.offset_rows(recorded.scans())) == len(recorded.names("offsets")) == 6


def test_recorded_ways_keep_off_the_walls_and_end_at_their_goals():
    walls, found = recorded.maze_ways()
    assert recorded.arrivals_in_words(found) == "5 of 5 arrive."
    for way, _ in found:
        assert np.abs(way[:, np.newaxis] - walls).max(axis=2).min() >= 2


def test_the_rule_of_the_search_takes_the_fewest_maps_among_equals():
    levels = dict(zip(choosing.CANDIDATES, (50, 60, 40, 40, 95, 96, 40, 40, 97, 90, 40, 40)))
    rows = [choosing.Row(f"pointmaze-{maze}-stitch-v0", offset, *candidate,
                         f"{min(10, level // 10 + offset)} 10 10 10 10")
            for candidate, level in levels.items() for maze in choosing.COMPARED
            for offset in choosing.TRIED]
    assert min(choosing.successes(rows, choosing.CANDIDATES[0], choosing.TRIED)) == 90
    assert choosing.chosen(rows) == choosing.CANDIDATES[4]
    lucky = choosing.CANDIDATES[2]
    giant = [choosing.Row("pointmaze-giant-stitch-v0", offset, *lucky, "10 10 10 10 10") for offset in choosing.TRIED]
    assert choosing.chosen(rows + giant) == choosing.CANDIDATES[4], "giant takes no part"


def test_the_search_is_whole_and_its_words_say_whether_it_reached_what_was_wanted():
    rows, finalists = choosing.read(), {choosing.chosen(choosing.read()), choosing.PLAIN}
    compared = [name for name in recorded.names() if name.split("-")[1] in choosing.COMPARED]
    planned = [(compared, choosing.TRIED, choosing.CANDIDATES), (recorded.names(), choosing.FRESH, finalists)]
    assert {row[:5] for row in rows} == {(name, offset, *candidate) for names, offsets, candidates in planned
                                         for name in names for offset in offsets for candidate in candidates}
    assert len(recorded.search_rows()) == len(choosing.CANDIDATES) and len(recorded.fresh_rows()) == 8
    least = min(int(row[1]) for row in recorded.fresh_rows() if "teleport" not in row[0])
    assert f"is {least} %, {'above' if least > 95 else 'not above'} the 95 %" in recorded.search_in_words()
