"""The compound pendulum: its two hinges, its rates, and engines that take its moments wrongly."""

from dataclasses import replace

import numpy as np
import pytest
from poinsot.reference import compound_pendulum as closed_form
from poinsot.reference import inertia, joint_reactions, quaternions
from poinsot.scenarios import compound_pendulum, equations
from poinsot.scenarios.registry import scenes

SMALL, LARGE = (scenes()[f"compound_pendulum[{variant}]"] for variant in ("small", "large"))


def test_its_hinges_are_reversible_points():
    hung, turned = LARGE.bodies
    arm, beyond = -hung.center_of_mass[2], turned.center_of_mass[2]
    moment = inertia.about_axis(
        inertia.about_point(hung.inertia_array, hung.mass, (0, 0, arm)), (0.6, 0.8, 0)
    )
    assert closed_form.beyond_centre(hung.mass, arm, moment) == pytest.approx(beyond, rel=1e-13)
    assert closed_form.equivalent_length(hung.mass, arm, moment) == pytest.approx(arm + beyond, rel=1e-14)
    # Hung by points at one distance, any body swings alike.
    assert abs(arm - beyond) > 0.1 * arm


def test_both_hang_below_their_hinges_at_rest():
    still = replace(LARGE, q0=(0.0, 0.0), v0=(0.0, 0.0))
    motion = still.truth(still, np.array([0.0, 1.0]))
    hinges = np.array([body.position for body in LARGE.bodies])
    below = np.array([compound_pendulum.ARM, compound_pendulum.BEYOND])
    assert motion.position[:, :, 2] == pytest.approx(np.tile(hinges[:, 2] - below, (2, 1)), abs=1e-15)


@pytest.mark.parametrize("scene", [SMALL, LARGE], ids=["small", "large"])
def test_what_the_hinges_bear_is_what_newtons_and_eulers_equations_of_a_tree_give(scene):
    t = scene.sample_times()
    motion = scene.truth(scene, t)
    found = joint_reactions.reactions(
        equations.links(scene), motion.joint_position, motion.joint_velocity, scene.gravity, (0, 1)
    )
    assert motion.reaction == pytest.approx(found, abs=1e-12 * np.abs(found).max())
    # Across the arm, in the plane of the swing, the closed form of a plane body.
    angle, rate, moment = motion.joint_position[:, 0], motion.joint_velocity[:, 0], compound_pendulum.MOMENT
    x, z = closed_form.pivot_reaction(
        compound_pendulum.MASS, compound_pendulum.ARM, moment, compound_pendulum.G, angle, rate
    ).T
    assert np.linalg.norm(motion.reaction[:, 0, :3], axis=1) == pytest.approx(np.hypot(x, z), rel=1e-12)


def test_an_engine_that_tells_the_weight_alone_of_what_a_hinge_bears_is_seen(failed):
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")

    class Hung(mujoco_.MuJoCo):
        def reactions(self):
            told = super().reactions()
            state = self.state()
            up = np.broadcast_to([0.0, 0.0, compound_pendulum.MASS * compound_pendulum.G], (2, 3))
            told[:, :3] = quaternions.rotated(quaternions.conjugate(state.quaternion), up)
            return told

    assert ("truth", "reaction force") in failed(Hung, SMALL)


@pytest.mark.parametrize("scene", [SMALL, LARGE], ids=["small", "large"])
def test_the_rate_is_the_truths_own_over_whole_swings(scene):
    rate = next(o for o in scene.observables if o.name == "frequency hung").scale(scene, None)
    motion = scene.truth(scene, np.array([0.0, 7 * 2 * np.pi / rate]))
    assert motion.joint_position[1] == pytest.approx(motion.joint_position[0], abs=1e-12)
    assert motion.joint_velocity[1] == pytest.approx(motion.joint_velocity[0], rel=1e-12)
    small = np.sqrt(compound_pendulum.G / compound_pendulum.LENGTH)
    assert rate < small
    assert (rate > 0.99 * small) == (scene is SMALL)


def test_an_engine_that_drops_the_products_of_inertia_lets_them_swing_apart(failed, as_if):
    found = failed(as_if(lambda body: np.diag(np.diag(body.inertia_array))), SMALL)
    assert {("invariant", "parting"), ("truth", "frequency hung"), ("truth", "frequency reversed")} <= found


def test_an_engine_that_counts_the_parallel_axis_twice_does_too(failed, as_if):
    def twice(body):
        x, y, z = body.center_of_mass
        return inertia.about_point(body.inertia_array, body.mass, (x, y, z))

    assert ("invariant", "parting") in failed(as_if(twice), SMALL)
