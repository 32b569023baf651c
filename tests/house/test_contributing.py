"""The examples of CONTRIBUTING.md do what it says they do."""

import re
from pathlib import Path

import pytest
from poinsot.reports.verdict import Status

import poinsot

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def examples():
    text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    return re.findall(r"```python\n(.*?)```", text, re.DOTALL)


@pytest.fixture(scope="module")
def engine(examples, tmp_path_factory):
    path = tmp_path_factory.mktemp("own") / "free_top.py"
    path.write_text(examples[0])
    return f"{path}:FreeTop"


def failures(verdicts):
    return [verdict for verdict in verdicts if verdict.status is not Status.PASS]


def test_the_engine_passes_alone_and_over_its_ladder(engine):
    # Few steps, near to each other, keep this quick; the order of a first-order scheme shows all the same.
    steps = (4e-3, 2.5e-3, 2e-3, 1.25e-3, 1e-3)
    runs = [poinsot.simulate("free_symmetric_top[prolate]", engine, dt=dt) for dt in steps]
    verdicts = poinsot.judge(runs)
    assert {verdict.check for verdict in verdicts} >= {"truth", "order", "invariant", "setup", "determinism"}
    assert failures(v for v in verdicts if v.check != "truth") == []


def test_the_engine_is_a_twin_of_mujoco(engine):
    pytest.importorskip("mujoco")
    runs = [poinsot.simulate("free_symmetric_top[oblate]", name, dt=1e-2) for name in (engine, "mujoco")]
    twins = [verdict for verdict in poinsot.judge(runs) if verdict.check == "twin"]
    assert len(twins) == 2
    assert failures(twins) == []


def test_the_scene_holds_in_the_engine(examples):
    module = {}
    exec(examples[1], module)
    (scene,) = module["SCENES"]
    pytest.importorskip("pinocchio")
    runs = [poinsot.simulate(scene, "pinocchio", dt=dt) for dt in scene.ladders[1]]
    verdicts = poinsot.judge(runs, {scene.full_name: scene})
    assert {verdict.check for verdict in verdicts} >= {"truth", "order", "setup", "determinism"}
    assert failures(verdicts) == []
