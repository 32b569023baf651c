"""The wide ladder of steps: what it spans, where it is cut, and what its rows say."""

import math
from dataclasses import replace

import numpy as np
import pytest
from poinsot.adapters.engine import Scheme
from poinsot.adapters.timing import Timing
from poinsot.scenarios.registry import scenes

from poinsot import precision
from poinsot.plan import Extent, plan

SCENE = scenes()["co2_chain[mixture]"]
EULER = Scheme("semi-implicit Euler", 1, "semi-implicit Euler", {})


@pytest.mark.parametrize("name", [name for name, scene in scenes().items() if scene.ladders])
@pytest.mark.parametrize("order", [1, 4])
def test_a_wide_ladder_has_three_decades_of_whole_steps_around_the_scenes_own(name, order):
    scene = scenes()[name]
    ladder = precision.wide_ladder(scene, replace(EULER, order=order, twin=""))
    assert len(ladder) >= 8
    assert ladder[0] / ladder[-1] >= 999
    assert ladder[0] >= max(scene.ladder(order)) * (1 - 1e-9)
    assert all(math.isclose(scene.whole_step(dt), dt, rel_tol=1e-12) for dt in ladder)
    assert np.allclose(np.array(ladder[:-1]) / ladder[1:], 2)


def test_a_step_at_which_a_run_takes_too_long_is_left_out_with_all_finer_ones():
    wide = precision.wide_ladder(SCENE, EULER)
    each = precision.LONGEST / (SCENE.duration / wide[3]) * 1.01
    assert precision.affordable(SCENE, EULER, each) == wide[:3]


def test_rows_beyond_the_ladder_fall_in_line_with_it_and_are_marked_as_not_judged():
    pytest.importorskip("pinocchio")
    laid = plan([SCENE], ["pinocchio"], [EULER.name], [], Extent.FULL)
    key = next(key for key in laid.requests if key[3] == min(laid.requests)[3])
    # So slow a machine that only the coarser steps are affordable, which takes the test less long.
    timing = Timing(100, 100, (0.05,) * 10)
    found, notes = precision.beyond(laid, {key: timing}, 1, 60.0, lambda *told: None)
    ran = {key[3] for key in laid.requests}
    assert found
    assert not any(row["judged"] for row in found)
    assert not {row["dt"] for row in found} & ran
    assert all(row["seconds_min"] == pytest.approx(row["steps"] * 5e-4) for row in found)
    assert all(row["steps_per_second"] == pytest.approx(2e3) for row in found)
    assert all(row["error_per_us"] == pytest.approx(row["error"] / row["steps"] / 500) for row in found)
    assert any("fewer than 11 steps" in note and SCENE.full_name in note for note in notes)
    first = [row for row in found if row["observable"] == SCENE.observables[0].name]
    coarser, finer = first[-2:]  # the coarsest steps of all lie above the range where the order shows
    assert math.log(coarser["error"] / finer["error"], coarser["dt"] / finer["dt"]) == pytest.approx(
        1, abs=0.2
    )
