"""The rotor: reactions against the change of momenta, balance, and engines that tell only those wrongly."""

from dataclasses import replace

import numpy as np
import pytest
from poinsot.adapters.engine import EngineError
from poinsot.adapters.simulate import UnsupportedError, simulate
from poinsot.reference import inertia, joint_reactions, quaternions
from poinsot.reference import rotor_balance as closed_form
from poinsot.scenarios import mechanics, rotor_balance
from poinsot.scenarios.registry import scenes

NAMES = ("braked", "balanced", "static", "dynamic")
BRAKED, BALANCED, STATIC, DYNAMIC = (scenes()[f"rotor_balance[{name}]"] for name in NAMES)
EVERY = pytest.mark.parametrize("scene", [BRAKED, BALANCED, STATIC, DYNAMIC], ids=NAMES)


def about_origin(scene):
    body = scene.bodies[0]
    return inertia.about_point(body.inertia_array, body.mass, body.center_of_mass)


def reaction(scene, t):
    return np.split(scene.truth(scene, t).reaction[:, 0], 2, axis=1)


@EVERY
def test_reactions_and_weight_are_what_momentum_and_angular_momentum_change_by(scene):
    t, h = scene.sample_times()[1:], 1e-5
    before, now, after = (scene.truth(scene, t + shift) for shift in (-h, 0.0, h))
    body, turn = scene.bodies[0], now.quaternion[:, 0]
    force, moment = (quaternions.rotated(turn, part) for part in np.split(now.reaction[:, 0], 2, axis=1))
    weight = body.mass * np.array(scene.gravity)
    changing = (mechanics.momentum(scene, after) - mechanics.momentum(scene, before)) / (2 * h)
    assert force + weight == pytest.approx(changing, abs=1e-6 * (1 + np.abs(changing).max()))
    spun = [mechanics.angular_momentum_world(scene, motion) for motion in (before, after)]
    about_world = moment + np.cross(body.position, force) + np.cross(now.position[:, 0], weight)
    turning = (spun[1] - spun[0]) / (2 * h)
    assert about_world == pytest.approx(turning, abs=1e-6 * (1 + np.abs(turning).max()))


@EVERY
def test_reactions_are_those_of_newtons_and_eulers_equations_of_any_tree(scene, links_of):
    motion = scene.truth(scene, scene.sample_times())
    state = motion.joint_position, motion.joint_velocity
    expected = joint_reactions.reactions(links_of(scene), *state, scene.gravity, [0])
    assert motion.reaction == pytest.approx(expected, abs=1e-12)


def test_what_balances_the_rotor_is_the_closed_forms_correction():
    weights = rotor_balance.ANYHOW
    masses = [rotor_balance.MASS, *(mass for mass, _ in weights)]
    places = [(0.0, 0.0, rotor_balance.HEIGHT), *(place for _, place in weights)]
    tensor = np.array(rotor_balance.INERTIA) + inertia.of_points(masses, places)
    (m1, (x1, y1, z1)), (m2, (x2, y2, z2)) = rotor_balance.BALANCING
    expected = closed_form.correction(tensor, sum(masses), inertia.centre_of(masses, places), (z1, z2))
    assert np.array([[m1 * x1, m1 * y1], [m2 * x2, m2 * y2]]) == pytest.approx(expected, abs=1e-17)


def test_balanced_it_needs_nothing_at_any_speed():
    faster = replace(BALANCED, v0=(1000.0,))
    assert np.abs(faster.truth(faster, np.array([0.0, 0.3])).reaction).max() < 1e-9


def test_a_centre_off_the_axle_pulls_and_nothing_else():
    (force, moment), body = reaction(STATIC, np.array([0.1])), STATIC.bodies[0]
    x, y, z = body.center_of_mass
    outwards = body.mass * rotor_balance.SPIN**2 * np.hypot(x, y)
    assert np.linalg.norm(force[0, :2]) == pytest.approx(outwards, rel=1e-14)
    # About the centre there is no moment: that about the origin is the force's own.
    assert moment[0] == pytest.approx(np.cross((x, y, z), force[0]), abs=1e-14)


def test_a_turned_axis_turns_at_the_bearings_and_does_not_pull():
    (force, moment), tensor = reaction(DYNAMIC, np.array([0.1])), about_origin(DYNAMIC)
    assert np.abs(force).max() < 1e-12
    expected = rotor_balance.SPIN**2 * np.array([-tensor[1, 2], tensor[0, 2], 0.0])
    assert moment[0] == pytest.approx(expected, abs=1e-14)
    body, motion = DYNAMIC.bodies[0], DYNAMIC.truth(DYNAMIC, np.array([0.1]))
    bearings = closed_form.bearing_forces(
        tensor, body.mass, body.center_of_mass, rotor_balance.BEARINGS, rotor_balance.SPIN
    )
    assert rotor_balance.bearing_forces(motion)[0] == pytest.approx(bearings, abs=1e-12)
    assert bearings[0] == pytest.approx(-bearings[1], abs=1e-12)


@pytest.mark.parametrize("scene", [STATIC, DYNAMIC], ids=["static", "dynamic"])
def test_angular_momentum_is_not_along_the_axle_and_circles_it_at_the_spin(scene, own_rate):
    momentum = closed_form.angular_momentum(about_origin(scene), rotor_balance.SPIN)
    assert np.linalg.norm(momentum[:2]) > 1e-3 * momentum[2]
    assert own_rate(scene, "turning of L") == pytest.approx(rotor_balance.SPIN, rel=1e-12)


def wrong_ones():
    """Those of the catalogue, which is made of engines: none where one is not installed."""
    try:
        from wrong_engines import reactions
    except ImportError:
        return ()
    return reactions.WRONG


@pytest.mark.parametrize("wrong", wrong_ones(), ids=lambda wrong: wrong.name)
def test_an_engine_that_moves_rightly_and_tells_wrong_reactions_is_caught_by_those_alone(failed, wrong):
    found = failed(wrong.engine, scenes()[wrong.sights[0].scene], duration=0.16)
    about = {"reaction force", "reaction moment", "bearing forces"}
    assert ("truth", "reaction moment") in found or ("truth", "reaction force") in found
    assert {observable.split(",")[0] for _, observable in found} <= about


def test_an_engine_without_the_call_does_not_support_the_scene():
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")

    class Numb(mujoco_.MuJoCo):
        """Knows of no reactions."""

        name = "numb"
        features = mujoco_.MuJoCo.features - {"reaction"}

    with pytest.raises(UnsupportedError, match="numb has no reactions of joints"):
        simulate(STATIC, Numb, Numb.schemes[0], 1e-3)


@pytest.mark.parametrize(
    ("call", "words"),
    [(None, r"names the feature 'reaction' but has no reactions\(\)"),
     (lambda self: np.zeros(6), r"reactions\(\): got shape \(6,\), expected \(1, 6\)")],
)  # fmt: skip
def test_an_engine_whose_call_is_not_there_or_gives_another_shape_is_told_so(call, words):
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")
    spoilt = type("Spoilt", (mujoco_.MuJoCo,), {"name": "spoilt", "reactions": call})
    with pytest.raises(EngineError, match=f"spoilt {words}"):
        simulate(STATIC, spoilt, spoilt.schemes[0], 1e-3)
