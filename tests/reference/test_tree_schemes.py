"""Schemes on trees, against what is known of them in closed form and against their order."""

import numpy as np
import pytest
from poinsot.reference import equations_of_motion, schemes, top_schemes, tree_schemes
from poinsot.reference.errors import InputError
from poinsot.reference.multibody_tree import Joint, Link

TOP = [Link(1.0, np.diag([0.02, 0.03, 0.04]), com=(0, 0, 0.1), joints=(Joint("ball"),))]
FREE = [Link(1.0, np.diag([0.01, 0.01, 0.02]), joints=(Joint("free"),))]
CHAIN = [
    Link(1.0, np.zeros((3, 3)), joints=(Joint("slide", (1, 0, 0), stiffness=30.0, damping=0.2),)),
    Link(2.0, np.zeros((3, 3)), parent=0, joints=(Joint("slide", (1, 0, 0), stiffness=20.0),)),
]


def accelerate(links, gravity=(0.0, 0.0, 0.0)):
    return lambda q, v: equations_of_motion.accelerations(links, q, v, gravity)


def linearised(links):
    def found(q, v):
        columns = [
            equations_of_motion.bias(links, q, v + d) - equations_of_motion.bias(links, q, v - d)
            for d in np.eye(v.shape[-1]) / 2
        ]
        return equations_of_motion.mass_matrix(links, q), np.stack(columns, axis=-1)

    return found


def relative(q):
    """The chain's coordinates from those of its masses in the room."""
    return np.array([q[0], q[1] - q[0]])


@pytest.mark.parametrize(
    ("name", "known"),
    [("semi-implicit Euler", "semi_implicit_euler"), ("RKMK4", "rk4"), ("explicit Euler", "explicit_euler")],
)
def test_on_springs_each_scheme_lands_where_its_linear_map_does(name, known):
    T, V = np.diag([1.0, 2.0]), np.array([[50.0, -20.0], [-20.0, 20.0]])
    q0, v0 = np.array([0.1, -0.2]), np.array([0.3, 0.4])
    q, v = schemes.linear_motion(known, T, V, q0, v0, 1e-2, [7], damping=np.diag([0.2, 0.0]))
    found = tree_schemes.advanced(name, CHAIN, accelerate(CHAIN), relative(q0), relative(v0), 1e-2, 7)
    np.testing.assert_allclose(found, (relative(q[0]), relative(v[0])), atol=1e-14)


@pytest.mark.parametrize(
    ("name", "known"),
    [("semi-implicit Euler", "explicit"), ("implicit gyroscopic", "implicit"), ("RKMK4", "rk4")],
)
def test_on_a_free_symmetric_top_rates_are_those_in_closed_form(name, known):
    omega = np.array([1.0, 0.0, 5.0])
    q, v = np.array([0, 0, 0, 0, 0, 0, 1.0]), np.concatenate([np.zeros(3), omega])
    _, v = tree_schemes.advanced(name, FREE, accelerate(FREE), q, v, 1e-2, 9, linearised(FREE))
    exact = top_schemes.body_rates(known, 0.01, 0.02, omega, 1e-2, [9])[0]
    np.testing.assert_allclose(v[3:], exact, atol=5e-15)


@pytest.mark.parametrize(
    ("name", "order"),
    [("semi-implicit Euler", 1), ("explicit Euler", 1), ("RK4 of body velocities", 2), ("RKMK4", 4)],
)
def test_attitude_converges_with_the_schemes_order(name, order):
    q, v = np.array([0.1, -0.2, 0.3, 0.9]), np.array([3.0, 2.0, 5.0])
    q, weight = q / np.linalg.norm(q), (0.0, 0.0, -9.81)

    def attitude(steps):
        return tree_schemes.advanced(name, TOP, accelerate(TOP, weight), q, v, 0.4 / steps, steps)[0]

    coarse, middle, fine = attitude(20), attitude(40), attitude(80)
    apart = [np.linalg.norm(tree_schemes.apart(TOP, a, b)) for a, b in ((coarse, middle), (middle, fine))]
    assert np.log2(apart[0] / apart[1]) == pytest.approx(order, abs=0.15)


def test_a_stack_of_states_moves_as_each_of_them_alone():
    chance = np.random.default_rng(1)
    q, v = chance.normal(size=(5, 4)), chance.normal(size=(5, 3))
    q /= np.linalg.norm(q, axis=1, keepdims=True)
    together = tree_schemes.advanced("RKMK4", TOP, accelerate(TOP), q, v, 1e-2, 3)
    alone = tree_schemes.advanced("RKMK4", TOP, accelerate(TOP), q[3], v[3], 1e-2, 3)
    np.testing.assert_allclose(together[0][3], alone[0], atol=1e-15)
    np.testing.assert_allclose(together[1][3], alone[1], atol=1e-14)


def test_moving_and_looking_how_far_apart_undo_each_other():
    chance = np.random.default_rng(2)
    links = [*FREE, Link(1.0, np.eye(3), joints=(Joint("hinge"), Joint("slide")))]
    q, change = chance.normal(size=9), chance.normal(size=8)
    q[3:7] /= np.linalg.norm(q[3:7])
    np.testing.assert_allclose(
        tree_schemes.apart(links, tree_schemes.moved(links, q, change), q), change, atol=1e-14
    )


def test_a_scheme_that_is_not_known_is_refused_by_name():
    with pytest.raises(InputError, match="got 'leapfrog', expected one of semi-implicit Euler"):
        tree_schemes.advanced("leapfrog", FREE, accelerate(FREE), np.zeros(7), np.zeros(6), 1e-2, 1)
