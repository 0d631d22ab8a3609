"""Experiments as files: one condition, or several variations of it."""

import json

import pytest

from neorl import Condition, Learning, Policy, WaterWorld, place_cells, softmax
from neorl.experiments import experiment
from neorl.experiments.experiment import read_experiment

BASE = {"steps": 100, "runs": 2, "agent": {"is": "place_cells", "resolutions": [3], "learning": {"memory": 10.0}},
        "world": {"is": "WaterWorld", "n_creeps": 8}}


def written(tmp_path, data):
    path = tmp_path / "experiment.json"
    path.write_text(json.dumps(data))
    return path


def test_a_file_is_a_condition(tmp_path):
    condition = Condition(place_cells([3], learning=Learning(memory=10)), WaterWorld(n_creeps=8), 100, 2)
    assert read_experiment(written(tmp_path, BASE)) == {"": condition}
    condition.save(tmp_path / "saved.json")
    assert read_experiment(tmp_path / "saved.json") == {"": condition}


def test_the_file_in_the_documentation_is_as_it_says(tmp_path):
    path = tmp_path / "experiment.toml"
    path.write_text("\n".join(line for line in experiment.__doc__.splitlines() if line.startswith("    ")))
    tank, long = WaterWorld(n_creeps=8), Learning(memory=10.0)
    assert read_experiment(path) == {
        "coarse": Condition(place_cells([3], learning=long), tank, 150_000, 20),
        "forgetful": Condition(place_cells([3, 7, 23], learning=Learning(memory=1.0)), tank, 150_000, 20)}


def test_a_table_that_names_what_it_is_takes_the_place_of_the_other(tmp_path):
    policies = [{"choose": {"kernel": "softmax", "of": [0.5]}}, {"choose": {"kernel": "greedy"}}]
    conditions = read_experiment(written(tmp_path, BASE | {"variations": {
        "arena": {"world": {"is": "Arena", "radius": 0.1}}, "as it is": {},
        "soft": {"agent": {"policy": policies[0]}}, "greedy": {"agent": {"policy": policies[1]}}}}))
    assert list(conditions) == ["arena", "as it is", "soft", "greedy"]
    assert conditions["arena"].world.radius == 0.1 and conditions["as it is"].world == WaterWorld(n_creeps=8)
    assert [conditions[name].agent.policy for name in ("soft", "greedy")] == [Policy(choose=softmax(0.5)), Policy()]
    assert conditions["soft"].agent.learning.memory == 10.0


@pytest.mark.parametrize("data, message", [
    ({"variations": {}}, "variations must be .*, but is {}"),
    ({"variations": [3]}, r"variations must be .*, but is \[3\]"),
    ({"variations": {"a": 3}}, "variations.'a' must be .*, but is 3"),
    ({"variations": {"../a": {}}}, "variations.'../a' must be .*, but is {}"),
    ({"variations": {"a": {"agent": {"learning": {"memory": -1}}}}},
     "variations.a: agent.learning.memory must be .*, but is -1"),
    ({"stepps": 3}, "a field of the data must be .*, but is 'stepps'; did you mean 'steps'"),
])
def test_what_is_wrong_is_named_with_the_file(tmp_path, data, message):
    path = written(tmp_path, BASE | data)
    with pytest.raises(ValueError, match=f"^{path}: {message}"):
        read_experiment(path)
