"""Bodies on an incline: the truth against Newton and Coulomb by steps, and engines with another friction."""

from dataclasses import replace

import numpy as np
import pytest
from poinsot.reference import quaternions, rolling
from poinsot.reference.errors import InputError
from poinsot.reports import truth, twin
from poinsot.reports.cell import Cell
from poinsot.reports.verdict import Status
from poinsot.scenarios import rolling as scenes
from poinsot.scenarios.scene import Softness
from poinsot.scenarios.trajectory import Provenance

BY_NAME = {scene.variant: scene for scene in scenes.SCENES}
EVERY = pytest.mark.parametrize("scene", scenes.SCENES, ids=lambda scene: scene.full_name)
DT = 1e-3


def cell(scene, motion, engine="engine", dt=DT):
    steps = round(scene.duration / dt)
    return Cell(
        scene, motion, Provenance(scene.full_name, engine, "1", "Euler", 1, "semi-implicit Euler", dt, steps)
    )


def judged(scene, motion, engine="engine"):
    return {v.observable for v in truth.check(cell(scene, motion, engine)) if v.status is not Status.PASS}


def stepped(scene, dt=DT, friction=1.0, give=0.0, grips=False):
    """Semi-implicit Euler in the plane of the slope, with Coulomb's friction as an impulse.

    ``friction`` is a factor to μ, ``give`` what friction leaves of a slip, ``grips`` without limit.
    """
    body, (normal, down, _) = scene.bodies[0], scenes.axes(scene)
    m, inertia, a = body.mass, body.inertia_array[2, 2], scenes.RADIUS
    g, mu = np.array(scene.gravity), scene.contacts[0].friction * friction
    v, w, x, angle = np.array(scene.v0[:3]) @ down, scene.v0[5], 0.0, 0.0
    rows = [(x, angle, v, w)]
    for step in range(round(scene.duration / dt)):
        v += g @ down * dt
        stop = (1 - give) * (v - a * w) / (1 / m + a * a / inertia)
        limit = np.inf if grips else -mu * m * (g @ normal) * dt
        blow = np.clip(stop, -limit, limit)
        v, w = v - blow / m, w + a * blow / inertia
        x, angle = x + v * dt, angle + w * dt
        if (step + 1) % scene.steps_per_sample(dt) == 0:
            rows.append((x, angle, v, w))
    x, angle, v, w = np.array(rows).T
    return scenes._motion(scene, scene.sample_times(), x, angle, v, w)


@EVERY
def test_the_scheme_by_hand_is_the_schemes_own_motion(scene):
    assert judged(scene, stepped(scene)) == set()


@EVERY
def test_the_track_is_downhill_and_the_body_turns_about_what_it_rolls_about(scene):
    m = scene.truth(scene, scene.sample_times())
    normal, down, axis = scenes.axes(scene)
    assert np.cross(down, [0.0, 0.0, 1.0]) @ normal == pytest.approx(0.0, abs=1e-15)
    assert down[2] == pytest.approx(-np.sin(scenes.SLOPE))
    omega = quaternions.rotated(m.quaternion[:, 0], m.omega[:, 0])
    assert omega == pytest.approx(np.outer(m.omega[:, 0, 2], axis), abs=1e-12)
    assert m.position[:, 0] @ normal == pytest.approx(scenes.OFFSET + scenes.RADIUS, abs=1e-14)
    slip = np.linalg.norm(scenes._slip(scene, m), axis=1)
    assert (slip[1:] > 1e-3).all() if "slips" in scene.variant else (slip < 1e-14).all()


@EVERY
def test_fits_are_the_closed_forms(scene):
    m = scene.truth(scene, scene.sample_times())
    assert scenes._acceleration(scene, m) == pytest.approx(scenes._exact_acceleration(scene), rel=1e-12)
    assert scenes._spinning_up(scene, m) == pytest.approx(scenes._exact_spinning_up(scene), rel=1e-12)


@EVERY
def test_each_slope_is_on_its_side_of_the_threshold(scene):
    steepest = rolling.slipping_slope(scene.contacts[0].friction, scenes._kappa(scene))
    expected = scenes.SLIPS if "slips" in scene.variant else scenes.ROLLS
    assert np.tan(scenes.SLOPE) / np.tan(steepest) == pytest.approx(expected)


@pytest.mark.parametrize("variant", ["hoop", "sphere"])
def test_friction_that_gives_way_is_seen(variant):
    # A thousandth of the slip left at each step: the contact creeps at 3e-6 m/s.
    scene = BY_NAME[variant]
    assert {"omega", "slip"} <= judged(scene, stepped(scene, give=1e-3))


def test_friction_that_grips_too_well_is_seen():
    scene = BY_NAME["slips"]
    assert {"velocity", "acceleration"} <= judged(scene, stepped(scene, grips=True))
    assert {"velocity", "acceleration"} <= judged(scene, stepped(scene, friction=1 + 1e-9))


def test_a_body_that_slips_where_it_should_roll_is_seen():
    scene = BY_NAME["disc"]
    assert {"slip", "energy"} <= judged(scene, stepped(scene, friction=0.9))


def test_what_gives_way_is_granted_to_its_engine_alone_and_no_more():
    scene, m = BY_NAME["hoop"], stepped(BY_NAME["hoop"])
    share = scene.soft["mujoco"].at(DT)
    for part, seen in ((0.5, set()), (2.0, {"velocity", "velocity, scheme's own"})):
        off = replace(m, velocity=m.velocity * (1 + part * share))
        assert judged(scene, off, "mujoco") & {"velocity", "velocity, scheme's own"} == seen
        assert "velocity" in judged(scene, off, "pybullet")
    [verdict] = [v for v in truth.check(cell(scene, m, "mujoco")) if v.observable == "velocity"]
    assert "3.1e-07 of its size is granted as well: MuJoCo's contact holds back" in verdict.message


@pytest.mark.parametrize(("part", "status"), [(0.5, Status.PASS), (2.0, Status.FAIL)])
def test_twins_may_differ_by_what_gives_way_in_them(part, status):
    scene, m = BY_NAME["hoop"], stepped(BY_NAME["hoop"])
    off = replace(m, velocity=m.velocity * (1 + part * scene.soft["mujoco"].at(DT)))
    verdicts = twin.check([cell(scene, m, "pinocchio"), cell(scene, off, "mujoco")])
    assert {v.status for v in verdicts} == {status}


def test_softness_says_how_much_and_why():
    with pytest.raises(InputError, match="softness share"):
        Softness(0.0, "a reason")
    with pytest.raises(InputError, match="got no reason"):
        Softness(1e-3, "")
    with pytest.raises(InputError, match="softness order: got -1"):
        Softness(1e-3, "a reason", order=-1)


def test_softness_falls_with_the_step():
    assert Softness(1e-3, "a reason").at(1e-4) == 1e-3
    assert Softness(1e-3, "a reason", dt=1e-2, order=2).at(1e-3) == pytest.approx(1e-5, rel=1e-12)


def test_a_contact_that_gives_way_alike_at_any_step_is_seen():
    # What was once granted at any step, for what MuJoCo's contact gives way by at 16 ms.
    scene, m = BY_NAME["hoop"], stepped(BY_NAME["hoop"])
    creeping = replace(m, velocity=m.velocity * (1 + 2e-6))
    assert "velocity" in judged(scene, creeping, "mujoco")
