"""A rolling disc: the truth against impulses at its lowest point, and engines with another rim."""

from dataclasses import replace

import numpy as np
import pytest
from poinsot.reference import quaternions, rolling_disc
from poinsot.reports import truth
from poinsot.reports.cell import Cell
from poinsot.reports.verdict import Status
from poinsot.scenarios import rolling_disc as disc
from poinsot.scenarios.trajectory import Provenance, of_one_body

EVERY = pytest.mark.parametrize("scene", disc.SCENES, ids=lambda scene: scene.full_name)
UNSTABLE = disc.SCENES[1]
DT = 8e-4


def judged(scene, motion, dt=DT):
    run = Provenance(scene.full_name, "engine", "1", "Euler", 1, "semi-implicit Euler", dt, round(0.64 / dt))
    return {v.observable for v in truth.check(Cell(scene, motion, run)) if v.status is not Status.PASS}


def stepped(scene, dt=DT, off=0.0, holds=1.0):
    """Semi-implicit Euler with an impulse that lays the lowest point to rest, on the plane.

    The impulse acts ``off`` [m] the lowest point along the axis, and takes away ``holds`` of the slip.
    """
    m, I = disc.MASS, np.array([disc.I1, disc.I1, disc.I3])  # noqa: E741 (as in the books)
    x, q = np.array(scene.q0[:3]), np.array(scene.q0[3:])
    v, w = np.array(scene.v0[:3]), np.array(scene.v0[3:])
    rows = [(x, q, v, w)]
    for step in range(round(scene.duration / dt)):
        turn = quaternions.matrix(q)
        axis = turn[:, 2]
        down = np.array([0.0, 0.0, -1.0]) + axis[2] * axis
        arm = disc.RADIUS * down / np.linalg.norm(down) - off * np.sign(axis[2]) * axis
        v = v + dt * np.array(scene.gravity)
        w = w - dt * np.cross(w, I * w) / I
        cross = np.cross(np.eye(3), arm)  # rows: e × arm, so that ω × arm is ω @ cross
        inverse = turn @ np.diag(1 / I) @ turn.T
        slip = v + (turn @ w) @ cross
        slip[2] += (x[2] + arm[2]) / dt
        blow = -np.linalg.solve(np.eye(3) / m + cross.T @ inverse @ cross, slip * [holds, holds, 1.0])
        v, w = v + blow / m, w + turn.T @ inverse @ np.cross(arm, blow)
        x = x + dt * v
        q = quaternions.product(q, quaternions.from_rotation_vector(dt * w))
        if (step + 1) % scene.steps_per_sample(dt) == 0:
            rows.append((x, q, v, w))
    return of_one_body(scene.sample_times(), *(np.array(part) for part in zip(*rows, strict=True)))


@EVERY
def test_impulses_at_the_lowest_point_lead_to_the_truth(scene):
    assert judged(scene, stepped(scene)) == set()
    coarse, fine = (
        scene.observables[2]
        .distance(scene, stepped(scene, dt), scene.truth(scene, scene.sample_times()))
        .max()
        for dt in (1.6e-3, 8e-4)
    )
    assert coarse / fine == pytest.approx(2.0, rel=0.05)


@EVERY
def test_the_disc_starts_rolling_and_keeps_rolling(scene):
    start = scene.truth(scene, np.array([0.0]))
    assert start.velocity[0, 0] == pytest.approx(np.array(scene.v0[:3]), abs=1e-15)
    assert start.position[0, 0] == pytest.approx(np.array(scene.q0[:3]), abs=1e-15)
    m = scene.truth(scene, scene.sample_times())
    assert np.abs(disc._slip(scene, m)).max() < 1e-14
    assert np.abs(disc._gap(scene, m)).max() < 1e-15
    assert disc._most(scene, m) == pytest.approx(disc.LEANS[scene.variant], rel=1e-12)


def test_the_two_are_on_either_side_of_the_threshold():
    slow = rolling_disc.upright_threshold(disc.MASS, disc.RADIUS, (disc.I1, disc.I3), disc.GRAVITY)
    assert (slow * disc.RADIUS) ** 2 == pytest.approx(disc.GRAVITY * disc.RADIUS / 3)
    moments = (disc.I1, disc.I3)
    for variant, grows in (("stable", False), ("unstable", True)):
        spin = disc.SPEEDS[variant] * slow
        wobble = rolling_disc.steady_wobble(
            disc.MASS, disc.RADIUS, moments, disc.GRAVITY, np.pi / 2, 0.0, spin
        )
        assert (wobble.growth > 0) is grows


def test_a_rim_with_a_width_is_seen():
    # It touches half a width nearer to where the disc leans, which holds it up.
    assert {"orientation", "omega"} <= judged(UNSTABLE, stepped(UNSTABLE, off=5e-3))


def test_a_rim_that_slips_is_seen():
    assert {"slip"} <= judged(UNSTABLE, stepped(UNSTABLE, holds=0.5))


def test_a_disc_that_stands_is_seen():
    m = UNSTABLE.truth(UNSTABLE, UNSTABLE.sample_times())
    still = replace(m, quaternion=np.broadcast_to(m.quaternion[:1], m.quaternion.shape))
    assert {"orientation", "largest lean", "gap"} <= judged(UNSTABLE, still)
