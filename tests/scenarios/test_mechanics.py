"""Energy and momenta against numbers by hand, and against the mass matrix of Kane's equations."""

import numpy as np
import pytest
from poinsot.reference import equations_of_motion
from poinsot.scenarios import mechanics
from poinsot.scenarios.body import Body, Joint, diagonal
from poinsot.scenarios.scene import Scene
from poinsot.scenarios.trajectory import Trajectory

TENSOR = ((0.3, 0.02, -0.01), (0.02, 0.4, 0.03), (-0.01, 0.03, 0.5))


def scene(bodies, q0, v0, gravity=(0.0, 0.0, 0.0)):
    return Scene("s", "", "", tuple(bodies), tuple(q0), tuple(v0), 1.0, 1, None, (), gravity=gravity)


@pytest.fixture
def arm(links_of):
    """A free body carrying a sprung slide and a ball at a random state, and its motion (1 sample)."""
    rng = np.random.default_rng(7)
    bodies = [
        Body("base", 2.0, TENSOR, (Joint("free", "free"),), center_of_mass=(0.1, -0.2, 0.05)),
        Body("rod", 1.0, TENSOR, (Joint("slide", "slide", (0.6, 0.8, 0.0), stiffness=50.0),),
             center_of_mass=(0.0, 0.3, 0.1), parent="base", position=(0.5, 0.0, 0.2)),
        Body("bob", 3.0, TENSOR, (Joint("ball", "ball"),), center_of_mass=(0.2, 0.0, 0.0), parent="rod"),
    ]  # fmt: skip
    turns = [x / np.linalg.norm(x) for x in rng.normal(size=(2, 4))]
    q = np.concatenate([rng.normal(size=3), turns[0], [0.4], turns[1]])
    v = rng.normal(size=10)
    made = scene(bodies, q, v, gravity=(1.0, -2.0, -9.0))
    parts = equations_of_motion.link_motion(links_of(made), q, v)
    motion = Trajectory(np.zeros(1), *(part[None] for part in parts), q[None, 7:8], v[None, 6:7])
    return made, motion, q, v


def test_kinetic_energy_is_half_the_mass_matrix_between_velocities(arm, links_of):
    made, motion, q, v = arm
    M = equations_of_motion.mass_matrix(links_of(made), q)
    assert mechanics.kinetic_energy(made, motion) == pytest.approx([v @ M @ v / 2], rel=1e-14)


def test_energy_changes_by_the_work_of_its_forces(arm, links_of):
    # dE/dt = 0: v̇ from the equations of motion, E by its gradient along a short piece of the motion.
    made, _, q, v = arm
    links = links_of(made)
    a = equations_of_motion.accelerations(links, q, v, made.gravity)
    dq, h = equations_of_motion.coordinate_rates(links, q, v), 1e-5

    def energy(sign):
        at, speed = q + sign * h * dq, v + sign * h * a
        parts = equations_of_motion.link_motion(links, at, speed)
        motion = Trajectory(np.zeros(1), *(part[None] for part in parts), at[None, 7:8], speed[None, 6:7])
        return mechanics.energy(made, motion)[0], mechanics.kinetic_energy(made, motion)[0]

    (up, up_kinetic), (down, down_kinetic) = energy(1), energy(-1)
    assert abs(up - down) / (2 * h) < 1e-7 * abs(up_kinetic - down_kinetic) / (2 * h)


def test_potential_energy_is_by_height_and_by_spring(arm):
    made, motion, _, _ = arm
    weight = -sum(
        body.mass * np.dot(made.gravity, at) for body, at in zip(made.bodies, motion.position[0], strict=True)
    )
    assert mechanics.potential_energy(made, motion) == pytest.approx([weight + 50.0 * 0.4**2 / 2], rel=1e-15)


def test_momentum_is_that_of_the_whole_mass_at_its_centre(arm, links_of):
    # Of a system that only weight acts on, dp/dt is its weight and dL/dt the weight's torque.
    made, motion, q, v = arm
    links = links_of(made)
    a = equations_of_motion.accelerations(links, q, v, made.gravity)
    linear, _ = equations_of_motion.link_accelerations(links, q, v, a)
    m, g = mechanics.masses(made), np.array(made.gravity)
    assert m @ linear == pytest.approx(m.sum() * g, rel=1e-12)
    dq, h = equations_of_motion.coordinate_rates(links, q, v), 1e-6
    L = []
    for sign in (1, -1):
        parts = equations_of_motion.link_motion(links, q + sign * h * dq, v + sign * h * a)
        moved = Trajectory(np.zeros(1), *(part[None] for part in parts), q[None, 7:8], v[None, 6:7])
        L.append(mechanics.angular_momentum_world(made, moved)[0])
    torque = np.cross(m @ motion.position[0], g)
    assert (L[0] - L[1]) / (2 * h) == pytest.approx(torque, rel=1e-7, abs=1e-7)
    assert mechanics.momentum(made, motion)[0] == pytest.approx(m @ motion.velocity[0], rel=1e-15)


@pytest.fixture
def spinning():
    """One body at (1, 2, 3) m moving at (0, 1, 0) m/s, turned by 90° about x, spinning about its own z."""
    body = Body("b", 2.0, diagonal(1.0, 2.0, 2.5), (Joint("free", "free"),))
    turn = (np.sqrt(0.5), 0.0, 0.0, np.sqrt(0.5))
    made = scene([body], (1.0, 2.0, 3.0, *turn), (0.0, 1.0, 0.0, 0.0, 0.0, 4.0))
    none = np.empty((1, 0))
    arrays = (np.array(x, dtype=float)[None, None] for x in ((1, 2, 3), turn, (0, 1, 0), (0, 0, 4)))
    return made, Trajectory(np.zeros(1), *arrays, none, none)


def test_by_hand(spinning):
    made, motion = spinning
    assert mechanics.kinetic_energy(made, motion) == pytest.approx([0.5 * 2 * 1 + 0.5 * 2.5 * 16])
    assert mechanics.momentum(made, motion)[0] == pytest.approx([0, 2, 0])
    assert mechanics.spin_momentum_body(made, motion)[0, 0] == pytest.approx([0, 0, 10])
    # r × mv = (1, 2, 3) × (0, 2, 0) = (−6, 0, 2); the body's z points along −y of the world.
    assert mechanics.angular_momentum_world(made, motion)[0] == pytest.approx([-6, -10, 2])


def test_scales_add_what_may_cancel(spinning):
    made, motion = spinning
    assert mechanics.momentum_scale(made, motion) == pytest.approx(2.0)
    assert mechanics.angular_momentum_scale(made, motion) == pytest.approx(np.sqrt(40) + 10)
    two = Scene(
        "s", "", "", tuple(Body(n, 2.0, diagonal(1.0, 2.0, 2.5), (Joint(n, "free"),)) for n in "ab"),
        made.q0 * 2, made.v0 * 2, 1.0, 1, None, (),
    )  # fmt: skip
    back = {name: np.concatenate([getattr(motion, name)] * 2, axis=1) for name in ("position", "quaternion")}
    away = {
        name: np.concatenate([(x := getattr(motion, name)), -x], axis=1) for name in ("velocity", "omega")
    }
    opposed = Trajectory(
        np.zeros(1), **back, **away, joint_position=np.empty((1, 0)), joint_velocity=np.empty((1, 0))
    )
    assert mechanics.momentum(two, opposed)[0] == pytest.approx([0, 0, 0])
    assert mechanics.momentum_scale(two, opposed) == pytest.approx(4.0)


def test_scales_are_the_largest_over_time(spinning):
    made, motion = spinning
    grown = {name: np.concatenate([(x := getattr(motion, name)), 2 * x, x]) for name in ("velocity", "omega")}
    kept = {name: np.concatenate([getattr(motion, name)] * 3) for name in ("position", "quaternion")}
    none = np.empty((3, 0))
    longer = Trajectory(np.arange(3.0), **grown, **kept, joint_position=none, joint_velocity=none)
    assert mechanics.momentum_scale(made, longer) == pytest.approx(4.0)
    assert mechanics.angular_momentum_scale(made, longer) == pytest.approx(2 * (np.sqrt(40) + 10))
