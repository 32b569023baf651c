"""Motion in turning frames against matrix exponentials in many digits, residuals and Taylor's figures."""

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from poinsot.reference.errors import InputError
from poinsot.reference.gyration import gyration
from poinsot.reference.rotating_frames import (
    apparent_accelerations,
    coriolis_fall,
    eastward_deflection,
    local_rotation,
    straight_line_seen_turning,
)
from scipy.spatial.transform import Rotation

EARTH = 7.292115e-5  # rad/s, the rate of the sidereal day
vectors = hnp.arrays(float, 3, elements=st.floats(-5, 5))
times = st.floats(-50, 50)


def exponential_motion(W, f, r0, v0, t):
    """R̈ = f + W×ṙ as a linear system with a constant, by mpmath's matrix exponential in 40 digits."""
    with mp.workdps(40):
        A = mp.zeros(7)
        x, y, z = (mp.mpf(float(c)) for c in W)
        cross = mp.matrix([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        for i in range(3):
            A[i, 3 + i] = 1
            A[3 + i, 6] = mp.mpf(float(f[i]))
            for j in range(3):
                A[3 + i, 3 + j] = cross[i, j]
        start = mp.matrix([mp.mpf(float(c)) for c in [*r0, *v0, 1]])
        end = mp.expm(A * mp.mpf(float(t))) * start
        return np.array([float(c) for c in end[:6]])


@pytest.mark.parametrize("size", [0.0, 1e-12, 1e-5, 0.09, 0.11, 3.0])
@pytest.mark.parametrize("t", [-7.0, 1e-3, 9.0])
def test_gyration_is_the_matrix_exponential(size, t):
    rng = np.random.default_rng(3)
    W, f, r0, v0 = size * rng.normal(size=3), *rng.normal(size=(3, 3))
    r, v = gyration(W, f, r0, v0, t)
    expected = exponential_motion(W, f, r0, v0, t)
    # Rounding of sums of about six terms as large as r0 + v0 t + f t²/2.
    np.testing.assert_allclose(r[0], expected[:3], atol=4e-16 * (1 + abs(t) + t * t) * 4)
    np.testing.assert_allclose(v[0], expected[3:], atol=4e-16 * (1 + abs(t)) * 4)


@pytest.mark.parametrize("phase", [1e-9, 1e-4, 0.3, 0.999999, 1.000001])
def test_the_small_terms_of_gyration_keep_their_digits(phase):
    # From rest at the origin across W, displacement along W×f is (φ − sin φ)/W³ W×f and nothing hides it.
    r, v = gyration([0, 0, phase], [1.0, 0, 0], [0, 0, 0], [0, 0, 0], 1.0)
    with mp.workdps(60):
        x = mp.mpf(phase)
        expected = [(1 - mp.cos(x)) / x**2, (x - mp.sin(x)) / x**2]
        rates = [mp.sin(x) / x, (1 - mp.cos(x)) / x]
    np.testing.assert_allclose(r[0, :2], [float(e) for e in expected], rtol=3e-15)
    np.testing.assert_allclose(v[0, :2], [float(e) for e in rates], rtol=3e-15)
    assert r[0, 2] == v[0, 2] == 0


def test_a_charge_in_a_magnetic_field_keeps_its_circle_after_a_million_turns():
    # Landau & Lifshitz, Classical Theory of Fields, sect. 21: radius v/W, centre where it was.
    t = 2 * np.pi * 1e6 / 3.0
    r, _ = gyration([0, 0, -3.0], [0, 0, 0], [1, 0, 0], [0, 6.0, 0], [0.25, t])
    assert np.linalg.norm(r - [3, 0, 0], axis=1) == pytest.approx([2.0, 2.0], rel=1e-15)
    with mp.workdps(40):
        angle = mp.mpf(3) * mp.mpf(t)
        expected = [3 - 2 * mp.cos(angle), 2 * mp.sin(angle), 0]
    np.testing.assert_allclose(r[1], [float(e) for e in expected], atol=2e-15)


@pytest.mark.parametrize(("length", "time"), [(2.0**40, 2.0**-20), (2.0**-60, 2.0**30)])
def test_units_do_not_matter(length, time):
    W, f, r0, v0 = np.random.default_rng(2).normal(size=(4, 3))
    t = np.array([-3.0, 1e-4, 0.2, 50.0])
    r, v = gyration(W, f, r0, v0, t)
    scaled = gyration(W / time, f * (length / time**2), r0 * length, v0 * (length / time), t * time)
    np.testing.assert_array_equal(scaled[0] / length, r)
    np.testing.assert_array_equal(scaled[1] / (length / time), v)


def test_crossed_fields_drift():
    # Landau & Lifshitz, sect. 22: the mean velocity is f×(−W)/W² and needs no start.
    W, f = np.array([0, 0, 2.0]), np.array([0.5, 0, 0])
    _, v = gyration(W, f, np.zeros(3), np.cross(W, f) / 4.0, np.linspace(0, 9, 7))
    np.testing.assert_allclose(v, np.broadcast_to(np.cross(W, f) / 4.0, v.shape), atol=1e-15)


@settings(max_examples=60, deadline=None)
@given(vectors, vectors, vectors, vectors, times, times)
def test_gyration_composes(W, f, r0, v0, t1, t2):
    r1, v1 = gyration(W, f, r0, v0, t1)
    r, v = gyration(W, f, r1[0], v1[0], t2)
    expected = gyration(W, f, r0, v0, t1 + t2)
    size = 1e-13 * (1 + np.abs([*r0, *v0, *f]).max()) * (1 + abs(t1) + abs(t2)) ** 2
    np.testing.assert_allclose(r, expected[0], atol=size)
    np.testing.assert_allclose(v, expected[1], atol=size)


@settings(max_examples=60, deadline=None)
@given(vectors, vectors, vectors, times)
def test_a_puck_runs_straight_in_the_room(Omega, r0, v0, t):
    r, v = straight_line_seen_turning(Omega, r0, v0, t)
    turn = Rotation.from_rotvec(Omega * t)
    # scipy's own turn by |Ω|t rounds the angle: up to 430 rad here.
    atol = 1e-12 * (1 + abs(t)) * (1 + np.linalg.norm(v0) + np.linalg.norm(Omega) * np.linalg.norm(r0))
    np.testing.assert_allclose(turn.apply(r[0]), r0 + (v0 + np.cross(Omega, r0)) * t, atol=atol)
    np.testing.assert_allclose(
        turn.apply(v[0] + np.cross(Omega, r[0])),
        v0 + np.cross(Omega, r0),
        atol=atol * (1 + np.linalg.norm(Omega)),
    )


def test_a_puck_released_at_rest_on_the_turntable_spirals_out():
    # Taylor, problem 9.20: r² = r0²(1 + Ω²t²), turning back by Ωt less arctan Ωt.
    Omega, t = 0.8, np.array([0.0, 0.5, 3.0])
    r, _ = straight_line_seen_turning([0, 0, Omega], [2.0, 0, 0], [0, 0, 0], t)
    np.testing.assert_allclose(np.hypot(r[:, 0], r[:, 1]), 2 * np.sqrt(1 + (Omega * t) ** 2), rtol=1e-15)
    bearing = np.arctan(Omega * t) - Omega * t
    np.testing.assert_allclose(np.arctan2(r[:, 1], r[:, 0]), bearing, atol=1e-15)


def test_the_puck_obeys_the_apparent_accelerations():
    Omega, r0, v0 = np.array([0.3, -0.5, 0.9]), np.array([1.0, 2.0, -0.5]), np.array([0.2, 0.1, -0.7])
    h, t = 1e-3, 2.0
    _, v = straight_line_seen_turning(Omega, r0, v0, [t - 2 * h, t - h, t + h, t + 2 * h])
    r_now, v_now = straight_line_seen_turning(Omega, r0, v0, t)
    numeric = (v[0] - 8 * v[1] + 8 * v[2] - v[3]) / (12 * h)
    # Five-point difference: h⁴ times a fifth derivative of order one, and rounding/h.
    terms = apparent_accelerations(Omega, np.zeros(3), r_now[0], v_now[0])
    np.testing.assert_allclose(numeric, sum(terms), atol=2e-12)


def test_the_euler_acceleration_of_a_table_that_speeds_up():
    # At rest in the room, seen from a table at angle ½εt²: r = R(−½εt²)r0.
    eps, t, h = 0.7, 1.3, 1e-4
    r0 = np.array([1.5, -0.4])

    def seen(t):
        a = 0.5 * eps * t * t
        return np.array([[np.cos(a), np.sin(a)], [-np.sin(a), np.cos(a)]]) @ r0

    r = np.append(seen(t), 0)
    v = np.append((seen(t + h) - seen(t - h)) / (2 * h), 0)
    a = np.append((seen(t + h) - 2 * seen(t) + seen(t - h)) / h**2, 0)
    coriolis, centrifugal, euler = apparent_accelerations([0, 0, eps * t], [0, 0, eps], r, v)
    # h² times fourth derivatives, and rounding over h² = 1e-8.
    np.testing.assert_allclose(a, coriolis + centrifugal + euler, atol=1e-7)
    assert np.linalg.norm(euler) > 0.1


def test_signs_a_textbook_names():
    coriolis, centrifugal, euler = apparent_accelerations([0, 0, 2.0], [0, 0, 3.0], [1, 0, 0], [0, 1, 0])
    np.testing.assert_array_equal(coriolis, [4, 0, 0])  # to the right of the motion
    np.testing.assert_array_equal(centrifugal, [4, 0, 0])  # outward
    np.testing.assert_array_equal(euler, [0, -3, 0])  # lags behind


def test_a_stone_from_100_m_at_the_equator_lands_2_2_cm_east():
    # Taylor, sect. 9.8, gives 2.2 cm.
    fall = np.sqrt(2 * 100 / 9.8)
    assert eastward_deflection(7.3e-5, np.pi / 2, 9.8, fall)[0] == pytest.approx(0.022, abs=5e-4)
    r, _ = coriolis_fall(7.3e-5, np.pi / 2, 9.8, [0, 0, 100], [0, 0, 0], fall)
    assert r[0, 0] == pytest.approx(0.022, abs=5e-4)
    assert abs(r[0, 1]) < 1e-20  # the cosine of the double next to π/2 is 6e-17


@pytest.mark.parametrize("colatitude", [0.0, 0.6, np.pi / 2, 2.4])
def test_the_first_order_is_the_limit_of_the_exact_fall(colatitude):
    t = 4.0
    for Omega in (1e-3, 1e-4):
        r, _ = coriolis_fall(Omega, colatitude, 9.81, [0, 0, 0], [0, 0, 0], t)
        first = eastward_deflection(Omega, colatitude, 9.81, t)
        # The next order is smaller by (Ωt)²: 1.6e-5 at most.
        assert r[0, 0] == pytest.approx(first[0], rel=(Omega * t) ** 2, abs=1e-15)
    np.testing.assert_allclose(r[0, 2], -0.5 * 9.81 * t**2, rtol=1e-6)


def test_a_stone_thrown_north_drifts_east_in_the_northern_hemisphere():
    # ẍ = 2Ω(ẏ cosθ − ż sinθ), Taylor eq. for the east component, sect. 9.8.
    theta = 1.0
    r, _ = coriolis_fall(EARTH, theta, 9.81, [0, 0, 0], [0, 50.0, 0], 10.0)
    expected = EARTH * 50 * np.cos(theta) * 100 + EARTH * 9.81 * np.sin(theta) * 1000 / 3
    assert r[0, 0] == pytest.approx(expected, rel=1e-6)
    np.testing.assert_allclose(local_rotation(2.0, theta), [0, 2 * np.sin(theta), 2 * np.cos(theta)])


@pytest.mark.parametrize(
    "call",
    [
        lambda: coriolis_fall(EARTH, -0.1, 9.8, [0, 0, 0], [0, 0, 0], 1.0),
        lambda: coriolis_fall(EARTH, 3.2, 9.8, [0, 0, 0], [0, 0, 0], 1.0),
        lambda: coriolis_fall(EARTH, 1.0, -9.8, [0, 0, 0], [0, 0, 0], 1.0),
        lambda: coriolis_fall(EARTH, 1.0, 9.8, [0, 0], [0, 0, 0], 1.0),
        lambda: coriolis_fall(np.nan, 1.0, 9.8, [0, 0, 0], [0, 0, 0], 1.0),
        lambda: gyration([0, 0, 1], [0, 0, 0], [0, 0, 0], [0, 0, 0], [[1.0]]),
        lambda: gyration([0, 0, 1], [0, 0, 0], [0, 0, np.inf], [0, 0, 0], [1.0]),
        lambda: straight_line_seen_turning([0, 0], [0, 0, 0], [0, 0, 0], 1.0),
        lambda: straight_line_seen_turning([0, 0, 1e10], [0, 0, 0], [0, 0, 0], 1e10),
        lambda: eastward_deflection(EARTH, 1.0, -1.0, 1.0),
        lambda: apparent_accelerations([0, 0, np.nan], [0, 0, 0], [0, 0, 0], [0, 0, 0]),
    ],
)
def test_bad_input_is_refused(call):
    with pytest.raises(InputError):
        call()
