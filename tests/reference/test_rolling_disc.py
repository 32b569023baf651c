"""The rolling disc: two derivations against each other, energy, contact, steady motions and stability."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from poinsot.reference import quaternions
from poinsot.reference import rolling_disc as rd
from poinsot.reference.errors import InputError
from poinsot.reference.rolling_disc_motion import motion
from scipy.spatial.transform import Rotation

G = 9.81
HOOP = (1.3, 0.4, (0.5 * 1.3 * 0.16, 1.3 * 0.16), G)
DISC = (1.3, 0.4, (0.25 * 1.3 * 0.16, 0.5 * 1.3 * 0.16), G)


def start(theta, theta_rate, phi_rate, omega3, phi=0.0, psi=0.0):
    """Attitude and body ω from the angles, z-x-z."""
    q = Rotation.from_euler("ZXZ", [phi, theta, psi]).as_quat()
    node = np.array([theta_rate, phi_rate * np.sin(theta), omega3])  # along e1, e2, e3
    return q, Rotation.from_euler("z", psi).inv().apply(node)


def angles(q):
    return Rotation.from_quat(q).as_euler("ZXZ")


def test_thresholds_that_are_published():
    # v² > gr/4 for a hoop, gr/3 for a disc; a coin on the spot φ̇² > 4g/5r, a hoop 2g/3r.
    r = HOOP[1]
    assert (rd.upright_threshold(*HOOP) * r) ** 2 == pytest.approx(G * r / 4, rel=1e-14)
    assert (rd.upright_threshold(*DISC) * r) ** 2 == pytest.approx(G * r / 3, rel=1e-14)
    assert rd.spinning_threshold(*DISC) ** 2 == pytest.approx(4 * G / (5 * r), rel=1e-14)
    assert rd.spinning_threshold(*HOOP) ** 2 == pytest.approx(2 * G / (3 * r), rel=1e-14)


def test_a_disc_at_rest_falls_like_a_pendulum_about_its_rim():
    m, r, (I1, _), g = DISC
    theta = np.array([0.3, 1.5, 2.8])
    falling, heading, spinning = rd.accelerations(*DISC, theta, 0, 0, 0)
    np.testing.assert_allclose(falling, -m * g * r * np.cos(theta) / (I1 + m * r**2), rtol=1e-15)
    assert not heading.any()
    assert not spinning.any()


def vector_acceleration(body, q, omega):
    """dω/dt in body axes with no angles: Newton's law for the contact's force, put into Euler's equations.

    With u the unit vector up the disc, v = r ω×u, (I + mr²(1 − uuᵀ)) ω̇ = −ω×Iω − r u×(m(r ω×u̇ + ω×v) + mgẑ).
    """
    m, r, (I1, I3), g = body
    inertia = np.array([I1, I1, I3])
    vertical = Rotation.from_quat(q).inv().apply([0, 0, 1.0])
    flat, falling = vertical * [1, 1, 0], np.cross(vertical, omega) * [1, 1, 0]
    u = flat / np.linalg.norm(flat)
    u_rate = (falling - u * (u @ falling)) / np.linalg.norm(flat)
    v = r * np.cross(omega, u)
    push = m * (r * np.cross(omega, u_rate) + np.cross(omega, v) + g * vertical)
    tensor = np.diag(inertia) + m * r**2 * (np.eye(3) - np.outer(u, u))
    return np.linalg.solve(tensor, -np.cross(omega, inertia * omega) - r * np.cross(u, push))


rates = st.floats(-9, 9)


@given(st.floats(0.1, 3.0), rates, rates, rates, st.floats(-3, 3), st.floats(-3, 3))
def test_the_angles_and_the_vectors_give_the_same_accelerations(theta, dtheta, dphi, omega3, phi, psi):
    for body in (HOOP, DISC):
        q, omega = start(theta, dtheta, dphi, omega3, phi, psi)
        theta_acc, phi_acc, omega3_acc = rd.accelerations(*body, theta, dtheta, dphi, omega3)
        # ω̇ along the nodes' axes, from θ̈, φ̈, ω̇3; the body turns past them at ψ̇.
        dpsi = omega3 - dphi * np.cos(theta)
        second = phi_acc * np.sin(theta) + dphi * dtheta * np.cos(theta)
        node = [theta_acc + dphi * np.sin(theta) * dpsi, second - dtheta * dpsi, omega3_acc]
        expected = Rotation.from_euler("z", psi).inv().apply(node)
        size = (1 + abs(dtheta) + abs(dphi) + abs(omega3)) ** 2 / np.sin(theta)
        np.testing.assert_allclose(vector_acceleration(body, q, omega), expected, atol=1e-13 * size)


def test_the_motion_obeys_the_vector_equations():
    q, omega = start(1.1, 0.7, 2.0, -9.0, 0.4, 1.3)
    h = 1e-3
    _, turn, _, w = motion(*DISC, q, omega, 0.7 + h * np.array([-2, -1, 0, 1, 2]))
    numeric = (w[0] - 8 * w[1] + 8 * w[3] - w[4]) / (12 * h)
    np.testing.assert_allclose(numeric, vector_acceleration(DISC, turn[2], w[2]), atol=1e-6)
    spin = quaternions.product(
        quaternions.conjugate(turn[2]), (turn[0] - 8 * turn[1] + 8 * turn[3] - turn[4])
    )
    np.testing.assert_allclose(2 * spin[:3] / (12 * h), w[2], atol=1e-7)


@pytest.mark.parametrize("body", [HOOP, DISC], ids=["hoop", "disc"])
def test_energy_and_contact_along_a_wild_motion(body):
    m, r, (I1, I3), g = body
    q, omega = start(1.1, 0.7, 2.0, -9.0, 0.4, 1.3)
    t = np.array([0.0, -0.8, 1.5, 0.4, 0.4, 2.0])
    position, turn, v, w = motion(*body, q, omega, t, (0.3, -0.2))
    np.testing.assert_allclose(position[0, :2], [0.3, -0.2])
    inertia = np.array([I1, I1, I3])
    energy = 0.5 * m * np.sum(v * v, 1) + 0.5 * np.sum(inertia * w * w, 1) + m * g * position[:, 2]
    # The integrator's tolerance, over some hundred steps.
    np.testing.assert_allclose(energy, energy[0], rtol=2e-12)
    e3 = quaternions.rotated(turn, np.array([0.0, 0, 1.0]))
    up = np.array([0, 0, 1.0]) - e3 * e3[:, 2:]
    contact = -r * up / np.linalg.norm(up, axis=1, keepdims=True)
    np.testing.assert_allclose(position[:, 2] + contact[:, 2], 0, atol=1e-14)
    slip = v + np.cross(quaternions.rotated(turn, w), contact)
    np.testing.assert_allclose(slip, 0, atol=1e-13)
    np.testing.assert_array_equal(position[3], position[4])
    back = motion(*body, turn[2], w[2], -1.5, position[2, :2])
    np.testing.assert_allclose(back[0][0], position[0], atol=1e-11)
    np.testing.assert_allclose(back[3][0], omega, atol=1e-10)


def test_velocity_is_the_rate_of_the_place():
    q, omega = start(1.1, 0.7, 2.0, -9.0, 0.8, 1.3)
    h = 1e-3
    position, _, v, _ = motion(*DISC, q, omega, np.array([-2, -1, 1, 2, 0]) * h)
    numeric = (position[0] - 8 * position[1] + 8 * position[2] - position[3]) / (12 * h)
    np.testing.assert_allclose(numeric, v[4], atol=1e-8)


@pytest.mark.parametrize(("theta", "phi_rate"), [(1.2, 1.5), (2.0, 1.5), (0.4, 6.0), (1.4, -0.8)])
def test_steady_motions_stay_steady_and_circle(theta, phi_rate):
    omega3 = rd.steady_spin(*DISC, theta, phi_rate)
    assert np.stack(rd.accelerations(*DISC, theta, 0, phi_rate, omega3)) == pytest.approx(0, abs=1e-14)
    r = DISC[1]
    q, omega = start(theta, 0, phi_rate, omega3)
    half = np.pi / abs(phi_rate)
    t = [half] if rd.steady_wobble(*DISC, theta, phi_rate, omega3).growth == 0 else [0.1 * half]
    position, turn, _, w = motion(*DISC, q, omega, [0.0, *t])
    np.testing.assert_allclose(w[1, 2], omega3, atol=1e-10)
    assert angles(turn[1])[1] == pytest.approx(theta, abs=1e-10)
    across = 2 * r * abs(omega3 / phi_rate) * abs(np.sin(phi_rate * t[0] / 2))
    assert np.linalg.norm(position[1, :2] - position[0, :2]) == pytest.approx(across, abs=1e-9)


def linear_part(body, theta, phi_rate, omega3):
    """Eigenvalues of the equations of motion linearised by differences."""
    h = 1e-6

    def rates(x):
        return np.array([x[1], *(float(a) for a in rd.accelerations(*body, x[0], x[1], x[2], x[3]))])

    x0 = np.array([theta, 0.0, phi_rate, omega3])
    A = np.stack([(rates(x0 + h * e) - rates(x0 - h * e)) / (2 * h) for e in np.eye(4)], axis=1)
    return np.linalg.eigvals(A)


@pytest.mark.parametrize("body", [HOOP, DISC], ids=["hoop", "disc"])
@pytest.mark.parametrize("state", ["slow", "fast", "spinning", "spinning slowly", "circle", "steep circle"])
def test_growth_and_frequency_are_the_eigenvalues(body, state):
    threshold, on_the_spot = rd.upright_threshold(*body), rd.spinning_threshold(*body)
    theta, phi_rate, omega3 = {
        "slow": (np.pi / 2, 0.0, 0.6 * threshold),
        "fast": (np.pi / 2, 0.0, -1.7 * threshold),
        "spinning": (np.pi / 2, 1.4 * on_the_spot, 0.0),
        "spinning slowly": (np.pi / 2, 0.5 * on_the_spot, 0.0),
        "circle": (1.2, 1.5, rd.steady_spin(*body, 1.2, 1.5)),
        "steep circle": (2.5, -3.0, rd.steady_spin(*body, 2.5, -3.0)),
    }[state]
    got = rd.steady_wobble(*body, theta, phi_rate, omega3)
    values = linear_part(body, theta, phi_rate, omega3)
    # Two eigenvalues are zero (neighbouring steady motions), to the root of the differencing error.
    largest = values[np.argmax(np.abs(values))]
    assert abs(largest.imag) == pytest.approx(got.frequency, abs=1e-4)
    assert abs(largest.real) == pytest.approx(got.growth, abs=1e-4)
    assert (got.growth > 0) == (state in ("slow", "spinning slowly"))


@pytest.mark.parametrize("body", [HOOP, DISC], ids=["hoop", "disc"])
def test_the_threshold_parts_growth_from_swinging(body):
    threshold, on_the_spot = rd.upright_threshold(*body), rd.spinning_threshold(*body)
    for factor, stable in ((0.999999, False), (1.000001, True)):
        rolling = rd.steady_wobble(*body, np.pi / 2, 0.0, factor * threshold)
        spinning = rd.steady_wobble(*body, np.pi / 2, factor * on_the_spot, 0.0)
        for wobble in (rolling, spinning):
            assert (wobble.growth == 0) == stable
            assert (wobble.frequency == 0) != stable


def test_the_wobble_of_a_rolling_hoop_by_hand():
    # ν² = (I3 J s²/I1 − mgr)/(I1 + mr²) = (8v² − 2gr)/(3r²) for a hoop.
    r = HOOP[1]
    v = 3.0
    got = rd.steady_wobble(*HOOP, np.pi / 2, 0.0, v / r)
    assert got.frequency == pytest.approx(np.sqrt((8 * v**2 - 2 * G * r) / (3 * r**2)), rel=1e-14)


def test_a_slow_hoop_topples_at_its_rate_and_a_fast_one_does_not():
    spin = rd.upright_threshold(*HOOP)
    rate = rd.steady_wobble(*HOOP, np.pi / 2, 0.0, 0.5 * spin).growth
    lean = 1e-6
    q, omega = start(np.pi / 2 + lean, rate * lean, 0.5 * spin * lean * 2, 0.5 * spin)
    # φ̇ = I3 ω3 ε/I1 = 2ω3 ε keeps to the growing solution ε = lean·exp(rate·t).
    t = 4.0 / rate
    _, turn, _, _ = motion(*HOOP, q, omega, t)
    assert angles(turn[0])[1] - np.pi / 2 == pytest.approx(lean * np.exp(4.0), rel=1e-6)
    q, omega = start(np.pi / 2 + lean, 0, 0, 1.2 * spin)
    _, turn, _, _ = motion(*HOOP, q, omega, [t, 2 * t])
    assert np.abs(angles(turn)[:, 1] - np.pi / 2).max() < 10 * lean


def test_units_do_not_matter():
    # The same motion 2⁻²⁰ times as large, 2¹⁰ times as fast and of another mass, from another place.
    m, r, moments, g = DISC
    q, omega = start(1.1, 0.7, 2.0, -9.0, 0.4, 1.3)
    small, fast = 2.0**-20, 2.0**10
    scaled = (m * 8.0, r * small, np.multiply(moments, 8.0 * small**2), g * small * fast**2)
    first = motion(*DISC, q, omega, [0.5, 1.0], (1.0, 2.0))
    second = motion(*scaled, q, omega * fast, np.array([0.5, 1.0]) / fast)
    np.testing.assert_allclose(second[0] / small, first[0] - [1.0, 2.0, 0], atol=1e-14)
    np.testing.assert_allclose(second[2] / small / fast, first[2], atol=1e-13)
    np.testing.assert_allclose(second[3] / fast, first[3], atol=1e-13)


def test_upright_rolling_is_straight():
    q, omega = start(np.pi / 2, 0, 0, 3.0)
    position, _, v, _ = motion(*DISC, q, omega, [2.0])
    np.testing.assert_allclose(position[0], [-3.0 * 0.4 * 2, 0, 0.4], atol=1e-12)
    np.testing.assert_allclose(v[0], [-1.2, 0, 0], atol=1e-12)


@pytest.mark.parametrize(
    "call",
    [
        lambda: rd.accelerations(*DISC, 0.0, 0, 0, 0),
        lambda: rd.accelerations(*DISC, np.pi, 0, 0, 0),
        lambda: rd.accelerations(*DISC, np.nan, 0, 0, 0),
        lambda: rd.upright_threshold(1.0, 1.0, (1.0, 2.1), G),
        lambda: rd.upright_threshold(1.0, 1.0, (1.0, 1.0, 1.0), G),
        lambda: rd.upright_threshold(0.0, 1.0, (1.0, 1.0), G),
        lambda: rd.spinning_threshold(1.0, 0.0, (1.0, 1.0), G),
        lambda: rd.spinning_threshold(1.0, 1.0, (1.0, 1.0), 0.0),
        lambda: rd.steady_spin(*DISC, 1.0, 0.0),
        lambda: rd.steady_spin(*DISC, 0.0, 1.0),
        lambda: rd.steady_wobble(*DISC, 1.0, 1.0, 5.0),
        lambda: rd.steady_wobble(*DISC, -1.0, 1.0, 5.0),
        lambda: motion(*DISC, [0, 0, 0, 1], [0, 0, 1], 1.0),
        lambda: motion(*DISC, start(0.5, 0, 0, 0)[0], [0, 0, 0], 3.0),
        lambda: motion(*DISC, [0, 0, 0, 2], [0, 0, 1], 1.0),
        lambda: motion(*DISC, start(1.0, 0, 0, 0)[0], [0, 0, 1], 1.0, (0, 0, 0)),
    ],
)
def test_bad_input_is_refused(call):
    with pytest.raises(InputError):
        call()
