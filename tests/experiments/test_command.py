"""What the commands print, write and return."""

import os
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

from neorl import Condition, Result, WaterWorld, place_cells, simulate
from neorl.common import files
from neorl.experiments import store
from neorl.experiments.command import main

CONDITION = Condition(place_cells([3]), WaterWorld(), 600, 2)


def test_a_file_is_run_described_and_saved(cache_folder, tmp_path, capsys):
    CONDITION.save(tmp_path / "experiment.json")
    assert main(["run", str(tmp_path / "experiment.json"), "--save", str(tmp_path / "results.npz")]) == 0
    printed = capsys.readouterr().out.splitlines()
    result = simulate(**CONDITION.choices, progress=False)
    np.testing.assert_array_equal(Result.load(tmp_path / "results.npz").rewards, result.rewards)
    rate = result.rate()
    assert printed == [
        "PC N3 in WaterWorld, 600 steps, 2 runs, seed 0",
        f"  reward per second: {rate.mean():.3f}, with a standard deviation over runs of {rate.std(ddof=1):.3f}",
        f"  kept in {tmp_path / 'results.npz'}"]
    assert store.load(CONDITION) == simulate(**CONDITION.choices, progress=False)


@pytest.mark.parametrize("encoding", ["ascii", "latin2", "utf-8"])
def test_a_terminal_without_some_letters_prints_the_rest(cache_folder, tmp_path, encoding):
    agent = replace(CONDITION.agent, nodes=[replace(CONDITION.agent.nodes[0], name="Ортс")], desires=[])
    replace(CONDITION, agent=agent).save(tmp_path / "experiment.json")
    done = subprocess.run([sys.executable, "-m", "neorl", "run", tmp_path / "experiment.json"], capture_output=True,
                          env=os.environ | {"PYTHONIOENCODING": encoding})
    assert done.returncode == 0 and b", with a standard deviation over runs of" in done.stdout


def test_the_cache_is_listed_and_cleared(tmp_path, capsys, monkeypatch):
    monkeypatch.setenv("NEORL_CACHE", str(tmp_path))
    files.write_checked(tmp_path / "compiled" / f"begin-{'0f' * 16}", b"x" * 2_000_000)
    assert main(["cache"]) == 0
    printed = capsys.readouterr().out
    assert str(tmp_path) in printed and "compiled kernels: 1 file, 2.000 MB" in printed
    assert "finished runs of conditions: 0 files" in printed and "together: 1 file, 2.000 MB" in printed
    assert main(["cache", "--clear"]) == 0
    assert "1 file, 2.000 MB" in capsys.readouterr().out and not list((tmp_path / "compiled").iterdir())
    assert main(["cache", "--clear"]) == 0 and "0 files, 0.000 MB" in capsys.readouterr().out


def test_an_error_is_printed_in_one_line(tmp_path, capsys):
    path = tmp_path / "experiment.toml"
    path.write_text("steps = 3")
    assert main(["run", str(path)]) == 1
    assert capsys.readouterr() == ("", f"neorl: {path}: agent must be an Agent, but is missing\n")


def test_python_finds_the_commands(tmp_path):
    shown = subprocess.run([sys.executable, "-m", "neorl", "--help"], capture_output=True, check=True, text=True).stdout
    assert "usage: python -m neorl" in shown and "list the cache on disk" in shown
    wrong = subprocess.run([sys.executable, "-m", "neorl", "run", "nowhere.toml"], capture_output=True, text=True)
    assert wrong.returncode == 1 and wrong.stderr == "neorl: [Errno 2] No such file or directory: 'nowhere.toml'\n"
