"""The body on a hinge against the plane pendulum, Newton's law for its points, and Huygens."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from poinsot.reference import compound_pendulum as compound
from poinsot.reference import plane_pendulum as plane
from poinsot.reference.errors import InputError

# A bar of 1.2 m hung 0.2 m from its end: l = 0.4, k² = 1.2²/12 = 0.12.
M, ARM, G = 3.0, 0.4, 9.81
INERTIA = M * (0.12 + ARM**2)


def test_bar_by_hand():
    assert compound.equivalent_length(M, ARM, INERTIA) == pytest.approx(0.28 / 0.4, rel=1e-15, abs=0)
    assert compound.beyond_centre(M, ARM, INERTIA) == pytest.approx(0.12 / 0.4, rel=1e-15, abs=0)
    small = 2 * np.pi * np.sqrt(0.7 / G)
    assert compound.period(M, ARM, INERTIA, G, 0.0) == pytest.approx(small, rel=1e-15, abs=0)


def test_bar_about_its_end_is_struck_at_two_thirds():
    assert compound.equivalent_length(2.0, 0.5, 2.0 / 3) == pytest.approx(2 / 3, rel=1e-15, abs=0)


@pytest.mark.parametrize(("theta0", "rate0"), [(0.1, 0.0), (2.0, -1.0), (0.3, 20.0), (3.1, 0.4)])
def test_motion_is_that_of_a_plane_pendulum_of_the_equivalent_length(theta0, rate0):
    t = np.linspace(-4, 4, 9)
    # Powers of two, so that the equivalent length 0.625 is exact.
    theta, rate = compound.motion(2.0, 0.5, 0.625, G, theta0, rate0, t)
    expected, expected_rate = plane.motion(G, 0.625, theta0, rate0, t)
    np.testing.assert_array_equal(theta, expected)
    np.testing.assert_array_equal(rate, expected_rate)
    # Of the period too, at that amplitude.
    assert compound.period(2.0, 0.5, 0.625, G, 2.0) == plane.period(G, 0.625, 2.0)


def test_point_mass_is_a_plane_pendulum():
    mass, arm = 0.3, 0.7
    assert compound.beyond_centre(mass, arm, mass * arm**2) == 0
    assert compound.period(mass, arm, mass * arm**2, G, 1.0) == pytest.approx(
        plane.period(G, arm, 1.0), rel=1e-15, abs=0
    )


@given(st.floats(0.05, 3), st.floats(0.01, 2), st.floats(0, 3))
def test_reversible_points_have_one_period(arm, gyration, amplitude):
    mass = 1.7
    inertia = mass * (arm**2 + gyration**2)
    other = compound.beyond_centre(mass, arm, inertia)
    there = mass * (other**2 + gyration**2)
    # k² comes back from I − ml², a difference that may lose the digits of (arm/gyration)².
    slack = 1e-14 * (1 + arm**2 / gyration**2)
    assert other * arm == pytest.approx(gyration**2, rel=slack, abs=0)
    assert compound.period(mass, other, there, G, amplitude) == pytest.approx(
        compound.period(mass, arm, inertia, G, amplitude), rel=slack, abs=0
    )
    # So it does on the way back, of (other/gyration)².
    back = 1e-14 * (1 + other**2 / gyration**2)
    assert compound.beyond_centre(mass, other, there) == pytest.approx(arm, rel=10 * (slack + back), abs=0)


@given(st.floats(-4, 4), st.floats(-5, 5))
def test_reaction_is_mass_times_acceleration_less_weight(theta0, rate0):
    # The centre's acceleration by differences of its exact path.
    h = 1e-3
    theta, rate = compound.motion(M, ARM, INERTIA, G, theta0, rate0, h * np.arange(-2, 3))
    path = ARM * np.column_stack([np.sin(theta), -np.cos(theta)])
    acceleration = (-path[4] + 16 * path[3] - 30 * path[2] + 16 * path[1] - path[0]) / (12 * h**2)
    expected = M * acceleration + [0, M * G]
    got = compound.pivot_reaction(M, ARM, INERTIA, G, theta[2], rate[2])
    # h⁴/90 of a sixth derivative that reaches ω⁶ ~ 1e5, and rounding over h².
    np.testing.assert_allclose(got, expected, rtol=0, atol=1e-6)


def test_reaction_by_hand():
    # At rest below: the weight. Passing below: more by mlω². Let go level: mg(1 − ml²/I) up, none across.
    got = compound.pivot_reaction(M, ARM, INERTIA, G, [0.0, 0.0, np.pi / 2], [0.0, 2.0, 0.0])
    level = M * G * (1 - M * ARM**2 / INERTIA)
    expected = [[0, M * G], [0, M * G + M * ARM * 4], [0, level]]
    np.testing.assert_allclose(got, expected, rtol=1e-15, atol=1e-14)
    # On its head at rest it stands on the hinge; turning fast there, it pulls up on it.
    up = compound.pivot_reaction(M, ARM, INERTIA, G, np.pi, 9.0)
    np.testing.assert_allclose(up, [0, M * G - M * ARM * 81], rtol=1e-14, atol=1e-13)


def test_reaction_moves_the_body_as_its_torque_about_the_centre_says():
    theta, rate = 0.7, 1.3
    force = compound.pivot_reaction(M, ARM, INERTIA, G, theta, rate)
    lever = -ARM * np.array([np.sin(theta), -np.cos(theta)])
    torque = lever[0] * force[1] - lever[1] * force[0]
    about_centre = INERTIA - M * ARM**2
    expected = about_centre * compound.acceleration(M, ARM, INERTIA, G, theta)
    assert torque == pytest.approx(expected, rel=1e-13, abs=0)


def test_acceleration_by_hand():
    got = compound.acceleration(2.0, 0.5, 0.625, 10.0, [0.0, np.pi / 2, -np.pi / 6])
    np.testing.assert_allclose(got, [0, -16, 8], rtol=1e-15)


@given(st.floats(0.01, 3), st.floats(-5, 5))
def test_blow_changes_momentum_and_angular_momentum(distance, impulse):
    rate, hinge = compound.struck(M, ARM, INERTIA, distance, impulse)
    assert M * ARM * rate == pytest.approx(impulse + hinge, abs=1e-13)
    # About the centre of mass: the blow's lever is b − l below it, the hinge's l above.
    spin = (INERTIA - M * ARM**2) * rate
    assert spin == pytest.approx(impulse * (distance - ARM) - hinge * ARM, abs=1e-12)


def test_hinge_feels_nothing_at_the_centre_of_percussion():
    at = compound.equivalent_length(M, ARM, INERTIA)
    assert at == pytest.approx(ARM + compound.beyond_centre(M, ARM, INERTIA), rel=1e-15, abs=0)
    rate, hinge = compound.struck(M, ARM, INERTIA, at, 2.0)
    assert hinge == pytest.approx(0, abs=1e-15)
    assert rate == pytest.approx(2 / (M * ARM), rel=1e-15, abs=0)
    # Struck above it the hinge holds back, below it the hinge pushes along.
    assert compound.struck(M, ARM, INERTIA, 0.5 * at, 2.0)[1] == pytest.approx(-1, rel=1e-14, abs=0)
    assert compound.struck(M, ARM, INERTIA, 2 * at, 2.0)[1] == pytest.approx(2, rel=1e-14, abs=0)


GOOD = {"mass": 1.0, "arm": 1.0, "inertia": 1.5}
CALLS = {
    compound.motion: {"gravity": 1.0, "theta0": 0.1, "rate0": 0.0, "t": [1.0]},
    compound.acceleration: {"gravity": 1.0, "theta": 0.1},
    compound.period: {"gravity": 1.0, "amplitude": 0.1},
    compound.equivalent_length: {},
    compound.beyond_centre: {},
    compound.pivot_reaction: {"gravity": 1.0, "theta": 0.1, "rate": 0.0},
    compound.struck: {"distance": 1.0, "impulse": 1.0},
}


@pytest.mark.parametrize("call", CALLS)
def test_bodies_that_cannot_be_are_refused(call):
    bad = [("mass", 0.0), ("arm", -1.0), ("inertia", 0.999), ("inertia", np.nan), ("inertia", -1.0)]
    bad += [(name, np.nan) for name in CALLS[call]]
    if "gravity" in CALLS[call]:
        bad.append(("gravity", 0.0))
    for name, value in bad:
        with pytest.raises(InputError):
            call(**(GOOD | CALLS[call] | {name: value}))
