"""What `benchmarks/run_cost.py` tells of a run adds up."""

import json
import runpy
import tomllib
from pathlib import Path

import pytest

FOUND = runpy.run_path(str(Path(__file__).resolve().parents[2] / "benchmarks" / "run_cost.py"))
SPENT = {
    "loading": 0.1, "building": 0.2, "setup": 0.3, "accelerations": 0.4, "stepping": 2.0, "repeat": 3.0,
    "stable step": 0.0, "logging": 0.5, "rest": 0.5,
}  # fmt: skip
CELL = {
    "scene": "heavy_top[moderate]", "engine": "mujoco", "scheme": "RK4", "dt": 1e-3, "repeats": 2,
    "asked": True, "timed": True, "spent": SPENT,
}  # fmt: skip
RUN = {
    "schema": "poinsot.cost/1", "workers": 2, "seconds": 12.0, "pulse": 6e-4, "crowding": 1.5,
    "expected": {"simulating": 5.0, "timing": 3.0},
    "phases": {
        "simulating": {"seconds": 6.0, "cpu_seconds": 8.0},
        "timing": {"seconds": 4.0, "cpu_seconds": 3.0},
        "judging": {"seconds": 1.0, "cpu_seconds": 2.0},
        "report": {"seconds": 1.0, "cpu_seconds": 1.0},
    },
    "cells": [CELL],
    "judging": {
        "heavy_top[moderate]": {"reading": 0.2, "errors": 0.5, "checks": 0.3, "pictures": 0.0, "rest": 0.0},
    },
}  # fmt: skip


def test_the_figures_of_a_run(tmp_path):
    (tmp_path / "cost.json").write_text(json.dumps(RUN))
    said = "\n".join(FOUND["told"](tmp_path))
    # 8 + 2 s shared by two workers, 3 + 1 s by one process.
    assert "9.0 s if it had had the cores to itself" in said
    assert "14.00 s         in all" in said
    assert (
        "by the clock / (bare steps / 2): 12.00; with the cores to itself 9.00, without timing 6.00" in said
    )
    # The checks: 0.3 + 0.4 + 3 + 0.3 of 14 s.
    assert "the checks add 40% to everything else (4.0 s), 57% to everything but timing" in said
    assert "expected 8 s: -11% against that, -33% against the clock; 12 s" in said


def test_rates_are_what_the_cells_took():
    found = tomllib.loads(FOUND["rates"]([RUN]))
    step = found["step"]["mujoco RK4"]["plain"]
    assert step * 2000 == pytest.approx(2.0)
    assert found["cell"]["mujoco"]["whole"] == pytest.approx(1.1)
    assert found["cell"]["mujoco"]["asked"] == pytest.approx(0.4)
    assert found["cell"]["mujoco"]["repeated"] == pytest.approx(0.5)
    # Building twice, as ten repeats of 1 ms fit into the run, and eleven times 1 ms.
    assert found["timing"]["factor"] == pytest.approx(3.0 / (2 * 0.2 + 11 * 0.001), rel=1e-2)
