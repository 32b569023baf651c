"""What is told of a motion must fit together, whatever scheme made it."""

from dataclasses import replace

import numpy as np
import pytest
from poinsot.reports import told
from poinsot.reports.judge import judge
from poinsot.reports.verdict import Status
from poinsot.scenarios.registry import scenes
from poinsot.scenarios.trajectory import Provenance

DT = 1e-3
WITHOUT_NORM = ["co2_chain[mixture]", "normal_modes[16_wall]", "large_pendulum[swing]", "foucault_pendulum"]
JOINTED = [
    "heavy_top[moderate]",
    "heavy_top[fast]",
    "double_pendulum[large]",
    "gyrostat",
    "rotor_balance[static]",
]


def motion(name, **changes):
    """The exact motion, told by an engine with a scheme of which nothing is recorded."""
    scene = scenes()[name]
    exact = scene.truth(scene, scene.sample_times())
    steps = scene.samples * scene.steps_per_sample(DT)
    made = replace(exact, provenance=Provenance(name, "mine", "1", "own", 2, "own", DT, steps))
    return replace(made, **{key: change(getattr(made, key)) for key, change in changes.items()})


def failed(*told_motions):
    return {v.observable for v in judge(told_motions, known=()) if v.status is Status.FAIL} - {"scene"}


@pytest.mark.parametrize("name", [*WITHOUT_NORM, *JOINTED, "free_symmetric_top[oblate]"])
def test_the_exact_motion_fits_together(name):
    found = [v for v in judge([motion(name)], known=()) if v.check == "invariant"]
    assert {v.status for v in found} == {Status.PASS}
    assert {v.observable for v in found} >= {"quaternion norm"}


@pytest.mark.parametrize("name", WITHOUT_NORM)
@pytest.mark.parametrize("length", [0.0, 0.5, 1 + 1e-9, 1e100])
def test_quaternions_have_length_1_in_every_scene(name, length):
    assert "quaternion norm" in failed(motion(name, quaternion=lambda q: q * length))


@pytest.mark.parametrize("name", JOINTED)
@pytest.mark.parametrize("what", ["position", "velocity", "omega"])
def test_what_is_told_one_sample_late_does_not_fit_the_rest(name, what):
    late = motion(name, **{what: lambda array: np.concatenate([array[:1], array[:-1]])})
    if not np.ptp(getattr(late, what), axis=0).any():
        pytest.skip("it does not change in this motion")
    assert told.ON_JOINTS in failed(late)


def test_velocities_of_free_bodies_are_not_at_will():
    assert "momentum" in failed(motion("free_symmetric_top[oblate]", velocity=lambda v: 5 - 3 * v))


def test_the_message_names_what_is_farthest_off_and_when():
    def later(array):
        array = array.copy()
        array[7] += 1e-9
        return array

    (verdict,) = (
        v
        for v in judge([motion("heavy_top[moderate]", velocity=later)], known=())
        if v.observable == told.ON_JOINTS
    )
    assert verdict.message.startswith("velocity told of bodies")
    assert verdict.at == pytest.approx(scenes()["heavy_top[moderate]"].sample_times()[7])


def test_runs_of_one_scene_are_told_apart():
    right = motion("heavy_top[moderate]")
    wrong = motion("heavy_top[moderate]", position=lambda p: p + 1e-6)
    wrong = replace(wrong, provenance=replace(wrong.provenance, engine="other"))
    third = replace(right, provenance=replace(right.provenance, engine="third"))
    found = [v for v in judge([right, wrong, third], known=()) if v.observable == told.ON_JOINTS]
    assert [v.status for v in found] == [Status.PASS, Status.FAIL, Status.PASS]


def test_what_cannot_be_judged_at_a_step_is_said():
    (verdict,) = (v for v in judge([motion("heavy_top[moderate]")], known=()) if v.check == "truth")
    assert (verdict.observable, verdict.status) == ("state", Status.UNSUPPORTED)
    assert "no error of mine own is recorded for orientation" in verdict.message
