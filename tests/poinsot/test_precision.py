"""The wide ladder of steps: what it spans, where it is cut, and what its rows say."""

import math
from dataclasses import replace

import numpy as np
import pytest
from poinsot.adapters import timing
from poinsot.adapters.engine import EngineError, Scheme, Setup, State
from poinsot.adapters.timing import Timing
from poinsot.scenarios.registry import scenes

import poinsot
from poinsot import precision
from poinsot.plan import Extent, plan

SCENE = scenes()["co2_chain[mixture]"]
EULER = Scheme("semi-implicit Euler", 1, "semi-implicit Euler", {})


@pytest.mark.parametrize("name", [name for name, scene in scenes().items() if scene.ladders])
@pytest.mark.parametrize("order", [1, 4])
def test_a_wide_ladder_has_three_decades_of_whole_steps_around_the_scenes_own(name, order):
    scene = scenes()[name]
    ladder = precision.wide_ladder(scene, replace(EULER, order=order, twin=""))
    assert ladder[0] / ladder[-1] >= 999
    assert ladder[0] >= max(scene.ladder(order)) * (1 - 1e-9)
    assert all(math.isclose(precision.looked(scene, dt).whole_step(dt), dt, rel_tol=1e-12) for dt in ladder)
    within, ratios = ladder[-precision.RUNGS :], np.array(ladder[:-1]) / ladder[1:]
    assert np.allclose(np.array(within[:-1]) / within[1:], 2)
    assert all(2 - 1e-9 <= ratio <= precision.SELDOM for ratio in ratios)
    assert all(dt <= precision.SELDOM * scene.duration / scene.samples * (1 + 1e-9) for dt in ladder)


@pytest.mark.parametrize(
    ("name", "order", "every"),
    [
        ("heavy_top[moderate]", 4, [8, 4, 2, 1]),
        ("co2_chain[mixture]", 4, [5, 1]),
        ("middle_axis[1e-2]", 4, [3, 1]),
        ("normal_modes[64_wall]", 4, [1]),  # five looks are few enough
        ("rolling[hoop]", 4, [1]),  # bodies touch
        ("compound_pendulum[struck]", 4, [1]),
        ("double_pendulum[large]", 4, []),  # four times its own ladder ends between two looks
    ],
)
def test_steps_longer_than_from_look_to_look_end_at_every_so_manieth(name, order, every):
    scene = scenes()[name]
    ladder = precision.wide_ladder(scene, replace(EULER, order=order, twin=""))
    sample = scene.duration / scene.samples
    assert [dt / sample for dt in ladder if dt > 0.99 * sample] == pytest.approx(every)


def test_a_scene_that_is_looked_at_less_often_shows_states_alone_at_its_own_times():
    scene = scenes()["heavy_top[moderate]"]
    assert precision.looked(scene, 0.01) is scene
    seldom = precision.looked(scene, 0.04)
    assert precision.looked(scene, 0.04) is seldom
    assert (seldom.samples, precision.steps(scene, 0.04)) == (50, 50)
    assert {observable.kind for observable in seldom.observables} == {"state"}
    assert np.allclose(seldom.sample_times(), scene.sample_times()[::4])


def test_a_scheme_of_fourth_order_is_tried_at_steps_so_long_that_it_misses():
    engine = pytest.importorskip("poinsot.adapters.pinocchio_").Pinocchio
    scene, scheme = scenes()["heavy_top[moderate]"], engine.schemes[-1]
    assert scheme.order == 4
    found = {
        dt: {row["observable"]: row for row in precision.rows(scene, engine, scheme, dt)}
        for dt in precision.wide_ladder(scene, scheme)[:4]
    }
    errors = {dt: mine["orientation"]["error"] for dt, mine in found.items()}
    assert max(dt for dt, error in errors.items() if error <= 1e-2) == pytest.approx(0.04)
    assert max(dt for dt, error in errors.items() if error <= 1e-4) == pytest.approx(0.02)
    counts = [(mine["orientation"]["samples"], mine["orientation"]["steps"]) for mine in found.values()]
    assert counts == [(25, 25), (50, 50), (100, 100), (200, 200)]
    assert [len(mine) for mine in found.values()] == [2, 2, 2, 4]


def test_a_step_at_which_a_run_takes_too_long_is_left_out_with_all_finer_ones():
    wide = precision.wide_ladder(SCENE, EULER)
    each = precision.LONGEST / (SCENE.duration / wide[3]) * 1.01
    assert precision.affordable(SCENE, EULER, each) == wide[:3]


def test_rows_beyond_the_ladder_fall_in_line_with_it_and_are_marked_as_not_judged():
    pytest.importorskip("pinocchio")
    laid = plan([SCENE], ["pinocchio"], [EULER.name], [], Extent.FULL)
    key, *others = sorted(laid.requests, key=lambda key: -key[3])
    # So slow a machine that only the coarser steps are affordable, which takes the test less long.
    timing = Timing(100, 100, (0.05,) * 10)
    # Those that spread tell less well how long a step takes, whether they come before or after.
    loose = Timing(100, 100, (0.02, 0.03, 0.03))
    timings = {others[0]: loose, key: timing, others[1]: loose}
    found, notes = precision.beyond(laid, timings, 1, 60.0, lambda *told: None)
    ran = {key[3] for key in laid.requests}
    assert found
    assert not any(row["judged"] for row in found)
    assert not {row["dt"] for row in found} & ran
    assert all(row["scaled"] and row["seconds_min"] == pytest.approx(row["steps"] * 5e-4) for row in found)
    assert all(row["steps_per_second"] == pytest.approx(2e3) for row in found)
    assert all(row["error_per_us"] == pytest.approx(row["error"] / row["steps"] / 500) for row in found)
    assert {row["samples"] for row in found if row["dt"] > 0.02 * (1 + 1e-9)} == {25}
    assert any("a finer one would take over" in note and SCENE.full_name in note for note in notes)
    first = [row for row in found if row["observable"] == SCENE.observables[0].name]
    coarser, finer = first[-2:]  # the coarsest steps of all lie above the range where the order shows
    assert math.log(coarser["error"] / finer["error"], coarser["dt"] / finer["dt"]) == pytest.approx(
        1, abs=0.2
    )


def test_a_step_at_which_an_engine_breaks_down_has_rows_that_say_so_and_is_noted():
    pytest.importorskip("pybullet")
    scene = scenes()["heavy_top[moderate]"]
    laid = plan([scene], ["pybullet"], [], [1e-2], Extent.FULL)
    (key,) = laid.requests
    found, notes = precision.beyond(laid, {key: Timing(200, 200, (0.25,) * 10)}, 1, 60.0, lambda *told: None)
    errors = {row["dt"]: row["error"] for row in found if row["observable"] == "orientation"}
    assert list(errors) == pytest.approx([0.08, 0.04, 0.02, 0.005, 0.0025])
    assert [error is None for error in errors.values()] == [True, True, False, False, False]
    for row in found:
        assert ("π/4" in row["message"]) == (row["error"] is None) == (row["seconds_min"] is None)
    assert len({tuple(row) for row in found}) == 1, "rows have the same names, whatever came of them"
    (told,) = [note for note in notes if "no error" in note]
    assert "heavy_top[moderate] 0.08 s, heavy_top[moderate] 0.04 s" in told


@pytest.fixture
def unpinned(monkeypatch):
    monkeypatch.setattr(timing, "pin", lambda: True)


class Breaking:
    """Stays where it is, and breaks down at steps longer than 2 ms."""

    name, features, settings = "breaking", frozenset({"free"}), {}
    schemes = (Scheme("none", 1, "none", {}),)
    version = staticmethod(lambda: "1")
    model_text = staticmethod(lambda: ("nothing", ""))
    readback = staticmethod(lambda: Setup({}))
    close = staticmethod(lambda: None)

    def build(self, scene, scheme, dt):
        self.dt, self.start = dt, scene.truth(scene, np.zeros(1))

    def step(self, n):
        if self.dt > 2e-3:
            raise self.error(f"no way at {self.dt:.3g} s")

    def state(self):
        at = self.start
        parts = (at.position, at.quaternion, at.velocity, at.omega)
        return State(*(part[0] for part in parts), at.joint_position[0], at.joint_velocity[0])

    error = EngineError


class Odd(Breaking):
    error = ValueError


@pytest.mark.usefixtures("unpinned")
@pytest.mark.parametrize(("engine", "said"), [(Breaking, "no way at"), (Odd, "ValueError: no way at")])
def test_rows_of_a_step_at_which_an_engine_breaks_down_say_what_it_said(monkeypatch, engine, said):
    monkeypatch.setattr(precision, "RUNGS", 6)
    found = poinsot.work_precision("free_symmetric_top[oblate]", engine)
    assert not any(row["judged"] for row in found)
    for row in found:
        assert (row["error"] is None) == (row["seconds_min"] is None) == (row["dt"] > 2e-3)
        assert row["message"].startswith(said) == (row["dt"] > 2e-3) == bool(row["message"])
    assert len({row["dt"] for row in found if row["error"] is None}) > 2
    assert len({row["dt"] for row in found if row["error"] is not None}) > 1


@pytest.mark.usefixtures("unpinned")
def test_an_engine_that_breaks_down_at_the_scenes_own_step_has_rows_of_that_alone():
    scene = replace(scenes()["free_symmetric_top[oblate]"], dt=4e-3)
    found = poinsot.work_precision(scene, [Breaking])
    assert {(row["dt"], row["message"]) for row in found} == {(4e-3, "no way at 0.004 s")}
    assert {row["observable"] for row in found} == {"orientation", "omega", "position", "Omega_b"}


def test_one_engine_may_be_named_by_itself():
    with pytest.raises(poinsot.InputError, match="nowhere"):
        poinsot.work_precision("free_symmetric_top[oblate]", "nowhere")
