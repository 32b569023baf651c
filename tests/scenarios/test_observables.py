"""What is looked at in a motion: the right distance, blind to what does not matter, in the right unit."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from poinsot.reference.errors import InputError
from poinsot.scenarios import observables
from poinsot.scenarios.body import Body, Joint, diagonal
from poinsot.scenarios.scene import Scene
from poinsot.scenarios.trajectory import Trajectory, about_fixed_point
from scipy.spatial.transform import Rotation

N, B = 50, 2
NAMES = ("position", "velocity", "omega")


def scene():
    bodies = tuple(
        Body(name, mass, diagonal(0.3, 0.3, 0.5), (Joint(name, "free"),))
        for name, mass in (("a", 1.0), ("b", 2.0))
    )
    q0 = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0) * 2
    return Scene("s", "", "", bodies, q0, (0.0,) * 12, 1.0, N - 1, None, (), gravity=(0.0, 0.0, -9.0))


@pytest.fixture
def motion():
    rng = np.random.default_rng(3)
    position, velocity, omega = rng.normal(size=(3, N, B, 3))
    quaternion = Rotation.random(N * B, rng=5).as_quat().reshape(N, B, 4)
    none = np.empty((N, 0))
    return Trajectory(np.linspace(0, 1, N), position, quaternion, velocity, omega, none, none)


def turned(motion, body, vector):
    """The motion with one body's attitude turned by a rotation vector in body axes, at every sample."""
    quaternion = motion.quaternion.copy()
    quaternion[:, body] = (Rotation.from_quat(quaternion[:, body]) * Rotation.from_rotvec(vector)).as_quat()
    return replace(motion, quaternion=quaternion)


@pytest.mark.parametrize("angle", [1e-14, 1e-6, 1.0, 3.1])
def test_orientation_is_the_geodesic_angle(motion, angle):
    vector = angle * np.array([0.6, 0.0, 0.8])
    found = observables.orientation().distance(scene(), turned(motion, 1, vector), motion)
    # Quaternions are good to a rounding or two of 1, whatever the angle.
    assert found == pytest.approx(np.full(N, angle), abs=2e-15)
    signed = observables.orientation().difference(scene(), turned(motion, 1, vector), motion)
    assert signed == pytest.approx(np.tile([0, 0, 0, *vector], (N, 1)), abs=2e-15)


def test_orientation_is_blind_to_the_sign_of_a_quaternion(motion):
    flipped = replace(motion, quaternion=-motion.quaternion)
    assert observables.orientation().distance(scene(), flipped, motion).max() < 1e-15


def test_orientation_of_two_bodies_adds_in_squares(motion):
    both = turned(turned(motion, 0, [0.3, 0, 0]), 1, [0, 0.4, 0])
    assert observables.orientation().distance(scene(), both, motion) == pytest.approx(
        np.full(N, 0.5), abs=1e-14
    )


@pytest.mark.parametrize("name", NAMES)
def test_a_state_is_the_difference_of_its_array(motion, name):
    observable, shift = getattr(observables, name)(), np.array([[3.0, 0.0, 0.0], [0.0, 4.0, 0.0]])
    other = replace(motion, **{name: getattr(motion, name) + shift})
    assert observable.distance(scene(), other, motion) == pytest.approx(np.full(N, 5.0))
    assert observable.difference(scene(), other, motion)[0] == pytest.approx([3, 0, 0, 0, 4, 0])
    largest = max(np.linalg.norm(row) for row in getattr(motion, name).reshape(N, 6))
    assert observable.scale(scene(), motion) == pytest.approx(largest, rel=1e-15)


def circling(t, rate, dent=0.0):
    """A body whose ω goes round in its axes at a rate, on a circle dented by a part of it."""
    phase = rate * t
    omega = np.stack([np.cos(phase) + dent * np.cos(2 * phase), np.sin(phase), np.full_like(t, 5.0)], axis=1)
    return about_fixed_point(t, np.zeros(3), np.tile([0.0, 0.0, 0.0, 1.0], (len(t), 1)), omega)


ROUND = observables.rate(
    "round", lambda scene, m: m.omega[:, 0, 0] + 1j * m.omega[:, 0, 1], lambda scene: -7.0
)


@given(st.floats(-2.0, 2.0), st.floats(5.0, 400.0))
def test_a_rate_is_how_much_faster_a_phase_turns(more, rate):
    # Turns of many times what lies between two samples: only the difference must be followed.
    t = np.linspace(0.0, 3.0, 31)
    found = ROUND.difference(scene(), circling(t, rate + more), circling(t, rate))
    assert found == pytest.approx(np.array([[more]]), abs=1e-11)


def test_a_rate_does_not_need_a_round_signal():
    t = np.linspace(0.0, 20.0, 2001)
    found = ROUND.distance(scene(), circling(t, 5.01, dent=0.3), circling(t, 5.0, dent=0.3))
    # Where the circle is dented the phases differ by more or less: evened out over many turns.
    assert found == pytest.approx([0.01], rel=1e-2)


def test_a_rate_is_not_shifted_by_a_constant_phase():
    t = np.linspace(0.0, 3.0, 31)
    ahead = circling(t + 0.2, 6.0)
    assert ROUND.distance(scene(), replace(ahead, t=t), circling(t, 6.0)) == pytest.approx([0.0], abs=1e-13)


def test_a_rate_is_measured_against_its_size():
    assert (ROUND.scale(scene(), None), ROUND.unit, ROUND.kind) == (7.0, "rad/s", "rate")


def test_a_fitted_number_is_how_much_larger_it_is():
    mean = observables.fitted("mean", "m", lambda scene, m: m.omega[:, 0, 2].mean(), lambda scene: -5.0)
    t = np.linspace(0.0, 1.0, 11)
    less = replace(circling(t, 1.0), omega=circling(t, 1.0).omega * 0.8)
    assert mean.difference(scene(), less, circling(t, 1.0)) == pytest.approx(np.array([[-1.0]]))
    assert (mean.scale(scene(), None), mean.unit, mean.kind) == (5.0, "m", "rate")


INVARIANTS = (
    observables.energy, observables.angular_momentum, observables.vertical_angular_momentum,
    observables.axial_angular_momentum, observables.momentum, observables.unit_norm, observables.attitude,
    observables.turning,
)  # fmt: skip


@pytest.mark.parametrize("make", INVARIANTS)
def test_an_invariant_is_held_against_the_start_of_the_truth(motion, make):
    observable = make()
    first = replace(
        motion, **{n: np.repeat(getattr(motion, n)[:1], N, axis=0) for n in (*NAMES, "quaternion")}
    )
    assert observable.kind == "invariant"
    # Whatever the truth does later: the value it begins with is what counts.
    assert np.array_equal(
        observable.difference(scene(), motion, motion), observable.difference(scene(), motion, first)
    )
    assert observable.distance(scene(), first, motion).max() < 1e-13 * observable.scale(scene(), motion)


@pytest.mark.parametrize(
    ("make", "changed", "by"),
    [
        (observables.energy, {"velocity": 2.0}, "speed"),
        (observables.momentum, {"velocity": 2.0}, "speed"),
        (observables.angular_momentum, {"omega": 2.0}, "spin"),
        (observables.vertical_angular_momentum, {"position": 2.0}, "place"),
        (observables.axial_angular_momentum, {"omega": 2.0}, "spin"),
        (observables.unit_norm, {"quaternion": 1.001}, "length"),
        (observables.turning, {"omega": 2.0}, "spin"),
    ],
)  # fmt: skip
def test_an_invariant_sees_what_it_is_made_of(motion, make, changed, by):
    still = replace(
        motion, **{n: np.repeat(getattr(motion, n)[:1], N, axis=0) for n in (*NAMES, "quaternion")}
    )
    other = replace(still, **{name: getattr(still, name) * factor for name, factor in changed.items()})
    observable = make()
    assert observable.distance(scene(), other, still).min() > 1e-4 * observable.scale(scene(), still), by


def test_the_top_about_its_axis_by_hand(motion):
    omega = motion.omega.copy()
    omega[:, 0, 2], omega[4, 0, 2] = 4.0, 6.0
    found = observables.axial_angular_momentum().difference(scene(), replace(motion, omega=omega), motion)
    start = 0.5 * motion.omega[0, 0, 2]  # I3 of the first body is 0.5
    assert found[[0, 4], 0] == pytest.approx([2.0 - start, 3.0 - start])


def test_the_vertical_component_by_hand(motion):
    found = observables.vertical_angular_momentum().difference(scene(), motion, motion)
    whole = observables.angular_momentum().difference(scene(), motion, motion)
    assert np.array_equal(found[:, 0], whole[:, 2])


def test_the_norm_of_every_body_counts(motion):
    quaternion = motion.quaternion.copy()
    quaternion[7, 1] *= 1 + 1e-9
    found = observables.unit_norm().distance(scene(), replace(motion, quaternion=quaternion), motion)
    assert found.argmax() == 7
    assert found[7] == pytest.approx(1e-9, rel=1e-5)


def test_attitude_is_blind_to_the_sign_of_a_quaternion_and_sees_a_turn(motion):
    still = replace(motion, quaternion=np.tile(motion.quaternion[:1], (N, 1, 1)))
    assert (
        observables.attitude().distance(scene(), replace(still, quaternion=-still.quaternion), still).max()
        < 1e-15
    )
    # Three axes, two of which go round by the angle.
    found = observables.attitude().distance(scene(), turned(still, 0, [0.0, 0.0, 1e-6]), still)
    assert found == pytest.approx(np.full(N, np.sqrt(2) * 1e-6), rel=1e-6)


def test_a_trajectory_names_the_array_that_does_not_fit(motion):
    with pytest.raises(InputError, match=r"trajectory omega: got shape \(50, 1, 3\), expected \(50, 2, 3\)"):
        replace(motion, omega=motion.omega[:, :1])


@pytest.mark.parametrize("name", ["position", "quaternion", "velocity", "omega"])
@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_the_first_sample_that_is_not_finite_is_found(motion, name, value):
    array = getattr(motion, name).copy()
    array[[9, 20], 1, 0] = value
    assert replace(motion, **{name: array}).first_not_finite() == motion.t[9]
    assert motion.first_not_finite() is None


def test_a_body_about_a_fixed_point_moves_as_its_attitude_says():
    t = np.linspace(0, 1, 2001)
    omega = np.tile([0.3, -0.5, 2.0], (len(t), 1))
    quaternion = Rotation.from_rotvec(np.outer(t, omega[0])).as_quat()
    made = about_fixed_point(t, np.array([0.1, 0.2, 0.5]), quaternion, omega)
    slope = np.gradient(made.position[:, 0], t, axis=0)
    assert made.velocity[1:-1, 0] == pytest.approx(slope[1:-1], abs=1e-6)  # h²/6 of the third derivative
    assert np.linalg.norm(made.position[:, 0], axis=1) == pytest.approx(
        np.full(len(t), np.sqrt(0.3)), rel=1e-14
    )
