"""Logs are judged where no engine is installed, to the same verdicts."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from poinsot.command_line import main

ROOT = Path(__file__).resolve().parents[2]
ENGINES = ("mujoco", "pybullet", "pinocchio")


@pytest.fixture(scope="module")
def bare(tmp_path_factory):
    """Python of a virtual environment that holds Poinsot and none of the engines."""
    folder = tmp_path_factory.mktemp("bare")
    tree = folder / "tree"
    listed = subprocess.run(
        ["git", "ls-files", "--cached", "--others", "--exclude-standard"],
        cwd=ROOT, check=True, capture_output=True, text=True,
    ).stdout.splitlines()  # fmt: skip
    for name in listed:
        if (ROOT / name).is_file():
            (tree / name).parent.mkdir(parents=True, exist_ok=True)
            (tree / name).write_bytes((ROOT / name).read_bytes())
    subprocess.run([sys.executable, "-m", "venv", str(folder / "venv")], check=True)
    python = folder / "venv" / "bin" / "python"
    subprocess.run([python, "-m", "pip", "install", "--quiet", str(tree)], check=True, capture_output=True)
    return python


@pytest.fixture(scope="module")
def earlier(tmp_path_factory):
    """A run in every engine there is here: one that passes, and one that is a known deviation."""
    pytest.importorskip("pinocchio")
    out = tmp_path_factory.mktemp("earlier") / "run"
    steps = ["--dt", "4e-3", "--dt", "2e-3"]
    assert main(["run", "free_symmetric_top", *steps, "--no-timing", "--out", str(out)]) == 0
    return out


def call(python, *arguments):
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    return subprocess.run(
        [python, *arguments], cwd="/", env=environment, capture_output=True, text=True, check=False
    )


@pytest.mark.parametrize("engine", ENGINES)
def test_the_engine_is_not_there(bare, engine):
    assert call(bare, "-c", f"import {engine}").returncode == 1


def test_the_same_verdicts_come_out(bare, earlier):
    before = (earlier / "results.json").read_text()
    done = call(bare, "-m", "poinsot", "report", str(earlier))
    assert (done.returncode, done.stderr) == (0, "")
    assert json.loads((earlier / "results.json").read_text()) == json.loads(before)


def test_there_is_nothing_to_run(bare, tmp_path):
    done = call(
        bare, "-m", "poinsot", "run", "free_symmetric_top", "--engine", "mujoco", "--out", str(tmp_path)
    )
    assert done.returncode == 3
    assert done.stderr == "poinsot: mujoco is not installed; pip install 'poinsot[mujoco]'\n"


def test_the_doctor_says_so(bare):
    done = call(bare, "-m", "poinsot", "doctor")
    assert done.returncode == 0
    assert all(f"{engine}: unavailable" in done.stdout for engine in ENGINES)
