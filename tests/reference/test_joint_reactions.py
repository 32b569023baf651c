"""Reactions of joints in closed form: a pendulum's pivot, a chain that hangs, a rotor's axle."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from poinsot.reference import compound_pendulum, inertia, quaternions, rotor_balance
from poinsot.reference.errors import InputError
from poinsot.reference.joint_reactions import reactions
from poinsot.reference.multibody_tree import Joint, Link

TENSOR = np.array([[0.04, 0.006, -0.004], [0.006, 0.03, 0.003], [-0.004, 0.003, 0.02]])
MASS, G = 1.3, 9.81
DOWN = (0.0, 0.0, -G)


@given(st.floats(-3, 3), st.floats(-9, 9))
def test_the_pivot_of_a_compound_pendulum(angle, rate):
    # A hinge along −y, so that a positive angle takes the centre from below it towards +x.
    arm, axis = 0.25, (0.0, -1.0, 0.0)
    link = Link(MASS, TENSOR, com=(0.0, 0.0, -arm), joints=(Joint("hinge", axis),))
    about = inertia.about_axis(TENSOR, axis) + MASS * arm**2
    x, z = compound_pendulum.pivot_reaction(MASS, arm, about, G, angle, rate)
    [told] = reactions([link], [angle], [rate], DOWN, [0])
    turn = quaternions.from_rotation_vector(angle * np.array(axis))
    assert quaternions.rotated(turn, told[:3]) == pytest.approx([x, 0.0, z], abs=1e-12)
    # The hinge turns freely.
    assert told[3:] @ axis == pytest.approx(0.0, abs=1e-12)


@given(st.floats(-40, 40), st.floats(0.0, 0.5))
def test_the_axle_of_a_braked_rotor(spin, brake):
    center = np.array([0.05, -0.03, 0.1])
    link = Link(MASS, TENSOR, com=center, joints=(Joint("hinge", (0, 0, 1), damping=brake),))
    about = inertia.about_point(TENSOR, MASS, center)
    alpha = -brake * spin / about[2, 2]
    [told] = reactions([link], [0.7], [spin], (0, 0, 0), [0])
    size = 1e-13 * (1 + spin**2)
    assert told[:3] == pytest.approx(rotor_balance.axle_force(MASS, center, spin, alpha), abs=size)
    assert told[3:] == pytest.approx(rotor_balance.bearing_torque(about, spin, alpha), abs=size)


def test_each_link_of_a_hanging_chain_bears_what_hangs_on_it():
    masses, length = (0.5, 1.0, 2.0), 0.4
    places = [(0.0, 0.0, -length * (k > 0)) for k in range(3)]
    chain = [
        Link(mass, 0.01 * np.eye(3), (0.0, 0.0, -length / 2), k - 1, (Joint("ball"),), places[k])
        for k, mass in enumerate(masses)
    ]
    told = reactions(chain, [0.0, 0.0, 0.0, 1.0] * 3, [0.0] * 9, DOWN, [2, 0, 1])
    below = np.array([2.0, 3.5, 3.0])
    expected = np.zeros((3, 6))
    expected[:, 2] = below * G
    assert told == pytest.approx(expected, abs=1e-12)


def test_a_branch_bears_nothing_of_the_others():
    trunk = Link(3.0, TENSOR, joints=(Joint("ball"),))
    one, other = (Link(m, TENSOR, parent=0, position=(x, 0, 0)) for m, x in ((1.0, 1.0), (2.0, -0.5)))
    told = reactions([trunk, one, other], [0.0, 0.0, 0.0, 1.0], [0.0] * 3, DOWN, [0, 1, 2])
    assert told[:, :3] == pytest.approx(np.outer([6.0, 1.0, 2.0], [0.0, 0.0, G]), abs=1e-12)


def test_a_spring_is_part_of_what_its_joint_does():
    slide = Link(MASS, TENSOR, joints=(Joint("slide", (0, 0, 1), stiffness=7.0),))
    [told] = reactions([slide], [0.3], [0.0], DOWN, [0])
    assert told == pytest.approx([0, 0, -7.0 * 0.3, 0, 0, 0], abs=1e-13)


def test_many_states_at_once_are_each_by_itself():
    links = [
        Link(MASS, TENSOR, (0.1, 0.2, 0.3), joints=(Joint("hinge", (0.6, 0.0, 0.8)),)),
        Link(0.5, TENSOR, (0.0, 0.1, 0.0), 0, (Joint("hinge", (0, 1, 0)),), (0.3, 0.0, 0.1)),
    ]
    chance = np.random.default_rng(5)
    q, v = chance.normal(size=(2, 4, 3, 2))
    together = reactions(links, q, v, DOWN, [1, 0])
    assert together.shape == (4, 3, 2, 6)
    for at in np.ndindex(4, 3):
        assert together[at] == pytest.approx(reactions(links, q[at], v[at], DOWN, [1, 0]), rel=1e-13)


def test_bad_input_is_refused():
    link = Link(MASS, TENSOR, joints=(Joint("hinge", (0, 0, 1)),))
    for state in (([0.0, 1.0], [0.0]), ([np.nan], [0.0])):
        with pytest.raises(InputError):
            reactions([link], *state, DOWN, [0])
    with pytest.raises(InputError, match="gravity"):
        reactions([link], [0.0], [0.0], (0.0, 1.0), [0])
