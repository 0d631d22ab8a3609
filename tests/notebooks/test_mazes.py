"""OGBench's point mazes: data sets as its published script generates them, and pilots in its own environments."""

import numpy as np
import pytest

pytest.importorskip("ogbench")
pytest.importorskip("mujoco")
from companion.recordings import benchmark, choosing, mazes, pilots, recorded, search  # noqa: E402 (they import OGBench)

EVERY = [*mazes.SIZES]
SMALL = {"navigate": 2, "stitch": 8}  # episodes


def episodes_of(name):
    return SMALL[name.split("-")[2]]


@pytest.mark.parametrize("name", EVERY)
def test_skipping_idle_steps_changes_no_bit(name):
    generated, plain = (mazes.generate(name, 3, episodes_of(name), skip=skip) for skip in (True, False))
    assert len(generated.ends) == episodes_of(name) * mazes.SIZES[name][1]
    for fast, slow in zip(generated, plain):
        assert fast.dtype == slow.dtype and np.array_equal(fast, slow)


@pytest.mark.parametrize("name", EVERY)
def test_episodes_are_as_long_as_those_of_the_published_script(name):
    ends = mazes.generate(name, 0, 2).ends
    assert np.flatnonzero(ends).tolist() == [mazes.SIZES[name][1] - 1, 2 * mazes.SIZES[name][1] - 1]
    assert 1_000_000 < np.prod(mazes.SIZES[name]) <= 1_005_000


def test_data_seeds_and_sets_differ_and_each_comes_again():
    first, again, other = (mazes.generate(EVERY[4], seed, 1).positions for seed in (0, 0, 1))
    assert np.array_equal(first, again) and not np.array_equal(first, other)
    assert not np.array_equal(first, mazes.generate(EVERY[5], 0, 1).positions)


def test_a_stitch_episode_goes_four_squares_and_stays():
    maze = mazes.environment(EVERY[4]).unwrapped
    for start in np.argwhere(maze.maze_map == 0).tolist()[:8]:
        for goal in mazes.squares_apart(maze.maze_map, tuple(start)):
            _, distances = maze.get_oracle_subgoal(maze.ij_to_xy(start), maze.ij_to_xy(goal))
            assert distances[tuple(start)] == mazes.APART
    positions = mazes.generate(EVERY[4], 0, 1).positions
    assert np.ptp(positions[-30:], axis=0).max() < 1.5 < np.ptp(positions, axis=0).max()


def test_hallways_lead_straight_on():
    maze = np.array([[1, 1, 1, 1], [1, 0, 0, 0], [1, 1, 1, 1]])
    assert mazes.is_hallway(maze, 1, 2) and mazes.is_hallway(maze.T, 2, 1)
    assert not mazes.is_hallway(maze, 1, 1) and not mazes.is_hallway(np.zeros((3, 3)), 1, 1)


def test_what_is_written_is_loaded(tmp_path, monkeypatch):
    monkeypatch.setattr(mazes, "SIZES", {EVERY[0]: (1, 20)})
    mazes.main(tmp_path, "2")
    assert sorted(path.name for path in tmp_path.iterdir()) == [f"{EVERY[0]}-{seed}.npz" for seed in (0, 1)]
    for loaded, generated in zip(mazes.load(tmp_path, EVERY[0], 1), mazes.generate(EVERY[0], 1)):
        assert np.array_equal(loaded, generated)


def test_a_small_data_set_teaches_the_way_that_an_unlearned_agent_does_not_find():
    name = "pointmaze-medium-navigate-v0"
    recording, box = mazes.generate(name, 0, 30), benchmark.in_line(name)
    still = mazes.Recording(*(part[:2] for part in recording))
    found, lost = (benchmark.solved(pilots.towards_thing(benchmark.watched(watched, box)), box, name, 1, 5)[0].sum()
                   for watched in (recording, still))
    assert found >= 4 > 1 >= lost


def test_a_pilot_is_driven_by_the_official_environment_to_its_goals():
    name, paths = "pointmaze-medium-stitch-v0", []
    box = benchmark.out_of_line(name)
    successes, steps = benchmark.solved(lambda goal: lambda place: np.zeros(2), box, name, 1, 0, paths)
    maze = mazes.environment(name).unwrapped
    assert len(paths) == benchmark.GOALS and steps == sum(len(path) - 1 for path, _ in paths)
    for (path, goal), task, success in zip(paths, maze.task_infos, successes):
        assert np.abs(goal - np.array(task["goal_xy"])).max() <= 1 >= np.abs(path[0] - task["init_xy"]).max()
        assert len(path) == 1001 or success == 1


def test_boxes_are_in_line_with_the_walls_or_not():
    for name in EVERY:
        maze = mazes.environment(name).unwrapped
        inside = np.argwhere(maze.maze_map == 0)
        edges = np.array([maze.ij_to_xy(ij) for ij in inside]) + mazes.UNIT / 2
        box = benchmark.in_line(name)
        for n in box.resolutions:
            assert np.allclose(box.within(edges) * n % 1, 0)
        out = benchmark.out_of_line(name)
        assert not any(np.allclose(out.within(edges) * n % 1, 0) for n in out.resolutions)
        for moved in (box, out, *(benchmark.in_line(name, offset) for offset in benchmark.OFFSETS)):
            assert moved.within(edges).max() <= 1 and moved.within(edges - mazes.UNIT).min() >= 0


def test_what_was_recorded_is_what_was_planned():
    planned = {job[:5]: job[5] for job in benchmark.plan()}
    rows = {(row["part"], row["name"], int(row["seed"]), row["pilot"], float(row["offset"])): row
            for row in recorded.rows_of("benchmark.csv")}
    assert rows.keys() <= planned.keys() and len(rows) == len(recorded.rows_of("benchmark.csv"))
    assert all(int(row["episodes"]) == planned[job] for job, row in rows.items())
    missing = [job for job in planned if job not in rows]
    assert all(job[0] == "table" and job[2] >= recorded.data_seeds() for job in missing), "a part that was begun"


def test_a_row_comes_again_from_its_data(tmp_path, monkeypatch):
    monkeypatch.setattr(mazes, "SIZES", {EVERY[0]: (20, 200)})
    mazes.main(tmp_path, "1")
    jobs = [("table", EVERY[0], 0, pilot, 0.0, 1) for pilot in ("in line", "graph, in line")]
    monkeypatch.setattr(benchmark, "plan", lambda: jobs)
    for _ in range(2):  # the second time, nothing is left to do
        benchmark.main(tmp_path, tmp_path / "rows.csv")
        rows = (tmp_path / "rows.csv").read_text().splitlines()
        assert [row.split(",")[1] for row in rows] == ["name", EVERY[0], EVERY[0]]
    again = benchmark.row_of(tmp_path, *jobs[0])
    assert rows[1].split(",")[7:9] == [again.successes, str(again.steps)]


def test_the_maps_of_the_search_cover_a_maze_at_every_offset_with_primes():
    for name in EVERY:
        maze = mazes.environment(name).unwrapped
        inside = np.array([maze.ij_to_xy(ij) for ij in np.argwhere(maze.maze_map == 0)])
        for maps in choosing.MAPS:
            for offset in (*choosing.TRIED, *choosing.FRESH):
                box = search.box_of(name, maps, offset)
                assert box.within(inside - 2).min() >= 0 and box.within(inside + 2).max() <= 1
                if maps != choosing.PLAIN[0]:
                    assert all(map(search.is_prime, box.resolutions))
                    assert len({*box.resolutions}) == len(choosing.MAPS[maps])
                for n, size in zip(box.resolutions, choosing.MAPS[maps]):
                    assert box.side / n == pytest.approx(size, rel=0.15)


def test_a_lost_pilot_goes_on_as_before():
    push = search.carrying_on(lambda goal: lambda place: np.array([1.0, 0.0]) * (place[0] < 0.5))((0.9, 0.9))
    assert push(np.array([0.1, 0.1])).tolist() == [1, 0]
    lost = push(np.array([0.6, 0.1]))
    assert lost[0] > 0 and lost[1] != 0
