"""The workflows run nothing but what also runs here: commands of `.ci/run`, and targets of make."""

import re
import subprocess
import tomllib
from pathlib import Path

import installation
import pytest
import yaml

ROOT = Path(__file__).parents[2]
WORKFLOWS = [*(ROOT / ".github" / "workflows").glob("*.yml")]
CALLED = set(re.findall(r"^make (\S+)", (ROOT / ".ci" / "run").read_text(encoding="utf-8"), re.MULTILINE))
ELSEWHERE = {"deep"}  # installs PyTorch; systems and Pythons other than this one are the workflows', too


@pytest.mark.parametrize("workflow", WORKFLOWS, ids=lambda path: path.stem)
def test_every_step_of_a_workflow_is_a_command_that_runs_here(workflow):
    jobs = yaml.safe_load(workflow.read_text(encoding="utf-8"))["jobs"].values()
    commands = [step["run"] for job in jobs for step in job["steps"] if "run" in step]
    assert commands
    for command in commands:
        if command != "bash .ci/run":
            target = re.fullmatch(r"make (\w+)( PYTHON=python| RUNS=10)?", command)
            assert target and target[1] in CALLED | ELSEWHERE, command
            subprocess.run([*command.split(), "--dry-run"], cwd=ROOT, check=True, capture_output=True)


def test_a_change_is_tested_once_and_all_systems_and_versions_every_week():
    of_a_change, of_a_week = (yaml.safe_load((ROOT / ".github" / "workflows" / f"{name}.yml").read_text(
        encoding="utf-8")) for name in ("tests", "systems"))
    (job,) = of_a_change["jobs"].values()
    assert "strategy" not in job and {"push", "pull_request"} == {*of_a_change[True]}  # YAML's "on"
    assert {"schedule", "workflow_dispatch"} == {*of_a_week[True]}
    jobs = of_a_week["jobs"]
    assert {*jobs} == {"newest", "package", "versions", "deep"}
    matrix = jobs["package"]["strategy"]["matrix"]
    assert len(matrix["system"]) == 3 and matrix["python"] == ["3.11", "3.14"]


def test_the_package_is_installed_with_extras_that_it_has():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert set(installation.EXTRAS.split(",")) <= set(project["optional-dependencies"])
