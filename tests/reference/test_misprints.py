"""What the lecture notes print wrong: each printed form fails where the mended one holds.

The table of `reference/SOURCES.md` lists them, each with the name of its test; the last tests here hold the
table and this file together, and the table of formulas and the package.
"""

import importlib
import re
import sys
from pathlib import Path

import numpy as np
import poinsot.reference
import pytest
from poinsot.reference import co2_chain, euler_angles, heavy_top, inertia, normal_modes, torque_free
from poinsot.reference.equations_of_motion import Joint, Link, accelerations
from poinsot.reference.errors import InputError
from poinsot.reference.gyration import gyration
from poinsot.reference.heavy_top_equations import accelerations as top_accelerations
from poinsot.reference.inertia_of_shapes import cone
from poinsot.reference.kepler_orbit import motion as orbit
from poinsot.reference.plumb_line import effective_gravity
from poinsot.reference.rolling import down_an_incline
from poinsot.reference.rotating_frames import (
    apparent_accelerations,
    eastward_deflection,
    local_rotation,
    straight_line_seen_turning,
)
from scipy.spatial.transform import Rotation

# Closed forms agree to rounding; the misprints here are off by parts of one.
ROUNDING = 1e-12
FIVE_POINTS = np.array([1, -8, 0, 8, -1]) / 12
EARTH = 7.292115e-5


def around(t, h=1e-3):
    """Times for a derivative by five points, which errs by about h⁴."""
    return t + h * np.array([-2, -1, 0, 1, 2]), FIVE_POINTS / h


def off(printed, true):
    """Largest departure, relative to the size of what is true."""
    return np.abs(np.asarray(printed) - true).max() / np.abs(true).max()


# --- free tops ------------------------------------------------------------------------------------


def test_wiki_free_precession():
    lam, lam3, w0, w3 = 1.3, 0.8, 0.7, 4.0
    Omega_b = (lam - lam3) / lam * w3  # the wiki's sign: ω̇1 = Ω_b ω2, ω̇2 = −Ω_b ω1
    t = np.array([0.0, 0.4, 1.1])
    true = torque_free.motion([lam, lam, lam3], [0, 0, 0, 1], [w0, 0, w3], t)[1]
    mended = np.column_stack([w0 * np.cos(Omega_b * t), -w0 * np.sin(Omega_b * t)])
    printed = np.column_stack([w0 * np.sin(Omega_b * t), -w0 * np.cos(Omega_b * t)])
    assert off(mended, true[:, :2]) < ROUNDING
    assert off(printed[:1], true[:1, :2]) > 0.9  # it does not even start at (ω0, 0)
    times, five = around(0.4)
    rate = five @ (w0 * np.sin(Omega_b * times))
    assert rate == pytest.approx(-Omega_b * printed[1, 1], rel=1e-9)  # and turns the wrong way


def test_wiki_equal_moments():
    # "λ = −λ1 = λ2": two moments of one body cannot be each other's negative.
    with pytest.raises(InputError):
        torque_free.motion([-1.3, 1.3, 0.8], [0, 0, 0, 1], [0.7, 0, 4.0], 1.0)


def test_slides_eq_52():
    I1, I3, A, wz = 1.3, 0.8, 0.6, 4.0
    Omega = (I1 - I3) * wz / I1
    t, five = around(0.7)
    wx, mended = A * np.cos(Omega * t), -A * np.sin(Omega * t)
    # Eq. 47, ω̇x = Ωωy: the mended ωy holds it, the printed A sin Ωt (for a second ωx) does not.
    assert five @ wx == pytest.approx(Omega * mended[2], rel=1e-9)
    assert five @ wx == pytest.approx(-Omega * A * np.sin(Omega * t[2]), rel=1e-9)
    assert off(mended, torque_free.motion([I1, I1, I3], [0, 0, 0, 1], [A, 0, wz], t)[1][:, 1]) < ROUNDING


def test_handwritten_sense_of_free_precession():
    # ω1 = A sin(ω_p t + φ), ω2 = A cos(ω_p t + φ) with ω_p = (I3/I1 − 1)ω3; should be cos and sin.
    I1, I3, A, w3, phase = 1.3, 0.8, 0.6, 4.0, 0.5
    rate = (I3 / I1 - 1) * w3
    assert rate == pytest.approx(torque_free.body_cone_rate(I1, I3, w3))
    t = np.array([0.0, 0.3, 0.9])
    start = [A * np.cos(phase), A * np.sin(phase), w3]
    true = torque_free.motion([I1, I1, I3], [0, 0, 0, 1], start, t)[1][:, :2]
    mended = A * np.column_stack([np.cos(rate * t + phase), np.sin(rate * t + phase)])
    assert off(mended, true) < ROUNDING
    # Whatever phase the printed pair is given, it turns against the true one.
    printed = complex(0, A) * np.exp(-1j * (rate * t + phase))
    turned = np.angle((true @ [1, 1j])[1:] / complex(*true[0]))
    assert np.angle(printed[1:] / printed[0]) == pytest.approx(-turned, abs=ROUNDING)


def symmetric_state():
    """A free symmetric top: moments, ω and L at an angle θ of e3 to L."""
    I1, I3, omega = 1.3, 0.8, np.array([0.0, -0.9, 2.0])
    L = np.array([I1, I1, I3]) * omega
    return I1, I3, omega, L, np.arctan2(np.linalg.norm(L[:2]), L[2])


def test_handwritten_weight_of_the_space_rate():
    I1, I3, omega, L, theta = symmetric_state()
    size = np.linalg.norm(L)
    along_L = omega @ L / size
    mended = size * (np.sin(theta) ** 2 / I1 + np.cos(theta) ** 2 / I3)
    printed = size * (np.sin(theta) ** 2 / I1 - np.cos(theta) ** 2 / I3)
    assert along_L == pytest.approx(mended, rel=ROUNDING)
    assert abs(printed - along_L) > 0.5 * along_L
    # Less the spin, this must be the rate of precession L/I1.
    spin = size * (1 / I3 - 1 / I1) * np.cos(theta)
    rate = torque_free.space_cone_rate(I1, I3, omega)
    assert mended - spin * np.cos(theta) == pytest.approx(rate, rel=ROUNDING)


def test_handwritten_spin_beside_the_precession():
    # ω_R = L(1/I1 − 1/I3) cosθ; should be L(1/I3 − 1/I1) cosθ, what ω3 leaves beside L/I1 along e3.
    I1, I3, omega, L, theta = symmetric_state()
    left = omega[2] - np.linalg.norm(L) / I1 * np.cos(theta)
    printed = np.linalg.norm(L) * (1 / I1 - 1 / I3) * np.cos(theta)
    assert -printed == pytest.approx(left, rel=ROUNDING)
    assert left == pytest.approx(-torque_free.body_cone_rate(I1, I3, omega[2]), rel=ROUNDING)


def test_big_picture_rate_of_the_body_cone():
    I1, Is, omega = 1.3, 0.8, np.array([0.9, 0.0, 2.0])
    size, alpha = np.linalg.norm(omega), np.arctan2(0.9, 2.0)
    printed = (Is / I1 - 1) * np.cos(alpha)
    true = torque_free.body_cone_rate(I1, Is, omega[2])
    assert size * printed == pytest.approx(true, rel=ROUNDING)
    assert abs(printed - true) > 0.5 * abs(true)


def test_handwritten_eulers_equations():
    # τ1 = λ1ω̇1 − (λ2 − λ1)ω2ω3 and I3ω̇3 = ω1L1 − ω1L2; should be λ2 − λ3, and ω2L1.
    lam, w, torque = np.array([1.0, 1.7, 2.3]), np.array([0.3, -0.8, 1.1]), np.array([0.5, -0.2, 0.4])
    body = [Link(1.0, np.diag(lam), joints=(Joint("ball"),))]
    rate = accelerations(body, [0, 0, 0, 1], w, torques=[torque])
    assert lam[0] * rate[0] - (lam[1] - lam[2]) * w[1] * w[2] == pytest.approx(torque[0], rel=ROUNDING)
    assert abs(lam[0] * rate[0] - (lam[1] - lam[0]) * w[1] * w[2] - torque[0]) > 0.1
    L, free = lam * w, accelerations(body, [0, 0, 0, 1], w)
    assert lam[2] * free[2] == pytest.approx(w[1] * L[0] - w[0] * L[1], rel=ROUNDING)
    assert abs(lam[2] * free[2] - (w[0] * L[0] - w[0] * L[1])) > 0.1


def test_big_picture_first_euler_equation():
    # 0 = I3ω̇1 + ω2ω3(I_s − I); should be Iω̇1.
    I1, Is, w = 1.3, 0.8, np.array([0.6, 0.5, 4.0])
    body = [Link(1.0, np.diag([I1, I1, Is]), joints=(Joint("ball"),))]
    rate = accelerations(body, [0, 0, 0, 1], w)[0]
    assert I1 * rate + w[1] * w[2] * (Is - I1) == pytest.approx(0, abs=ROUNDING)
    assert abs(Is * rate + w[1] * w[2] * (Is - I1)) > 0.1


# --- tops under gravity ---------------------------------------------------------------------------


def test_wiki_precession_of_a_top():
    M, R, g, lam2, lam3, theta, omega = 2.0, 0.1, 9.81, 0.02, 0.01, 0.3, 2000.0
    slow, _ = heavy_top.regular_precession(M, R, (lam2, lam3), g, theta, omega)
    assert M * g * R / (lam3 * omega) == pytest.approx(slow, rel=1e-2)  # the weak-torque limit
    assert M * g * R / (lam2 * omega) == pytest.approx(slow / 2, rel=1e-2)
    # The torque: MgR sinθ, across the axis. Printed without R, it is a force.
    q = Rotation.from_euler("x", theta).as_quat()
    torque = lam2 * np.linalg.norm(top_accelerations(M, R, (lam2, lam3), g, q, [0, 0, omega]))
    assert torque == pytest.approx(M * g * R * np.sin(theta), rel=ROUNDING)
    assert abs(torque - M * g * np.sin(theta)) > torque


def test_wiki_sense_of_a_tops_precession():
    # k̂×ẑ = dk̂/dt · λω/MgR, about k̂; should be ẑ×k̂, about the vertical.
    M, R, g, moments, theta, omega3 = 2.0, 0.1, 9.81, (0.02, 0.01), 0.3, 2000.0
    slow, _ = heavy_top.regular_precession(M, R, moments, g, theta, omega3)
    q0 = Rotation.from_euler("x", theta).as_quat()
    omega0 = [0, slow * np.sin(theta), omega3]
    t, five = around(0.0, 1e-4)
    q, _ = heavy_top.motion(M, R, moments, g, q0, omega0, t)
    axis = Rotation.from_quat(q).apply([0, 0, 1.0])
    up = np.array([0, 0, 1.0])
    np.testing.assert_allclose(five @ axis, slow * np.cross(up, axis[2]), atol=1e-9)
    assert np.linalg.norm(five @ axis - slow * np.cross(axis[2], up)) > slow * np.sin(theta)


def test_lecture_24_lagrangian_without_the_cyclic_angles():
    # L(β, β̇) = ½I1β̇² + (p_α − p_γ cosβ)²/(2I1 sin²β) + … − Mgl cosβ; Routh's function has minus there.
    I1, I3, M, arm, g, beta, da, dc = 1.3, 0.6, 2.0, 0.4, 9.81, 0.7, 0.9, 11.0
    p_gamma = I3 * (da * np.cos(beta) + dc)
    p_alpha = I1 * da * np.sin(beta) ** 2 + p_gamma * np.cos(beta)

    def middle(b):
        return (p_alpha - p_gamma * np.cos(b)) ** 2 / (2 * I1 * np.sin(b) ** 2)

    b, five = around(beta)
    turning, falling = five @ middle(b), five @ (M * g * arm * np.cos(b))
    at_com = np.diag([I1 - M * arm**2, I1 - M * arm**2, I3])
    hinges = (Joint("hinge"), Joint("hinge", (0, 1, 0)), Joint("hinge"))
    top = [Link(M, at_com, (0, 0, arm), joints=hinges)]
    true = accelerations(top, [0.3, beta, 2.0], [da, 0.0, dc], [0, 0, -g])[1]
    assert I1 * true == pytest.approx(-turning - falling, rel=1e-9)
    assert abs(I1 * true - (turning - falling)) > 0.5 * abs(I1 * true)


# --- Euler angles ---------------------------------------------------------------------------------


def passive(angle, axis):
    """The matrices that the notes print: components of a fixed vector in turned axes."""
    c, s = np.cos(angle), np.sin(angle)
    return {
        "x": np.array([[1, 0, 0], [0, c, s], [0, -s, c]]),
        "y": np.array([[c, 0, -s], [0, 1, 0], [s, 0, c]]),
        "z": np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]),
    }[axis]


def test_slides_order_of_the_euler_matrices():
    phi, theta, psi = 0.4, 0.9, -1.3
    A_phi, A_theta, A_psi = passive(phi, "z"), passive(theta, "x"), passive(psi, "z")
    true = euler_angles.zxz_direction_cosines([phi, theta, psi])  # the matrix of eq. 20, entry by entry
    assert off(A_psi @ A_theta @ A_phi, true) < ROUNDING
    assert off(A_phi @ A_theta @ A_psi, true) > 0.5


def test_lecture_24_order_of_the_euler_matrices():
    # V′ = R_α R_β R_γ V; with its own matrices, as its e3⁰ in body axes shows, R_γ R_β R_α.
    alpha, beta, gamma = 0.4, 0.9, -1.3
    R_alpha, R_beta, R_gamma = passive(alpha, "z"), passive(beta, "y"), passive(gamma, "z")
    to_world = Rotation.from_quat(euler_angles.zyz_attitude([alpha, beta, gamma])).as_matrix()
    assert off(R_gamma @ R_beta @ R_alpha, to_world.T) < ROUNDING
    assert off(R_alpha @ R_beta @ R_gamma, to_world.T) > 0.3
    e3 = [-np.sin(beta) * np.cos(gamma), np.sin(beta) * np.sin(gamma), np.cos(beta)]
    np.testing.assert_allclose((R_gamma @ R_beta @ R_alpha)[:, 2], e3, atol=ROUNDING)


def test_handwritten_omega_in_space():
    angles, rates = np.array([0.4, 0.9, -1.3]), np.array([0.7, -0.5, 2.1])
    h = 1e-4
    turns = Rotation.from_quat(euler_angles.zxz_attitude(angles + np.outer([-h, h], rates)))
    true = (turns[1] * turns[0].inv()).as_rotvec() / (2 * h)
    (_, theta, psi), (dphi, dtheta, dpsi) = angles, rates
    s, c = np.sin(theta), np.cos(theta)
    printed = [
        dtheta * np.cos(psi) + dphi * np.sin(psi) * s,
        dtheta * np.sin(psi) - dphi * np.cos(psi) * s,
        dphi + dpsi * c,
    ]
    mended = euler_angles.zxz_omega_world(angles, rates)  # φ for ψ, and the spin's rate for the heading's
    assert off(mended, true) < 1e-7
    assert off(printed, true) > 0.3


def test_handwritten_kinetic_energy():
    # ½I_zz(ψ̇² + φ̇²cos²θ); should be ½I_zz(ψ̇ + φ̇cosθ)².
    (phi, theta, psi), (dphi, dtheta, dpsi) = (0.4, 0.9, -1.3), (0.7, -0.5, 2.1)
    I1, I3 = 1.3, 0.8
    omega = euler_angles.zxz_omega([phi, theta, psi], [dphi, dtheta, dpsi])
    true = 0.5 * np.sum(np.array([I1, I1, I3]) * omega**2)
    across = 0.5 * I1 * (dphi**2 * np.sin(theta) ** 2 + dtheta**2)
    assert across + 0.5 * I3 * (dpsi + dphi * np.cos(theta)) ** 2 == pytest.approx(true, rel=ROUNDING)
    assert off(across + 0.5 * I3 * (dpsi**2 + dphi**2 * np.cos(theta) ** 2), true) > 0.2


# --- mass -----------------------------------------------------------------------------------------


def points():
    rng = np.random.default_rng(4)
    return rng.uniform(0.5, 2, size=6), rng.normal(size=(6, 3))


def test_big_picture_displaced_axes():
    m, r = points()
    M, a = m.sum(), (m @ r) / m.sum()
    about_centre = inertia.of_points(m, r - a)
    true = inertia.of_points(m, r)
    printed = M * np.array(
        [
            [a[1] ** 2 + a[2] ** 2, -a[0] * a[1], -a[0] * a[2]],
            [-a[0] * a[1], a[0] ** 2 + a[2] ** 2, 0],
            [-a[0] * a[2], 0, a[0] ** 2 + a[1] ** 2],
        ]
    )
    mended = printed.copy()
    mended[1, 2] = mended[2, 1] = -M * a[1] * a[2]
    assert off(about_centre + mended, true) < ROUNDING
    assert off(inertia.about_point(about_centre, M, a), true) < ROUNDING
    assert np.abs(about_centre + printed - true).max() == pytest.approx(M * abs(a[1] * a[2]), rel=1e-9)


def test_big_picture_tensor_that_no_body_has():
    with pytest.raises(InputError):
        inertia.lamina([[1, 2], [2, 3]])
    assert np.linalg.eigvalsh([[1, 2], [2, 3]])[0] == pytest.approx(2 - np.sqrt(5))
    # Its second eigenvector: of length √(1 + ¼(1 + √5)²) = 1.90, not 1.40, so (0.851, −0.526) in size.
    golden = (1 + np.sqrt(5)) / 2
    assert np.hypot(1, golden) == pytest.approx(1.902, abs=5e-4)
    unit = np.array([-golden, 1]) / np.hypot(1, golden)
    np.testing.assert_allclose(np.array([[1, 2], [2, 3]]) @ unit, (2 - np.sqrt(5)) * unit, atol=ROUNDING)
    np.testing.assert_allclose(unit, [-0.851, 0.526], atol=5e-4)


def test_big_picture_products_of_inertia():
    # I_yz = −I_zy; they are equal, or the tensor would turn ω into something that is not Σ m r×(ω×r).
    m, r = points()
    true = inertia.of_points(m, r)
    omega = np.array([0.3, -1.0, 0.7])
    L = np.sum(m[:, None] * np.cross(r, np.cross(omega, r)), axis=0)
    skew = true.copy()
    skew[2, 1] *= -1
    assert off(true @ omega, L) < ROUNDING
    assert off(skew @ omega, L) > 0.1


def test_handwritten_products_of_inertia():
    # Entries (1, 3) and (3, 1) of two printed tensors are +Σ m x z; should be minus.
    m, r = points()
    omega = np.array([0.3, -1.0, 0.7])
    L = np.sum(m[:, None] * np.cross(r, np.cross(omega, r)), axis=0)
    printed = inertia.of_points(m, r)
    printed[0, 2] = printed[2, 0] = np.sum(m * r[:, 0] * r[:, 2])
    assert off(printed @ omega, L) > 0.1


def test_wiki_elements_of_the_tensor():
    # I_ii = Σ m j k, and for the cone I_xy = +∫ρxy; should be Σ m (j² + k²), and minus.
    m, r = points()
    true = inertia.of_points(m, r)
    assert true[0, 0] == pytest.approx(np.sum(m * (r[:, 1] ** 2 + r[:, 2] ** 2)), rel=ROUNDING)
    assert abs(true[0, 0] - np.sum(m * r[:, 1] * r[:, 2])) > 0.5 * true[0, 0]
    assert true[0, 1] == pytest.approx(-np.sum(m * r[:, 0] * r[:, 1]), rel=ROUNDING)


def test_wiki_momentum_about_a_fixed_axis():
    # L = ω(I_xz î + I_yz k̂ + I_zz k̂); the second is ĵ.
    m, r = points()
    L = np.sum(m[:, None] * np.cross(r, np.cross([0, 0, 2.0], r)), axis=0)
    Ixz, Iyz, Izz = inertia.of_points(m, r)[:, 2]
    np.testing.assert_allclose(2.0 * np.array([Ixz, Iyz, Izz]), L, rtol=1e-12)
    assert abs(L[1]) > 0.1  # the printed vector has none along ĵ


def test_wiki_secular_equation():
    # "The determinant must be non-zero" and (I − 2·1)ω = 0 for λ2 = 11: it must vanish, and (I − 11·1)ω = 0.
    cube = np.array([[8.0, -3, -3], [-3, 8, -3], [-3, -3, 8]])
    assert inertia.principal(cube)[0] == pytest.approx([2, 11, 11], rel=ROUNDING)
    for moment in (2.0, 11.0):
        assert np.linalg.det(cube - moment * np.eye(3)) == pytest.approx(0, abs=1e-10)
    across = np.array([1.0, -1.0, 0.0])
    assert not (cube - 11 * np.eye(3)) @ across @ across
    assert np.linalg.norm((cube - 2 * np.eye(3)) @ across) > 1


def test_handwritten_cone():
    # Last entry 3M/20 · 2h²; should be 2R². Slices of radius ρ = Rz/h have ρ²/2 each, and weigh as ρ².
    R, h = 0.4, 1.1
    nodes, weights = np.polynomial.legendre.leggauss(4)  # exact for the fourth power
    square = (R * (nodes + 1) / 2) ** 2
    moment = weights @ (square * square / 2) / (weights @ square)
    assert moment == pytest.approx(3 / 20 * 2 * R**2, rel=ROUNDING)
    assert cone(R, h).inertia[2, 2] == pytest.approx(moment, rel=ROUNDING)
    assert 3 / 20 * 2 * h**2 > 5 * moment


def test_slides_perpendicular_axes():
    # I_zz = Σ m (r² − y²); should be r² − z², which for a lamina is I_x + I_y.
    m, r = points()
    flat = r * [1, 1, 0]
    true = inertia.of_points(m, flat)
    square = np.sum(flat**2, axis=1)
    assert true[2, 2] == pytest.approx(np.sum(m * (square - flat[:, 2] ** 2)), rel=ROUNDING)
    assert true[2, 2] == pytest.approx(true[0, 0] + true[1, 1], rel=ROUNDING)
    assert abs(true[2, 2] - np.sum(m * (square - flat[:, 1] ** 2))) > 0.1


def test_slides_turn_to_principal_axes():
    # I_D = R̃IR with r′ = Rr; that is R̃ for R: the tensor in the primed axes is RIR̃.
    m, r = points()
    tensor = inertia.of_points(m, r)
    moments, axes = inertia.principal(tensor)
    R = axes.T  # r′ = Rr are the components along the axes
    np.testing.assert_allclose(inertia.of_points(m, r @ R.T), R @ tensor @ R.T, atol=1e-12)
    np.testing.assert_allclose(R @ tensor @ R.T, np.diag(moments), atol=1e-12)
    assert off(R.T @ tensor @ R, np.diag(moments)) > 0.1


def test_wiki_central_force():
    # F = +G(Mm/R³)R repels; the planet's orbit needs the other sign.
    t, five = around(0.3)
    r, v = orbit(2.0, [1.0, 0, 0], [0, 1.2, 0], t)
    attraction = -2.0 * r[2] / np.linalg.norm(r[2]) ** 3
    np.testing.assert_allclose(five @ v, attraction, atol=1e-8)
    assert off(-attraction, five @ v) > 1


# --- small oscillations ---------------------------------------------------------------------------

OXYGEN, CARBON, BOND = 2.66, 1.99, 3.0


def test_slides_eq_109():
    m, M = OXYGEN, CARBON
    eta = np.array([0.1, -0.3, 0.25])
    T, V = co2_chain.energies(m, M, BOND)
    true = normal_modes.normal_coordinates(T, V, eta)
    mended = np.sqrt(m * M / (2 * (2 * m + M))) * (eta[0] + eta[2] - 2 * eta[1])
    printed = np.sqrt(m * M / (2 * m + M)) * ((eta[0] + eta[2]) - np.sqrt(2) * eta[1])
    assert abs(mended) == pytest.approx(abs(true[2]), rel=ROUNDING)
    assert co2_chain.normal_coordinates(m, M, eta)[2] == pytest.approx(mended, rel=ROUNDING)
    assert abs(abs(printed) - abs(true[2])) > 0.05
    # A mere displacement of the whole molecule must not show in a vibration; in the printed one it does.
    assert np.ones(3) @ [1, -2, 1] == 0
    assert abs(2 - np.sqrt(2)) > 0.5


def test_slides_secular_equation():
    # Σ_ij V_ij − ω²T_ij = 0; should be det(V − ω²T) = 0, and eqs. 69–73 hold for each i, not summed.
    T, V = co2_chain.energies(OXYGEN, CARBON, BOND)
    for omega in co2_chain.frequencies(OXYGEN, CARBON, BOND):
        secular = V - omega**2 * T
        assert np.linalg.det(secular) == pytest.approx(0, abs=1e-10)
        if omega > 0:
            assert abs(secular.sum()) > 1
    # Nor are the roots all above 0: this molecule's own first one is 0.
    assert co2_chain.frequencies(OXYGEN, CARBON, BOND)[0] == 0


def test_slides_lagrangian_of_small_oscillations():
    # ½(ΣT_ij η̇_j² − ΣV_ij η_j²); should be T_ij η̇_i η̇_j and V_ij η_i η_j.
    _, V = co2_chain.energies(OXYGEN, CARBON, BOND)
    eta = np.array([0.1, -0.3, 0.25])
    stretched = 0.5 * BOND * ((eta[1] - eta[0]) ** 2 + (eta[2] - eta[1]) ** 2)
    assert 0.5 * eta @ V @ eta == pytest.approx(stretched, rel=ROUNDING)
    assert 0.5 * np.sum(V @ eta**2) == pytest.approx(0, abs=1e-15)  # for any displacement at all


def test_slides_inverse_of_the_mode_matrix():
    # ξ = A†η; A is real, and its inverse is not its transpose but AᵀT (the matrix printed is that).
    T, V = co2_chain.energies(OXYGEN, CARBON, BOND)
    _, A = normal_modes.normal_modes(T, V)
    np.testing.assert_allclose(A.T @ T @ A, np.eye(3), atol=1e-14)
    assert off(A.T @ A, np.eye(3)) > 0.1


def test_slides_double_pendulum():
    # y1 = −l cosθ2; should be −l cosθ1, as the potential after it has.
    length, g, t1, t2 = 0.9, 9.81, 1.2, -0.5
    V = -g * length * (2 * np.cos(t1) + np.cos(t1 + t2))
    mended = g * (-length * np.cos(t1) + (-length * np.cos(t1) - length * np.cos(t1 + t2)))
    printed = g * (-length * np.cos(t2) + (-length * np.cos(t2) - length * np.cos(t1 + t2)))
    assert mended == pytest.approx(V, rel=ROUNDING)
    assert abs(printed - V) > 1


# --- frames and rolling ---------------------------------------------------------------------------


def test_handwritten_sign_of_the_coriolis_force():
    # F = 2m ω×ṙ beside 2m v×ω, and r̈ = g + 2ω×ṙ: only v×Ω makes the puck run straight in the room.
    Omega, h = np.array([0, 0, 0.8]), 1e-3
    t, five = around(1.0, h)
    r, v = straight_line_seen_turning(Omega, [1.0, 0.5, 0], [0.3, -0.2, 0], t)
    _, centrifugal, _ = apparent_accelerations(Omega, np.zeros(3), r[2], v[2])
    np.testing.assert_allclose(five @ v, 2 * np.cross(v[2], Omega) + centrifugal, atol=1e-9)
    assert off(2 * np.cross(Omega, v[2]) + centrifugal, five @ v) > 0.5
    # With the printed sign a stone would land as far west as it does east.
    W = 2 * local_rotation(EARTH, np.pi / 2)
    fall = np.sqrt(200 / 9.8)
    east = eastward_deflection(EARTH, np.pi / 2, 9.8, fall)[0]
    for sign, expected in ((-1, east), (1, -east)):
        landed = gyration(sign * W, [0, 0, -9.8], np.zeros(3), np.zeros(3), fall)[0]
        assert landed[0, 0] == pytest.approx(expected, rel=1e-5)


def test_handwritten_sign_of_the_centrifugal_force():
    # (r×ω)×ω points to the axis; should be (ω×r)×ω.
    Omega, r = np.array([0, 0, 0.8]), np.array([1.0, 0.5, 0.3])
    _, outward, _ = apparent_accelerations(Omega, np.zeros(3), r, np.zeros(3))
    np.testing.assert_allclose(outward, 0.64 * r * [1, 1, 0], rtol=1e-14)
    np.testing.assert_allclose(np.cross(np.cross(r, Omega), Omega), -outward, rtol=1e-14)


def test_handwritten_plumb_line():
    # α_max = ω²r/g0 = 0.0034/9.8 = 0.0017; should be ω²r/2g0 = 0.034/(2 · 9.8), since sin 45° cos 45° = ½.
    g0, R = 9.8, 6.371e6
    true = effective_gravity(g0, EARTH, R, np.pi / 4).deflection
    assert pytest.approx(0.034, abs=2e-4) == EARTH**2 * R
    assert EARTH**2 * R / (2 * g0) == pytest.approx(true, rel=2e-3)  # to first order in 0.0034
    assert true == pytest.approx(0.0017, abs=5e-5)
    assert abs(EARTH**2 * R / g0 - true) > 0.9 * true
    assert abs(0.0034 / 9.8 - true) > 0.7 * true


def test_big_picture_friction_of_a_rolling_body():
    # F a = (I/a²)ẍ and 0 = mg cosθ + F_N; should be (I/a)ẍ, which gives its own F = (I/a²)ẍ, and −mg cosθ.
    a, kk, g, theta = 0.3, 0.4, 9.81, 0.2
    got = down_an_incline(a, kk, g, theta, 1.0, [1.0])
    acceleration = got.v[0] / 1.0
    inertia_over_mass = kk * a**2
    assert got.friction[0] * a == pytest.approx(inertia_over_mass / a * acceleration, rel=ROUNDING)
    assert abs(got.friction[0] * a - inertia_over_mass / a**2 * acceleration) > 0.5 * got.friction[0] * a


# --- the page and this file -----------------------------------------------------------------------

SOURCES = Path(poinsot.reference.__file__).with_name("SOURCES.md")


def test_the_page_lists_every_misprint_with_its_test():
    listed = set(re.findall(r"`(test_\w+)`", SOURCES.read_text(encoding="utf-8")))
    here = {name for name in vars(sys.modules[__name__]) if name.startswith("test_")}
    about_the_page = {name for name in here if name.startswith("test_the_page")}
    assert listed == here - about_the_page


def test_the_page_names_only_what_there_is():
    named = re.findall(r"`([a-z_0-9]+)\.([a-zA-Z_0-9]+)`", SOURCES.read_text(encoding="utf-8"))
    assert len(named) > 60
    for module, name in named:
        assert hasattr(importlib.import_module(f"poinsot.reference.{module}"), name), f"{module}.{name}"


def test_the_page_has_a_row_for_each_of_the_35_systems():
    rows = re.findall(r"^\| (\d+) \|", SOURCES.read_text(encoding="utf-8"), flags=re.MULTILINE)
    assert [int(row) for row in rows] == list(range(1, 36))
