"""The equations of motion against textbook systems, against Lagrange, and by what a motion conserves."""

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from poinsot.reference import quaternions
from poinsot.reference.equations_of_motion import (
    Joint,
    Link,
    accelerations,
    bias,
    coordinate_rates,
    link_accelerations,
    link_motion,
    mass_matrix,
    required_forces,
    sizes,
)
from poinsot.reference.errors import InputError
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

# Sums of some tens of products of numbers of order 1 to 100, and one well-conditioned solve.
ROUNDING = 1e-12
G = np.array([0.0, 0.0, -9.81])


def some_inertia(rng, size=1.0):
    points = size * rng.normal(size=(6, 3))
    points -= points.mean(axis=0)
    return sum(np.dot(p, p) * np.eye(3) - np.outer(p, p) for p in points)


def some_turn(rng):
    return Rotation.random(random_state=rng).as_quat()


def some_tree(rng, springs=True):
    """A free base, a branch of hinge, slide and ball, and a branch of ball and hinge."""
    k = 1.0 if springs else 0.0

    def link(parent, *joints):
        place = {} if parent < 0 else {"position": rng.normal(size=3), "quaternion": some_turn(rng)}
        return Link(rng.uniform(0.3, 2), some_inertia(rng), rng.normal(size=3), parent, joints, **place)

    hinge = Joint("hinge", rng.normal(size=3), rng.normal(size=3), stiffness=2 * k, rest=0.3 * k)
    slide = Joint("slide", rng.normal(size=3), stiffness=3 * k, rest=-0.2 * k)
    return [
        link(-1, Joint("free")),
        link(0, hinge, slide),
        link(1, Joint("ball", position=rng.normal(size=3))),
        link(0, Joint("ball", position=rng.normal(size=3), stiffness=4 * k), Joint("hinge", (1, 2, 2))),
    ]


def some_state(rng, links, batch=()):
    nq, nv = sizes(links)
    q, v = rng.normal(size=(*batch, nq)), rng.normal(size=(*batch, nv))
    at = 0
    for joint in (joint for link in links for joint in link.joints):
        at += 3 if joint.kind == "free" else 0
        if joint.kind in ("free", "ball"):
            q[..., at : at + 4] /= np.linalg.norm(q[..., at : at + 4], axis=-1, keepdims=True)
            at += 4
        else:
            at += 1
    return q, v


def energy(links, q, v, gravity):
    """From the places and velocities of the bodies, not from the mass matrix."""
    com, _, velocity, omega = link_motion(links, q, v)
    total = 0.0
    for i, link in enumerate(links):
        total = total + 0.5 * link.mass * np.sum(velocity[..., i, :] ** 2, axis=-1)
        total = total + 0.5 * np.einsum("...a,ab,...b", omega[..., i, :], link.inertia, omega[..., i, :])
        total = total - link.mass * com[..., i, :] @ gravity
    at = 0
    for joint in (joint for link in links for joint in link.joints):
        if joint.kind == "ball":
            turned = Rotation.from_quat(q[..., at : at + 4]).magnitude()
            total = total + 0.5 * joint.stiffness * turned**2
        elif joint.kind != "free":
            total = total + 0.5 * joint.stiffness * (q[..., at] - joint.rest) ** 2
        at += {"free": 7, "ball": 4, "hinge": 1, "slide": 1}[joint.kind]
    return total


def integrated(links, q, v, seconds, **loads):
    nq = sizes(links)[0]

    def rates(t, y):
        return np.concatenate(
            [coordinate_rates(links, y[:nq], y[nq:]), accelerations(links, y[:nq], y[nq:], **loads)]
        )

    y = solve_ivp(rates, (0, seconds), np.concatenate([q, v]), method="DOP853", rtol=1e-11, atol=1e-11).y.T
    q = y[:, :nq].copy()
    return q, y[:, nq:]


# --- textbook systems ---------------------------------------------------------------------------------


def test_a_free_body_obeys_eulers_equations():
    rng = np.random.default_rng(1)
    body = [Link(2.0, some_inertia(rng), joints=(Joint("free"),))]
    q, v = some_state(rng, body)
    force, torque = rng.normal(size=(2, 3))
    got = accelerations(body, q, v, G, forces=force[None], torques=torque[None])
    tensor, omega = body[0].inertia, v[3:]
    in_body = Rotation.from_quat(q[3:]).inv().apply(torque)
    np.testing.assert_allclose(got[:3], G + force / 2, atol=ROUNDING)
    np.testing.assert_allclose(
        got[3:], np.linalg.solve(tensor, in_body - np.cross(omega, tensor @ omega)), atol=ROUNDING
    )


def test_eulers_equations_of_principal_axes_line_by_line():
    I1, I2, I3 = 1.0, 1.7, 2.3
    w1, w2, w3 = 0.3, -0.8, 1.1
    body = [Link(1.0, np.diag([I1, I2, I3]), joints=(Joint("ball"),))]
    got = accelerations(body, [0, 0, 0, 1], [w1, w2, w3])
    expected = [(I2 - I3) / I1 * w2 * w3, (I3 - I1) / I2 * w3 * w1, (I1 - I2) / I3 * w1 * w2]
    np.testing.assert_allclose(got, expected, rtol=1e-15)


def test_a_heavy_body_about_a_fixed_point():
    rng = np.random.default_rng(2)
    com, mass = rng.normal(size=3), 1.4
    body = [Link(mass, some_inertia(rng), com, joints=(Joint("ball"),))]
    q, v = some_state(rng, body)
    about_the_point = body[0].inertia + mass * (com @ com * np.eye(3) - np.outer(com, com))
    weight = np.cross(com, mass * Rotation.from_quat(q).inv().apply(G))
    expected = np.linalg.solve(about_the_point, weight - np.cross(v, about_the_point @ v))
    np.testing.assert_allclose(accelerations(body, q, v, G), expected, atol=ROUNDING)


def test_the_symmetric_heavy_top_in_euler_angles():
    # Lagrange's equations of L = ½I1(α̇²sin²β + β̇²) + ½I3(α̇cosβ + γ̇)² − Mgl cosβ (Goldstein, sect. 5.7).
    I1, I3, M, arm, g = 1.3, 0.6, 2.0, 0.4, 9.81
    at_com = np.diag([I1 - M * arm**2, I1 - M * arm**2, I3])
    hinges = (Joint("hinge"), Joint("hinge", (0, 1, 0)), Joint("hinge"))
    top = [Link(M, at_com, (0, 0, arm), joints=hinges)]
    beta, alpha_dot, beta_dot, gamma_dot = 0.7, 0.9, -0.4, 11.0
    got = accelerations(top, [0.3, beta, 2.0], [alpha_dot, beta_dot, gamma_dot], G)
    s, c = np.sin(beta), np.cos(beta)
    p_gamma = I3 * (alpha_dot * c + gamma_dot)
    beta_acc = (I1 * alpha_dot**2 * s * c - p_gamma * alpha_dot * s + M * g * arm * s) / I1
    alpha_acc = (p_gamma * beta_dot * s - 2 * I1 * alpha_dot * beta_dot * s * c) / (I1 * s**2)
    gamma_acc = -alpha_acc * c + alpha_dot * beta_dot * s
    np.testing.assert_allclose(got, [alpha_acc, beta_acc, gamma_acc], rtol=1e-13)


def test_a_gimbal_turns_its_body_as_the_euler_angles_say():
    hinges = (Joint("hinge"), Joint("hinge", (0, 1, 0)), Joint("hinge"))
    body = [Link(1.0, np.eye(3), joints=hinges)]
    a, b, c = 0.4, 0.0, -1.2  # b = 0 too: velocities have no singularity there
    da, db, dc = 0.7, -0.3, 1.9
    omega = link_motion(body, [a, b, c], [da, db, dc])[3][0]
    expected = [
        -da * np.sin(b) * np.cos(c) + db * np.sin(c),
        da * np.sin(b) * np.sin(c) + db * np.cos(c),
        da * np.cos(b) + dc,
    ]
    np.testing.assert_allclose(omega, expected, atol=1e-15)
    with pytest.raises(InputError, match="inertia"):
        accelerations(body, [a, b, c], [da, db, dc])


def double_pendulum(m1, m2, l1, l2):
    point = np.zeros((3, 3))
    y = Joint("hinge", (0, 1, 0))
    return [
        Link(m1, point, (0, 0, -l1), joints=(y,)),
        Link(m2, point, (0, 0, -l2), 0, (y,), position=(0, 0, -l1)),
    ]


def test_the_double_pendulum():
    # Taylor, sect. 11.4, eqs. of motion from (11.37) and (11.38) before small angles; here φ2 = θ1 + θ2.
    m1, m2, l1, l2, g = 1.1, 0.7, 0.9, 1.3, 9.81
    th1, th2, w1, w2 = 1.2, -0.5, 0.8, 1.7
    phi2, u2 = th1 + th2, w1 + w2
    d = th1 - phi2
    M = [[(m1 + m2) * l1, m2 * l2 * np.cos(d)], [l1 * np.cos(d), l2]]
    rest = [
        -m2 * l2 * u2**2 * np.sin(d) - (m1 + m2) * g * np.sin(th1),
        l1 * w1**2 * np.sin(d) - g * np.sin(phi2),
    ]
    acc1, acc_phi2 = np.linalg.solve(M, rest)
    got = accelerations(double_pendulum(m1, m2, l1, l2), [th1, th2], [w1, w2], G)
    np.testing.assert_allclose(got, [acc1, acc_phi2 - acc1], rtol=1e-13)


def test_a_spherical_pendulum():
    m, arm, g = 0.8, 1.7, 9.81
    bob = [Link(m, np.zeros((3, 3)), (0, 0, -arm), joints=(Joint("hinge"), Joint("hinge", (0, -1, 0))))]
    theta, phi_dot, theta_dot = 0.9, 1.3, -0.6
    got = accelerations(bob, [0.2, theta], [phi_dot, theta_dot], G)
    expected = [
        -2 * phi_dot * theta_dot / np.tan(theta),
        phi_dot**2 * np.sin(theta) * np.cos(theta) - g / arm * np.sin(theta),
    ]
    np.testing.assert_allclose(got, expected, rtol=1e-13)


def test_the_co2_chain_of_slides_and_springs():
    # Each atom slides on the one before, so that the two bonds are joint springs.
    m, M, k = 2.66, 1.99, 3.0
    x = (1, 0, 0)
    atoms = [
        Link(m, np.zeros((3, 3)), joints=(Joint("slide", x),)),
        Link(M, np.zeros((3, 3)), parent=0, joints=(Joint("slide", x, stiffness=k),), position=x),
        Link(m, np.zeros((3, 3)), parent=1, joints=(Joint("slide", x, stiffness=k),), position=x),
    ]
    eta = np.array([0.1, -0.3, 0.25])
    q = [eta[0], eta[1] - eta[0], eta[2] - eta[1]]
    got = np.cumsum(accelerations(atoms, q, [0, 0, 0], G))
    V = k * np.array([[1, -1, 0], [-1, 2, -1], [0, -1, 1]])
    np.testing.assert_allclose(got, -V @ eta / [m, M, m], rtol=1e-13)


def test_a_puck_on_a_driven_turntable_feels_coriolis_and_centrifugal_forces():
    Omega, m = 1.5, 0.2
    table = Link(3.0, np.diag([1.0, 1.0, 2.0]), joints=(Joint("hinge"),))
    slides = (Joint("slide", (1, 0, 0)), Joint("slide", (0, 1, 0)))
    puck = Link(m, np.zeros((3, 3)), parent=0, joints=slides)
    x, y, vx, vy = 0.3, -0.7, 0.9, 0.4
    got = accelerations([table, puck], [0.8, x, y], [Omega, vx, vy], G, driven={0: 0.0})
    expected = [0, 2 * Omega * vy + Omega**2 * x, -2 * Omega * vx + Omega**2 * y]
    np.testing.assert_allclose(got, expected, atol=1e-14)
    motor = required_forces([table, puck], [0.8, x, y], [Omega, vx, vy], got, G)
    # The motor makes up the puck's gain of angular momentum, d/dt m r²Ω + m(x v_y − y v_x).
    torque = 2 * m * Omega * (x * vx + y * vy) + m * (x * got[2] - y * got[1])
    np.testing.assert_allclose(motor, [torque, 0, 0], atol=1e-14)


def test_an_unbalanced_rotor_pulls_at_its_bearings():
    tensor = np.array([[2.0, 0.1, 0.3], [0.1, 2.5, -0.2], [0.3, -0.2, 1.9]])
    rotor = [Link(1.0, tensor, joints=(Joint("ball"),))]
    w = 7.0
    needed = required_forces(rotor, [0, 0, 0, 1], [0, 0, w], [0, 0, 0])
    np.testing.assert_allclose(needed, w**2 * np.array([-tensor[1, 2], tensor[0, 2], 0]), rtol=1e-14)


# --- Lagrange, in many digits ---------------------------------------------------------------------------


def lagrange_accelerations(links, q, v, gravity):
    """Hinges and slides only: q̈ from numerical derivatives of T and V, in 40 digits."""

    def turn(axis, angle):
        x, y, z = (mp.mpf(float(c)) for c in axis)
        K = mp.matrix([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        return mp.eye(3) + mp.sin(angle) * K + (1 - mp.cos(angle)) * K * K

    def vector(values):
        return mp.matrix([mp.mpf(float(c)) for c in values])

    def poses(coordinates):
        """(R, centre) of each link: each joint turns about its point or slides along its axis."""
        coordinates, frames, result = list(coordinates), [], []
        for link in links:
            R, o = (mp.eye(3), mp.matrix([0, 0, 0])) if link.parent < 0 else frames[link.parent]
            o = o + R * vector(link.position)
            R = R * mp.matrix(Rotation.from_quat(link.quaternion).as_matrix().tolist())
            for joint in link.joints:
                value = coordinates.pop(0)
                if joint.kind == "slide":
                    o = o + R * vector(joint.axis) * value
                else:
                    p = vector(joint.position)
                    R_after = R * turn(joint.axis, value)
                    o, R = o + R * p - R_after * p, R_after
            frames.append((R, o))
            result.append((R, o + R * vector(link.com)))
        return result

    def kinetic(coordinates, rates):
        step = mp.mpf(10) ** -14
        ahead = poses([c + step * r for c, r in zip(coordinates, rates, strict=True)])
        behind = poses([c - step * r for c, r in zip(coordinates, rates, strict=True)])
        total = mp.mpf(0)
        for link, (R1, c1), (R0, c0), (R, _) in zip(links, ahead, behind, poses(coordinates), strict=True):
            velocity = (c1 - c0) / (2 * step)
            spin = R.T * (R1 - R0) / (2 * step)
            w = mp.matrix([spin[2, 1], spin[0, 2], spin[1, 0]])
            total += link.mass * (velocity.T * velocity)[0] / 2
            total += (w.T * mp.matrix(link.inertia.tolist()) * w)[0] / 2
        return total

    def potential(coordinates):
        total = mp.mpf(0)
        for link, (_, centre) in zip(links, poses(coordinates), strict=True):
            total -= link.mass * (vector(gravity).T * centre)[0]
        joints = [joint for link in links for joint in link.joints]
        for joint, value in zip(joints, coordinates, strict=True):
            total += joint.stiffness * (value - joint.rest) ** 2 / 2
        return total

    n, h = len(q), mp.mpf(10) ** -7
    q, v = [mp.mpf(float(x)) for x in q], [mp.mpf(float(x)) for x in v]

    def moved(values, i, by):
        return [x + (by if j == i else 0) for j, x in enumerate(values)]

    def row(i, coordinates, rates):  # ∂T/∂q̇ᵢ, exact because T is quadratic in the rates
        return (kinetic(coordinates, moved(rates, i, 1)) - kinetic(coordinates, moved(rates, i, -1))) / 2

    unit = mp.eye(n)
    M = mp.matrix(n, n)
    rest = mp.matrix(n, 1)
    for i in range(n):
        for j in range(n):
            M[i, j] = row(i, q, list(unit[:, j]))
        along = [row(i, [c + s * h * r for c, r in zip(q, v, strict=True)], v) for s in (1, -1)]
        T = [kinetic(moved(q, i, s * h), v) for s in (1, -1)]
        V = [potential(moved(q, i, s * h)) for s in (1, -1)]
        rest[i] = ((T[0] - T[1]) - (V[0] - V[1]) - (along[0] - along[1])) / (2 * h)
    return np.array([float(x) for x in mp.lu_solve(M, rest)])


def test_a_random_tree_of_three_links_obeys_lagrange():
    rng = np.random.default_rng(11)

    def link(parent, *joints):
        place = {"position": rng.normal(size=3), "quaternion": some_turn(rng)}
        return Link(rng.uniform(0.3, 2), some_inertia(rng), rng.normal(size=3), parent, joints, **place)

    links = [
        link(-1, Joint("hinge", rng.normal(size=3), rng.normal(size=3), stiffness=2.0, rest=0.4)),
        link(0, Joint("slide", rng.normal(size=3), stiffness=1.5, rest=-0.3), Joint("hinge", (1, 2, 2))),
        link(0, Joint("hinge", rng.normal(size=3), rng.normal(size=3)), Joint("slide", (2, -1, 2))),
    ]
    q, v = some_state(rng, links)
    gravity = np.array([1.0, -2.0, -9.81])
    with mp.workdps(40):
        expected = lagrange_accelerations(links, q, v, gravity)
    # Differences of 1e-7 and 1e-14 in forty digits err by about 1e-13 of these accelerations of order 10.
    np.testing.assert_allclose(accelerations(links, q, v, gravity), expected, rtol=1e-11, atol=1e-11)


# --- what a motion conserves ------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", [1, 2])
def test_a_tree_with_springs_under_gravity_keeps_its_energy(seed):
    rng = np.random.default_rng(seed)
    links = some_tree(rng)
    q, v = some_state(rng, links)
    gravity = np.array([0.5, -0.3, -9.81])
    q, v = integrated(links, q, v, 0.5, gravity=gravity)
    E = energy(links, q, v, gravity)
    # The integrator's own tolerance, 1e-11, times some tens of joules.
    np.testing.assert_allclose(E, E[0], atol=2e-8 * 0.1)
    assert np.ptp(0.5 * np.einsum("ni,nij,nj->n", v, mass_matrix(links, q), v)) > 0.1


def test_a_free_tree_keeps_its_momentum_and_angular_momentum():
    rng = np.random.default_rng(3)
    links = some_tree(rng)
    q, v = integrated(links, *some_state(rng, links), 0.5)
    com, turn, velocity, omega = link_motion(links, q, v)
    mass = np.array([link.mass for link in links])
    P = np.einsum("n,tnc->tc", mass, velocity)
    spin = np.stack(
        [
            quaternions.rotated(turn[:, i], np.einsum("ab,tb->ta", link.inertia, omega[:, i]))
            for i, link in enumerate(links)
        ],
        axis=1,
    )
    L = np.sum(mass[:, None] * np.cross(com, velocity) + spin, axis=1)
    # Ten times the integrator's tolerance, for momenta of order ten.
    np.testing.assert_allclose(P, np.broadcast_to(P[0], P.shape), atol=1e-9)
    np.testing.assert_allclose(L, np.broadcast_to(L[0], L.shape), atol=1e-9)


def test_damping_takes_exactly_its_own_power():
    rng = np.random.default_rng(4)
    c = (0.3, 0.7)
    links = [
        Link(1.0, some_inertia(rng), rng.normal(size=3), joints=(Joint("ball", damping=c[0]),)),
        Link(1.0, some_inertia(rng), rng.normal(size=3), 0, (Joint("slide", (0, 1, 1), damping=c[1]),)),
    ]
    q, v = some_state(rng, links)
    undamped = [
        Link(li.mass, li.inertia, li.com, li.parent, (Joint(li.joints[0].kind, li.joints[0].axis),))
        for li in links
    ]
    power = v @ mass_matrix(links, q) @ (accelerations(links, q, v) - accelerations(undamped, q, v))
    np.testing.assert_allclose(power, -c[0] * v[:3] @ v[:3] - c[1] * v[3] ** 2, rtol=1e-12)


# --- the same motion described in two ways ------------------------------------------------------------------


def test_velocities_and_accelerations_are_derivatives_of_the_places():
    rng = np.random.default_rng(5)
    links = some_tree(rng)
    q, v = some_state(rng, links)
    a = rng.normal(size=v.shape)
    h = 1e-4

    def ahead(t):
        """Coordinates after t with velocity v + at: exact for constant a in scalars, to t³ in turns."""
        y, w = q.copy(), v + a * t
        steps = 4
        for n in range(steps):
            middle = v + a * t * (n + 0.5) / steps
            y = advanced(links, y, middle * t / steps)
        return link_motion(links, y, w)

    before, now, after = ahead(-h), link_motion(links, q, v), ahead(h)
    linear, angular = link_accelerations(links, q, v, a)
    # Central differences err by h²/6 times third derivatives of order 1000 at most.
    np.testing.assert_allclose((after[0] - before[0]) / (2 * h), now[2], atol=3e-6)
    np.testing.assert_allclose((after[2] - before[2]) / (2 * h), linear, atol=3e-6)
    np.testing.assert_allclose((after[3] - before[3]) / (2 * h), angular, atol=3e-6)
    spin = quaternions.product(quaternions.conjugate(now[1]), (after[1] - before[1]) / (2 * h))
    np.testing.assert_allclose(2 * spin[..., :3], now[3], atol=3e-6)


def advanced(links, q, step):
    """Coordinates moved by velocities times a time, turns by the exponential map."""
    q, at_q, at_v = q.copy(), 0, 0
    for joint in (joint for link in links for joint in link.joints):
        if joint.kind == "free":
            q[at_q : at_q + 3] += step[at_v : at_v + 3]
            at_q, at_v = at_q + 3, at_v + 3
        if joint.kind in ("free", "ball"):
            turn = quaternions.from_rotation_vector(step[at_v : at_v + 3])
            q[at_q : at_q + 4] = quaternions.product(q[at_q : at_q + 4], turn)
            at_q, at_v = at_q + 4, at_v + 3
        else:
            q[at_q] += step[at_v]
            at_q, at_v = at_q + 1, at_v + 1
    return q


def test_coordinate_rates_are_the_derivatives_of_the_coordinates():
    rng = np.random.default_rng(6)
    links = some_tree(rng)
    q, v = some_state(rng, links)
    h = 1e-5
    numeric = (advanced(links, q, h * v) - advanced(links, q, -h * v)) / (2 * h)
    np.testing.assert_allclose(coordinate_rates(links, q, v), numeric, atol=1e-9)


def test_a_ball_is_three_hinges_and_a_free_body_three_slides_and_a_ball():
    rng = np.random.default_rng(7)
    body = {"mass": 1.7, "inertia": some_inertia(rng), "com": rng.normal(size=3)}
    angles, rates = rng.uniform(0.3, 1.2, size=3), rng.normal(size=3)
    place, velocity = rng.normal(size=(2, 3))
    slides = tuple(Joint("slide", axis) for axis in np.eye(3))
    hinges = (Joint("hinge", (0, 0, 1)), Joint("hinge", (1, 0, 0)), Joint("hinge", (0, 0, 1)))
    in_hinges = [Link(**body, joints=slides + hinges)]
    in_ball = [Link(**body, joints=(*slides, Joint("ball")))]
    free = [Link(**body, joints=(Joint("free"),))]
    state = np.concatenate([place, angles]), np.concatenate([velocity, rates])
    _, turn, _, omega = link_motion(in_hinges, *state)
    turned = np.concatenate([place, turn[0]]), np.concatenate([velocity, omega[0]])
    expected = link_accelerations(in_hinges, *state, accelerations(in_hinges, *state, G))
    for links in (in_ball, free):
        a = accelerations(links, *turned, G)
        np.testing.assert_allclose(link_accelerations(links, *turned, a), expected, atol=ROUNDING)


def test_one_link_or_two_welded_ones_or_a_turned_frame_are_the_same_body():
    rng = np.random.default_rng(8)
    m1, m2 = 0.8, 1.9
    I1, I2 = some_inertia(rng), some_inertia(rng)
    c1, c2, place = rng.normal(size=(3, 3))
    turn = some_turn(rng)
    R = Rotation.from_quat(turn).as_matrix()
    joint = (Joint("ball", position=rng.normal(size=3)),)
    welded = [Link(m1, I1, c1, joints=joint), Link(m2, I2, c2, 0, (), place, turn)]
    second = place + R @ c2
    com = (m1 * c1 + m2 * second) / (m1 + m2)
    tensor = I1 + R @ I2 @ R.T
    for m, c in ((m1, c1 - com), (m2, second - com)):
        tensor = tensor + m * (c @ c * np.eye(3) - np.outer(c, c))
    one = [Link(m1 + m2, (tensor + tensor.T) / 2, com, joints=joint)]
    q, v = some_state(rng, one)
    np.testing.assert_allclose(accelerations(welded, q, v, G), accelerations(one, q, v, G), atol=ROUNDING)


def test_a_turned_world_sees_the_same_accelerations():
    rng = np.random.default_rng(9)
    links = some_tree(rng)
    q, v = some_state(rng, links)
    turn = some_turn(rng)
    q2, v2 = q.copy(), v.copy()
    q2[:3], v2[:3] = quaternions.rotated(turn, q[:3]), quaternions.rotated(turn, v[:3])
    q2[3:7] = quaternions.product(turn, q[3:7])
    expected = accelerations(links, q, v, G)
    expected[:3] = quaternions.rotated(turn, expected[:3])
    got = accelerations(links, q2, v2, quaternions.rotated(turn, G))
    np.testing.assert_allclose(got, expected, atol=10 * ROUNDING)


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 10**6))
def test_required_forces_undo_accelerations(seed):
    rng = np.random.default_rng(seed)
    links = some_tree(rng)
    q, v = some_state(rng, links)
    push, force, torque = rng.normal(size=sizes(links)[1]), *rng.normal(size=(2, len(links), 3))
    a = accelerations(links, q, v, G, push, force, torque)
    np.testing.assert_allclose(required_forces(links, q, v, a, G, push, force, torque), 0, atol=1e-10)
    np.testing.assert_allclose(required_forces(links, q, v, a, G, None, force, torque), push, atol=1e-10)
    M = mass_matrix(links, q)
    np.testing.assert_allclose(M, np.swapaxes(M, -1, -2), atol=ROUNDING)
    assert np.linalg.eigvalsh(M).min() > 0
    np.testing.assert_allclose(bias(links, q, 2 * v), 4 * bias(links, q, v), rtol=1e-10, atol=1e-10)


def test_many_states_at_once_are_each_state_alone():
    rng = np.random.default_rng(10)
    links = some_tree(rng)
    q, v = some_state(rng, links, (2, 3))
    got = accelerations(links, q, v, G)
    assert got.shape == v.shape
    for index in np.ndindex(2, 3):
        np.testing.assert_allclose(got[index], accelerations(links, q[index], v[index], G), atol=ROUNDING)


def test_a_quaternion_of_another_length_means_the_same_turn():
    rng = np.random.default_rng(12)
    links = some_tree(rng)
    q, v = some_state(rng, links)
    longer = q.copy()
    longer[3:7] *= 1.5
    np.testing.assert_allclose(
        accelerations(links, longer, v, G), accelerations(links, q, v, G), atol=ROUNDING
    )


# --- bad input ----------------------------------------------------------------------------------------------


def test_what_is_no_body_joint_or_tree_is_refused():
    good = np.eye(3)
    for bad in (np.diag([1, 1, 2.1]), np.diag([1, 1, -0.1]), [[1, 0.1, 0], [0, 1, 0], [0, 0, 1]], np.ones(3)):
        with pytest.raises(InputError, match="inertia"):
            Link(1.0, bad)
    for rod_or_point in (np.diag([0, 1, 1]), np.zeros((3, 3))):
        Link(1.0, rod_or_point)
    for bad in (
        {"mass": -1.0},
        {"mass": np.nan},
        {"com": (0, 0)},
        {"quaternion": (0, 0, 0, 1.1)},
        {"position": (0, 0, np.inf)},
    ):
        with pytest.raises(InputError):
            Link(**({"mass": 1.0, "inertia": good} | bad))
    for bad in (
        ("screw",),
        ("hinge", (0, 0, 0)),
        ("hinge", (0, 0, 1), (0, 0)),
        ("slide", (0, 0, 1), (0, 0, 0), -1.0),
        ("slide", (0, 0, 1), (0, 0, 0), 1.0, -1.0),
        ("free", (0, 0, 1), (0, 0, 0), 1.0),
        ("ball", (0, 0, 1), (0, 0, 0), 1.0, 0.0, 0.1),
    ):
        with pytest.raises(InputError):
            Joint(*bad)
    hinge, free = Joint("hinge"), Joint("free")
    for bad in (
        [Link(1.0, good, parent=0)],
        [Link(1.0, good, parent=-2)],
        [Link(1.0, good, joints=(free, hinge))],
        [Link(1.0, good), Link(1.0, good, parent=0, joints=(free,))],
        [Link(1.0, good, joints=(free,), position=(1, 0, 0))],
    ):
        with pytest.raises(InputError):
            sizes(bad)


def test_a_state_or_load_that_does_not_fit_is_refused():
    links = [Link(1.0, np.eye(3), joints=(Joint("ball"),))]
    q, v = np.array([0, 0, 0, 1.0]), np.zeros(3)
    for bad_q, bad_v in ((q[:3], v), (q, v[:2]), (np.nan * q, v), (0.1 * q, v), (np.stack([q, q]), v)):
        with pytest.raises(InputError):
            accelerations(links, bad_q, bad_v)
    for loads in (
        {"gravity": (0, 0)},
        {"joint_forces": np.zeros(4)},
        {"forces": np.zeros((2, 3))},
        {"torques": np.full((1, 3), np.inf)},
        {"driven": {3: 0.0}},
        {"driven": {0: np.nan}},
    ):
        with pytest.raises(InputError):
            accelerations(links, q, v, **loads)
    massless = [Link(0.0, np.zeros((3, 3)), joints=(Joint("hinge"),))]
    with pytest.raises(InputError, match="inertia"):
        accelerations(massless, [0.0], [0.0])


def test_an_axis_of_any_length_is_a_direction():
    for scale in (1e-200, 1.0, 1e200):
        np.testing.assert_allclose(Joint("hinge", (0, 3 * scale, 4 * scale)).axis, [0, 0.6, 0.8], rtol=1e-15)
