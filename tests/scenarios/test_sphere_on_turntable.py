"""A ball on a turning table: the truth against Newton and Euler, and engines that mistake the surface."""

from dataclasses import replace

import numpy as np
import pytest
from poinsot.reference import quaternions, sphere_on_turntable
from poinsot.reports import truth
from poinsot.reports.cell import Cell
from poinsot.reports.verdict import Status
from poinsot.scenarios import sphere_on_turntable as ball
from poinsot.scenarios.trajectory import Provenance

[SCENE] = ball.SCENES
DT = 1e-3


def judged(motion, dt=DT):
    run = Provenance(SCENE.full_name, "engine", "1", "Euler", 1, "semi-implicit Euler", dt, round(1.28 / dt))
    return {v.observable for v in truth.check(Cell(SCENE, motion, run)) if v.status is not Status.PASS}


def stepped(dt=DT, knows=1.0, holds=1.0):
    """The scheme by hand: an impulse at the lowest point that ends the slip over the table.

    ``knows`` is the share of the table's speed that the impulse reckons with, ``holds`` of the slip it ends.
    """
    a, m, up = ball.RADIUS, ball.MASS, np.array([0.0, 0.0, 1.0])
    moment = 0.4 * m * a * a
    x, v, q = np.array(SCENE.q0[1:4]), np.array(SCENE.v0[1:4]), np.array(SCENE.q0[4:])
    w = quaternions.rotated(q, np.array(SCENE.v0[4:]))
    rows = [(x, v, q, w)]
    for step in range(round(SCENE.duration / dt)):
        slip = v - np.cross(w, a * up) - knows * np.cross(ball.TURNING * up, x * [1, 1, 0])
        blow = -holds * slip / (1 / m + a * a / moment)
        v, w = v + blow / m, w + np.cross(-a * up, blow) / moment
        x, q = x + v * dt, quaternions.product(quaternions.from_rotation_vector(w * dt), q)
        if (step + 1) % SCENE.steps_per_sample(dt) == 0:
            rows.append((x, v, q, w))
    x, v, q, w = (np.array(part) for part in zip(*rows, strict=True))
    return ball._assembled(SCENE, SCENE.sample_times(), x[:, :2], v[:, :2], q, w)


def test_the_scheme_by_hand_is_the_schemes_own_motion():
    assert judged(stepped()) == set()


def test_the_truth_obeys_newton_and_euler_without_slipping():
    h = 1e-5
    t = np.array([0.5, 0.5 + h, 0.5 + 2 * h])
    m = SCENE.truth(SCENE, np.concatenate([[0.0], t]))
    v, w = m.velocity[1:, 1], quaternions.rotated(m.quaternion[1:, 1], m.omega[1:, 1])
    force = ball.MASS * (v[2] - v[0]) / (2 * h)
    torque = 0.4 * ball.MASS * ball.RADIUS**2 * (w[2] - w[0]) / (2 * h)
    assert torque == pytest.approx(np.cross([0.0, 0.0, -ball.RADIUS], force), abs=1e-9)
    assert np.abs(ball._slip(SCENE, m)).max() < 1e-14
    # The attitude turns as ω says: a step of the exponential through the middle is good to h³.
    turn = quaternions.product(m.quaternion[3, 1], quaternions.conjugate(m.quaternion[1, 1]))
    assert quaternions.rotation_vector(turn) == pytest.approx(2 * h * w[1], abs=1e-12)


def test_the_attitude_is_followed_finely_enough(monkeypatch):
    t = SCENE.sample_times()
    found = SCENE.truth(SCENE, t)
    monkeypatch.setattr(ball, "FINE", ball.FINE + 1)
    assert SCENE.observables[2].distance(SCENE, SCENE.truth(SCENE, t), found).max() < 2e-14


def test_the_path_is_a_circle_gone_round_at_two_sevenths():
    assert pytest.approx(2 * ball.TURNING / 7, rel=1e-15) == ball.RATE
    assert sphere_on_turntable.circling_rate(ball.TURNING) == pytest.approx(ball.RATE, rel=1e-15)
    t = np.linspace(0.0, 2 * np.pi / ball.RATE, 9)
    r, v, _ = ball._plane_motion(SCENE, t)
    center = r + np.column_stack([-v[:, 1], v[:, 0]]) / ball.RATE
    assert center == pytest.approx(np.broadcast_to(center[0], center.shape), abs=1e-14)
    phase = np.unwrap(np.angle(ball._circling(SCENE, SCENE.truth(SCENE, SCENE.sample_times()))))
    assert (phase[-1] - phase[0]) / SCENE.duration == pytest.approx(ball.RATE, rel=1e-13)


def test_an_engine_that_takes_the_surface_for_still_is_seen():
    assert {"velocity", "circling", "slip"} <= judged(stepped(knows=0.0))


def test_an_engine_that_mistakes_the_surfaces_speed_a_little_is_seen():
    assert {"velocity, scheme's own", "omega, scheme's own"} <= judged(stepped(knows=1 + 1e-9))


def test_friction_that_gives_way_is_seen():
    assert {"velocity", "slip"} <= judged(stepped(holds=0.9))


def test_a_table_that_is_slowed_is_seen():
    m = SCENE.truth(SCENE, SCENE.sample_times())
    slowed = replace(m, joint_velocity=m.joint_velocity * (1 - 1e-9))
    assert "table" in judged(slowed)


def test_it_starts_rolling_as_the_reference_says():
    rolling = sphere_on_turntable.ball_on_a_turntable(
        ball.RADIUS, ball.TURNING, ball.PLACE, ball.VELOCITY, [0.0], ball.SPIN
    )[2]
    assert rolling[0] == pytest.approx(ball.OMEGA, rel=1e-15)
