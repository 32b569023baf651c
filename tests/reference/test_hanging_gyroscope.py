"""The gyroscope on a rope against a tree of two links, against the heavy top, and in small motions."""

import math

import numpy as np
import pytest
from poinsot.reference import equations_of_motion, euler_angles, hanging_gyroscope_motion, quaternions
from poinsot.reference.equations_of_motion import Joint, Link
from poinsot.reference.errors import InputError
from poinsot.reference.hanging_gyroscope import Gyroscope, Rope, accelerations, small_rates, steady_precession
from poinsot.reference.heavy_top import regular_precession
from poinsot.reference.sleeping_top import hanging_rates, upright_rates

WHEEL = Gyroscope(mass=2.0, length=0.15, moments=(0.1, 0.08))
MASSLESS = Rope(length=0.8)
# A uniform rod of 0.3 kg: J = ms²/3, P = ms/2.
ROD = Rope(length=0.8, inertia=0.3 * 0.8**2 / 3, mass_moment=0.3 * 0.4)
SEED = 20240613
G = 9.81


def random_states(n):
    """Directions n, e, their rates, and ω3."""
    random = np.random.default_rng(SEED)
    for _ in range(n):
        turns = random.normal(size=(2, 4))
        turns /= np.linalg.norm(turns, axis=-1, keepdims=True)
        omegas = random.normal(size=(2, 3)) * 4
        omegas[0, 2] = 0  # the rope does not spin
        yield turns, omegas


def directions(turns, omegas):
    """N and e along the bodies' third axes, and their rates."""
    units = quaternions.rotated(turns, np.array([0.0, 0.0, 1.0]))
    return units, np.cross(quaternions.rotated(turns, omegas), units)


def tree():
    across = 0.1 - 2.0 * 0.15**2
    rod = Link(0.3, np.diag([0.3 * 0.64 / 12, 0.3 * 0.64 / 12, 1e-3]), (0, 0, 0.4), joints=(Joint("ball"),))
    wheel = Link(
        2.0,
        np.diag([across, across, 0.08]),
        (0, 0, 0.15),
        parent=0,
        joints=(Joint("ball"),),
        position=(0, 0, 0.8),
    )
    return [rod, wheel]


def test_accelerations_are_those_of_two_links_on_ball_joints():
    for turns, omegas in random_states(12):
        relative = quaternions.product(quaternions.conjugate(turns[0]), turns[1])
        carried = quaternions.rotated(quaternions.conjugate(relative), omegas[0])
        q, v = np.concatenate([turns[0], relative]), np.concatenate([omegas[0], omegas[1] - carried])
        found = equations_of_motion.accelerations(tree(), q, v, (0, 0, -G))
        linear, _ = equations_of_motion.link_accelerations(tree(), q, v, found)
        (n, e), rates = directions(turns, omegas)
        n_second, e_second = accelerations(ROD, WHEEL, G, (n, e), rates, omegas[1, 2])
        assert np.allclose(n_second, linear[0] / 0.4, rtol=1e-11, atol=1e-10)
        assert np.allclose(e_second, (linear[1] - 0.8 * n_second) / 0.15, rtol=1e-11, atol=1e-10)


@pytest.mark.parametrize("rope", [MASSLESS, ROD])
def test_directions_stay_unit_and_energy_and_momentum_stay(rope):
    """d²(n·n)/dt² = 0, dE/dt = 0, dL_z/dt = 0 and dω3/dt = 0, from the accelerations alone."""
    M, arm, (I1, I3) = WHEEL
    for turns, omegas in random_states(12):
        (n, e), (dn, de) = directions(turns, omegas)
        ddn, dde = accelerations(rope, WHEEL, G, (n, e), (dn, de), omegas[1, 2])
        assert abs(n @ ddn + dn @ dn) < 1e-11
        assert abs(e @ dde + de @ de) < 1e-11
        velocity, acceleration = rope.length * dn + arm * de, rope.length * ddn + arm * dde
        about_centre = I1 - M * arm**2
        power = rope.inertia * dn @ ddn + M * velocity @ acceleration + about_centre * de @ dde
        weight = rope.mass_moment * G * dn[2] + M * G * velocity[2]
        assert abs(power + weight) < 1e-10
        place = rope.length * n + arm * e
        torque = (
            rope.inertia * np.cross(n, ddn)
            + M * np.cross(place, acceleration)
            + about_centre * np.cross(e, dde)
            + I3 * omegas[1, 2] * de
        )
        assert abs(torque[2]) < 1e-11


def test_with_a_rope_of_no_length_it_is_the_heavy_top():
    still = Rope(length=0.0, inertia=1.0, mass_moment=0.0)
    theta, omega3 = 2.1, 30.0
    rate = regular_precession(2.0, 0.15, (0.1, 0.08), G, theta, omega3)[0]
    e = np.array([math.sin(theta), 0, math.cos(theta)])
    e_rate = np.array([0, rate * math.sin(theta), 0])
    down = np.array([0.0, 0.0, -1.0])
    n_second, e_second = accelerations(still, WHEEL, G, (down, e), ([0, 0, 0], e_rate), omega3)
    assert np.allclose(e_second, [-(rate**2) * math.sin(theta), 0, 0], atol=1e-12)
    assert np.allclose(n_second, 0)
    assert steady_precession(Rope(0.0), WHEEL, G, theta, rate) == pytest.approx((0, omega3), rel=1e-13)


@pytest.mark.parametrize("rope", [MASSLESS, ROD])
@pytest.mark.parametrize(("beta", "Omega"), [(math.pi / 2, 1.5), (0.5, -4.0), (2.6, 7.0), (1.0, 0.01)])
def test_steady_precession_satisfies_the_equations_of_motion(rope, beta, Omega):
    chi, omega3 = steady_precession(rope, WHEEL, G, beta, Omega)
    assert 0 < chi < math.pi / 2
    n, e = np.array([math.sin(chi), 0, -math.cos(chi)]), np.array([math.sin(beta), 0, math.cos(beta)])
    up = np.array([0.0, 0.0, Omega])
    n_second, e_second = accelerations(rope, WHEEL, G, (n, e), (np.cross(up, n), np.cross(up, e)), omega3)
    scale = 1e-12 * (1 + Omega**2)
    assert np.allclose(n_second, np.cross(up, np.cross(up, n)), atol=scale)
    assert np.allclose(e_second, np.cross(up, np.cross(up, e)), atol=scale)


def test_a_slow_level_wheel_precesses_as_the_book_says():
    """Mgl/(I3ω3) on a rope that hangs nearly straight, tan χ ≈ Ω²l/g."""
    chi, omega3 = steady_precession(MASSLESS, WHEEL, G, math.pi / 2, 0.1)
    assert 2.0 * G * 0.15 / (0.08 * omega3) == pytest.approx(0.1, rel=1e-14)
    assert chi == pytest.approx(0.01 * 0.15 / G, rel=1e-3)


@pytest.mark.parametrize("upright", [False, True])
@pytest.mark.parametrize("rope", [MASSLESS, ROD])
@pytest.mark.parametrize("omega3", [0.0, 20.0, -150.0])
def test_small_motions_follow_the_equations_of_motion(rope, omega3, upright):
    """An eigenvector of the equations, linearised by differences, for each rate."""
    sigma = 1.0 if upright else -1.0
    n0, e0 = np.array([0, 0, -1.0]), np.array([0, 0, sigma])

    def second(state):
        """ζ̈, η̈ of (ζ, η, ζ̇, η̇) small, to first order."""
        small = 1e-6
        units, rates = [], []
        for axis, z, dz in ((n0, state[0], state[2]), (e0, state[1], state[3])):
            unit = axis + small * np.array([z.real, z.imag, 0])
            unit /= np.linalg.norm(unit)
            rate = small * np.array([dz.real, dz.imag, 0])
            units.append(unit)
            rates.append(rate - (rate @ unit) * unit)
        found = accelerations(rope, WHEEL, G, tuple(units), tuple(rates), omega3)
        return np.array([(a[0] + 1j * a[1]) / small for a in found])

    columns = [np.concatenate([column[2:], second(column)]) for column in np.eye(4, dtype=complex)]
    # Motions go as exp(iνt): the eigenvalues of the first-order system are iν.
    expected = np.linalg.eigvals(np.array(columns).T) / 1j
    found = small_rates(rope, WHEEL, G, omega3, upright)
    assert np.all(np.diff(found.real) >= 0)
    for rate in found:
        assert np.abs(expected - rate).min() < 1e-5 * np.abs(expected).max()


def test_small_rates_of_two_pendulums_and_of_a_rope_that_does_not_move():
    """Goldstein ch. 6, Taylor § 11.4: equal point masses on equal strings, ν² = (2 ∓ √2) g/l."""
    rope = Rope(length=1.0, inertia=1.0, mass_moment=1.0)
    bob = Gyroscope(mass=1.0, length=1.0, moments=(1.0 + 1e-12, 1e-3))
    slow, fast = math.sqrt((2 - math.sqrt(2)) * G), math.sqrt((2 + math.sqrt(2)) * G)
    found = small_rates(rope, bob, G, 0.0)
    assert np.allclose(found, [-fast, -slow, slow, fast], atol=1e-9)
    heavy = Rope(length=0.0, inertia=1.0, mass_moment=0.0)
    for upright, by_hand in ((True, upright_rates), (False, hanging_rates)):
        rates = sorted(by_hand(2.0, 0.15, (0.1, 0.08), G, 40.0))
        found = small_rates(heavy, WHEEL, G, 40.0, upright)
        # Two more are those of a rope without weight: 0.
        moving = found[np.abs(found) > 1e-3].real
        assert np.allclose(moving, rates, rtol=1e-10)


def test_upright_on_a_rope_it_takes_a_spin_to_stand():
    assert small_rates(ROD, WHEEL, G, 0.0, upright=True).imag.min() < -1
    assert np.abs(small_rates(ROD, WHEEL, G, 200.0, upright=True).imag).max() < 1e-9
    assert np.abs(small_rates(ROD, WHEEL, G, 3.0).imag).max() < 1e-9


def test_what_cannot_be_is_refused():
    down, still = (0, 0, -1), (0, 0, 0)

    def at(rope=MASSLESS, wheel=WHEEL, n=down, n_rate=still):
        return accelerations(rope, wheel, G, (n, down), (n_rate, still), 1.0)

    at()
    for change, said in (
        ({"rope": Rope(-1.0)}, "rope.length"),
        ({"rope": Rope(1.0, -1.0)}, "rope.inertia"),
        ({"rope": Rope(1.0, 1.0, -1.0)}, "rope.mass_moment"),
        ({"wheel": WHEEL._replace(mass=0)}, "gyroscope.mass"),
        ({"wheel": WHEEL._replace(length=-0.1)}, "gyroscope.length"),
        ({"wheel": WHEEL._replace(moments=(0.045, 0.08))}, "expected more than"),
        ({"n": (0, 0, -1.1)}, "n: got length 1.1"),
        ({"n_rate": (0, 0, 1)}, "n_rate: got"),
    ):
        with pytest.raises(InputError, match=said):
            at(**change)
    for beta, Omega in ((0.0, 1.0), (1.0, 0.0), (4.0, 1.0)):
        with pytest.raises(InputError, match="beta"):
            steady_precession(MASSLESS, WHEEL, G, beta, Omega)
    with pytest.raises(InputError, match="gravity"):
        steady_precession(MASSLESS, WHEEL, 0.0, 1.0, 1.0)
    with pytest.raises(InputError, match="rope: got"):
        small_rates(Rope(0.0), WHEEL, G, 1.0)
    with pytest.raises(InputError, match="rope: got"):
        at(rope=Rope(0.0))


def test_the_integrated_motion_keeps_a_steady_precession():
    Omega, t = 3.0, np.linspace(0.0, 0.5, 6)
    chi, omega3 = steady_precession(ROD, WHEEL, G, 1.9, Omega)
    tilts = np.array([np.pi - chi, 1.9])
    rates = np.stack(
        [np.full(2, Omega), np.zeros(2), np.array([0.0, omega3]) - Omega * np.cos(tilts)], axis=-1
    )
    angles = np.stack([np.full(2, 0.7), tilts, [0.5, -0.4]], axis=-1) + t[:, None, None] * rates
    q, omega = euler_angles.zyz_attitude(angles), euler_angles.zyz_omega(angles, rates)
    found_q, found_omega = hanging_gyroscope_motion.motion(ROD, WHEEL, G, q[0], omega[0], t)
    turn = quaternions.rotation_vector(quaternions.product(quaternions.conjugate(q), found_q))
    # A hundred times the tolerance of 1e-12 a second is what it promises.
    assert np.abs(turn).max() < 1e-10
    assert np.abs(found_omega - omega).max() < 1e-10 * omega3


@pytest.mark.parametrize("t", [[0.2, 0.1], [-0.1, 0.2]])
def test_times_of_the_integrated_motion_ascend_from_0(t):
    q = np.tile([0.0, 0.0, 0.0, 1.0], (2, 1))
    with pytest.raises(InputError, match="ascending"):
        hanging_gyroscope_motion.motion(ROD, WHEEL, G, q, np.zeros((2, 3)), t)
