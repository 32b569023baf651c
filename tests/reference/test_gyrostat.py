"""The gyrostat: its laws against the general tree, its motion against them, steadiness by eigenvalues."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from poinsot.reference import equations_of_motion as eom
from poinsot.reference import quaternions, torque_free
from poinsot.reference.errors import InputError
from poinsot.reference.gyrostat import (
    accelerations,
    motion,
    precession_rate,
    steady_wobble,
    steadying_momentum,
)
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

vectors = hnp.arrays(float, 3, elements=st.floats(-3, 3))


@settings(max_examples=30, deadline=None)
@given(vectors, st.floats(-20, 20), vectors, st.floats(-2, 2), st.integers(0, 1000))
def test_the_laws_are_those_of_a_body_with_a_hinged_wheel(omega, spin, torque, motor, seed):
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(5, 3))
    carrier = sum(np.dot(p, p) * np.eye(3) - np.outer(p, p) for p in points)
    axis = np.array([0.6, 0.0, 0.8])
    J, across = 0.7, 0.5
    wheel = across * np.eye(3) + (J - across) * np.outer(axis, axis)
    links = [
        eom.Link(1.0, carrier, joints=(eom.Joint("ball"),)),
        eom.Link(0.4, wheel, parent=0, joints=(eom.Joint("hinge", axis),)),
    ]
    state = [0, 0, 0, 1, 0.3], [*omega, spin]
    loads = {"joint_forces": [*torque, motor]}
    got = accelerations(carrier + wheel, axis * 3, J, omega, spin, torque, motor)
    expected = eom.accelerations(links, *state, **loads)
    np.testing.assert_allclose([*got[0], got[1]], expected, atol=1e-11)


def test_many_states_at_once():
    rng = np.random.default_rng(1)
    omega, spin = rng.normal(size=(4, 3)), rng.normal(size=4)
    rates = accelerations(np.diag([1.0, 2, 2.5]), [0, 1, 0], 0.3, omega, spin)
    for i in range(4):
        one = accelerations(np.diag([1.0, 2, 2.5]), [0, 1, 0], 0.3, omega[i], spin[i])
        np.testing.assert_allclose(rates[0][i], one[0], atol=1e-15)
        np.testing.assert_allclose(rates[1][i], one[1], atol=1e-15)


@pytest.mark.parametrize("h", [-3.0, 0.0, 0.5])
def test_the_closed_form_follows_the_laws(h):
    I1, I3, J, omega0 = 1.3, 0.8, 0.2, np.array([0.4, -0.7, 1.1])
    q0 = Rotation.from_rotvec([0.3, -1.0, 0.4]).as_quat()

    def rates(_, y):
        w_rate, spin_rate = accelerations(np.diag([I1, I1, I3]), [0, 0, 1], J, y[4:7], y[7])
        return np.concatenate([quaternions.rate(y[:4], y[4:7]), w_rate, [spin_rate]])

    start = np.concatenate([q0, omega0, [h / J]])
    y = solve_ivp(rates, (0, 6), start, method="DOP853", rtol=1e-12, atol=1e-12).y[:, -1]
    q, omega = motion(I1, I3, h, q0, omega0, [0.0, 6.0])
    np.testing.assert_allclose(q[0], q0, atol=1e-15)
    np.testing.assert_allclose(omega[1], y[4:7], atol=1e-10)
    assert (Rotation.from_quat(q[1]).inv() * Rotation.from_quat(y[:4])).magnitude() < 1e-10
    assert y[7] == pytest.approx(h / J, abs=1e-10)
    # ω1 + iω2 turns at the rate.
    phase = np.angle(
        complex(*omega[1, :2]) / complex(*omega0[:2]) * np.exp(-6j * precession_rate(I1, I3, h, 1.1))
    )
    assert phase == pytest.approx(0, abs=1e-13)


@settings(max_examples=40, deadline=None)
@given(vectors, st.floats(-5, 5), st.floats(0.01, 2), st.floats(-1e4, 1e4))
def test_momentum_and_energy_stay(omega0, h, I3, t):
    I1 = 1.0
    q, omega = motion(I1, I3, h, [0, 0, 0, 1], omega0, [0.0, t])
    L = quaternions.rotated(q, omega * [I1, I1, I3] + [0, 0, h])
    np.testing.assert_allclose(L[1], L[0], atol=1e-13 * (1 + np.linalg.norm(L[0])))
    np.testing.assert_allclose(np.linalg.norm(omega, axis=1), np.linalg.norm(omega0), atol=1e-14)
    np.testing.assert_allclose(np.linalg.norm(q, axis=1), 1, atol=1e-15)


def test_without_a_rotor_it_is_a_symmetric_top():
    args = ([0.1, 0.2, -0.3, np.sqrt(1 - 0.14)], [0.5, 0.2, 3.0], [-7.0, 0.3, 1e5])
    q, omega = motion(1.3, 0.8, 0.0, *args)
    expected = torque_free.motion([1.3, 1.3, 0.8], *args)
    np.testing.assert_allclose(omega, expected[1], atol=1e-14)
    assert (Rotation.from_quat(q).inv() * Rotation.from_quat(expected[0])).magnitude().max() < 1e-14
    assert precession_rate(1.3, 0.8, 0.0, 3.0) == torque_free.body_cone_rate(1.3, 0.8, 3.0)


def test_a_rotor_can_stop_the_wobble():
    # h = (I1 − I3)ω3 makes the whole body turn about L as if it were a sphere: ω stays in the body.
    _, omega = motion(1.3, 0.8, 0.5 * 2.0, [0, 0, 0, 1], [0.3, 0.1, 2.0], [0.0, 9.0])
    np.testing.assert_allclose(omega[1], omega[0], atol=1e-14)
    q, omega = motion(1.3, 0.8, 0.0, [0, 0, 0, 1], [0, 0, 0], [5.0])
    np.testing.assert_array_equal(q, [[0, 0, 0, 1]])
    assert not omega.any()


def linear_part(moments, h, omega3):
    J, step = 0.1, 1e-6

    def rates(x):
        # The free rotor keeps σ + ω3, here with σ = h/J when ω3 is as given.
        return accelerations(np.diag(moments), [0, 0, 1], J, x, h / J + omega3 - x[2])[0]

    x0 = np.array([0, 0, omega3])
    A = np.stack([(rates(x0 + step * e) - rates(x0 - step * e)) / (2 * step) for e in np.eye(3)], axis=1)
    return np.linalg.eigvals(A)


@pytest.mark.parametrize("moments", [(1.0, 2.0, 1.5), (2.0, 1.0, 1.5), (1.2, 1.5, 2.0), (1.5, 2.0, 1.2)])
@pytest.mark.parametrize("h", [0.0, 0.3, 3.0, -0.6, -4.0])
def test_steadiness_is_that_of_the_eigenvalues(moments, h):
    frequency, growth = steady_wobble(moments, h, 2.0)
    values = linear_part(moments, h, 2.0)
    assert np.abs(values.imag).max() == pytest.approx(frequency, abs=1e-6)
    assert values.real.max() == pytest.approx(growth, abs=1e-6)
    assert frequency == 0 or growth == 0


def test_the_momentum_that_steadies():
    least = steadying_momentum((1.0, 2.0, 1.5), 3.0)
    assert least == 1.5
    assert steady_wobble((1.0, 2.0, 1.5), 1.000001 * least, 3.0)[1] == 0
    assert steady_wobble((1.0, 2.0, 1.5), 0.999999 * least, 3.0)[1] > 0
    assert steadying_momentum((2.0, 1.0, 1.5), 3.0) == least
    assert steadying_momentum((1.2, 1.5, 2.0), 3.0) == steadying_momentum((1.5, 2.0, 1.2), 3.0) == 0


@pytest.mark.parametrize(
    "call",
    [
        lambda: accelerations(np.diag([1, 1, 3.0]), [0, 0, 1], 0.1, [0, 0, 0], 0.0),
        lambda: accelerations(np.eye(3), [0, 0, 0], 0.1, [0, 0, 0], 0.0),
        lambda: accelerations(np.eye(3), [0, 0, 1], 0.0, [0, 0, 0], 0.0),
        lambda: accelerations(np.eye(3), [0, 0, 1], 1.0, [0, 0, 0], 0.0),
        lambda: accelerations(np.eye(3), [0, 0, 1], 0.1, [0, 0, np.nan], 0.0),
        lambda: motion(1.0, 2.1, 0.0, [0, 0, 0, 1], [0, 0, 1], 1.0),
        lambda: motion(1.0, 1.0, np.nan, [0, 0, 0, 1], [0, 0, 1], 1.0),
        lambda: motion(1.0, 1.0, 0.0, [0, 0, 0, 2], [0, 0, 1], 1.0),
        lambda: motion(1.0, 1.0, 0.0, [0, 0, 0, 1], [0, 1], 1.0),
        lambda: precession_rate(-1.0, 1.0, 0.0, 1.0),
        lambda: steady_wobble((1, 1, 3), 0.0, 1.0),
        lambda: steadying_momentum((1, 2, 2), -1.0),
    ],
)
def test_bad_input_is_refused(call):
    with pytest.raises(InputError):
        call()
