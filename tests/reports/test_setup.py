"""Setup and determinism: each setting is looked at, and a wrong one is named with what it should be."""

import re
from dataclasses import replace

import numpy as np
import pytest
from poinsot.reports import setup
from poinsot.reports.cell import Cell
from poinsot.reports.verdict import Status
from poinsot.scenarios.registry import scenes

TOP, CHAIN = scenes()["heavy_top[moderate]"], scenes()["co2_chain[mixture]"]


@pytest.fixture
def told(ahead):
    """Verdicts on an engine that tells these settings in place of the right ones."""

    def make(changes, scene=TOP, **provenance):
        run = ahead(scene, 1e-3)
        settings = {name: np.asarray(value).tolist() for name, value in setup.expected(scene, 1e-3).items()}
        given = {name: value for name, value in (settings | changes).items() if value != "missing"}
        run = replace(run, provenance=replace(run.provenance, setup=given, **provenance))
        return setup.check(Cell.of(run, {scene.full_name: scene}))

    return make


def test_all_settings_of_a_scene_are_asked_for():
    assert set(setup.expected(TOP, 1e-3)) == {
        "gravity", "dt", "linear_damping", "angular_damping", "velocity_limit",
        "body/top/mass", "body/top/center_of_mass", "body/top/inertia",
    }  # fmt: skip
    joints = {
        f"joint/{body} along x/{what}"
        for body in ("left", "middle", "right")
        for what in ("stiffness", "damping")
    }
    assert joints <= set(setup.expected(CHAIN, 1e-3))
    assert setup.expected(CHAIN, 1e-3)["joint/left along x/stiffness"] == 0.0
    assert setup.expected(CHAIN, 1e-3)["joint/middle along x/stiffness"] == 1600.0


@pytest.mark.parametrize(("scene", "count"), [(TOP, 8), (CHAIN, 20)])
def test_an_engine_set_up_as_asked_passes_in_one_sentence(told, scene, count):
    (verdict,) = told({}, scene)
    assert (verdict.status, verdict.observable, verdict.measured) == (Status.PASS, "all settings", 0.0)
    assert verdict.message == f"{count} settings are as asked"


def test_what_was_inferred_is_said(told):
    (verdict,) = told({}, probed=("angular_damping", "velocity_limit"))
    assert verdict.message.endswith("; inferred from a probe run: angular_damping, velocity_limit")


@pytest.mark.parametrize(
    ("name", "value", "says"),
    [
        ("gravity", [0.0, 0.0, -9.80], r"has \[0.0, 0.0, -9.8\], the scene asks for \(0.0, 0.0, -9.81\)"),
        ("gravity", [0.0, 0.0, 9.81], "gravity: the engine has"),
        ("gravity", [0.0, -9.81, 0.0], "gravity: the engine has"),
        ("gravity", -9.81, "has -9.81, the scene asks for"),
        ("dt", 2e-3, "dt: the engine has 0.002, the scene asks for 0.001"),
        ("dt", 1e-3 * (1 + 1e-11), "dt"),
        ("body/top/mass", 1.0 + 1e-6, "body/top/mass: the engine has 1.000001, the scene asks for 1.0"),
        ("body/top/center_of_mass", [0.0, 0.0, 0.0], "center_of_mass"),
        ("body/top/center_of_mass", [0.0, 1e-9, 0.05], "center_of_mass"),
        ("body/top/inertia", [[0.004, 1e-8, 0], [1e-8, 0.004, 0], [0, 0, 0.0075]], "inertia"),
        ("body/top/inertia", [0.004, 0.004, 0.0075], "inertia"),
        ("linear_damping", 1e-9, "linear_damping: the engine has 1e-09, the scene asks for 0.0"),
        ("angular_damping", 0.04, "angular_damping: the engine has 0.04, the scene asks for 0.0"),
        ("velocity_limit", 100.0, "velocity_limit: the engine has 100.0, the scene asks for inf"),
        ("velocity_limit", 9e5, "velocity_limit: the engine has 900000.0"),
        ("velocity_limit", float("nan"), "velocity_limit"),
        ("velocity_limit", "none", "velocity_limit: the engine has none"),
        ("velocity_limit", [100.0, 200.0], "velocity_limit"),
        ("gravity", None, "gravity: the engine has None"),
        ("gravity", "earth's", "gravity: the engine has earth's"),
        ("dt", float("nan"), "dt: the engine has nan"),
        ("dt", "missing", "dt: the engine has nothing, the scene asks for 0.001"),
    ],
)
def test_a_setting_that_is_not_as_asked_is_named(told, name, value, says):
    (verdict,) = told({name: value})
    assert (verdict.status, verdict.observable, verdict.allowed) == (Status.FAIL, name, setup.TOLERANCE)
    assert not verdict.measured <= setup.TOLERANCE
    assert re.search(says, verdict.message)


def test_a_lower_limit_is_further_off(told):
    (low,), (high,) = (told({"velocity_limit": limit}) for limit in (50.0, 100.0))
    assert (low.measured, high.measured) == (2e4, 1e4)


def test_every_setting_that_is_wrong_has_a_verdict(told):
    wrong = {"dt": 2e-3, "angular_damping": 0.04, "body/top/mass": 2.0}
    assert {v.observable for v in told(wrong)} == set(wrong)


@pytest.mark.parametrize("name", sorted(setup.expected(CHAIN, 1e-3)))
def test_no_setting_goes_unread(told, name):
    (verdict,) = told({name: "missing"}, CHAIN)
    assert (verdict.status, verdict.observable) == (Status.FAIL, name)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("gravity", [0.0, 1e-13, -9.81 * (1 + 1e-15)]),
        ("gravity", [0.0, 0.0, -9.81 + 5e-12]),  # relative to its size
        ("body/top/mass", 1.0 + 1e-14),
        ("velocity_limit", 1e6),
        ("linear_damping", 1e-14),
    ],
)
def test_rounding_and_what_no_scene_comes_near_are_granted(told, name, value):
    assert told({name: value})[0].status is Status.PASS


def test_a_probed_setting_that_is_wrong_is_said_to_be_probed(told):
    (verdict,) = told({"angular_damping": 0.04}, probed=("angular_damping",))
    assert "has 0.04, inferred from a probe run, the scene" in verdict.message


@pytest.mark.parametrize(
    ("digests", "status", "says"),
    [
        (("a", "a"), Status.PASS, "2 runs gave the same bits"),
        (("a", "b"), Status.FAIL, "2 runs gave 2 different motions"),
        (("a", "b", "a"), Status.FAIL, "3 runs gave 2 different motions"),
    ],
)
def test_determinism_is_the_same_bits_twice(ahead, digests, status, says):
    (verdict,) = setup.determinism(Cell.of(ahead(TOP, 1e-3, digests=digests), {TOP.full_name: TOP}))
    assert (verdict.check, verdict.status, verdict.message) == ("determinism", status, says)


@pytest.mark.parametrize("digests", [(), ("a",)])
def test_one_run_says_nothing_of_determinism(ahead, digests):
    assert setup.determinism(Cell.of(ahead(TOP, 1e-3, digests=digests), {TOP.full_name: TOP})) == []
