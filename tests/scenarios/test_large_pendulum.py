"""The large pendulum: truth against Newton's law, rates, and an engine that folds its angle."""

import numpy as np
import pytest
from poinsot.scenarios.registry import scenes

SCENES = pytest.mark.parametrize("name", ["large_pendulum[swing]", "large_pendulum[round]"])


@SCENES
def test_torque_about_the_hinge_turns_the_body(name):
    scene = scenes()[name]
    (body,), h = scene.bodies, 1e-4
    t = np.array([0.3, 0.9, 2.1])
    axis, hinge = np.array(body.joints[0].axis), np.array(body.position)

    def momentum(motion):
        arm = motion.position[:, 0] - hinge
        spin = motion.omega[:, 0] @ body.inertia_array
        return (body.mass * np.cross(arm, motion.velocity[:, 0]) + spin) @ axis

    slope = (momentum(scene.truth(scene, t + h)) - momentum(scene.truth(scene, t - h))) / (2 * h)
    arm = scene.truth(scene, t).position[:, 0] - hinge
    torque = np.cross(arm, body.mass * np.array(scene.gravity)) @ axis
    # The difference quotient is off by h²/6 of a third derivative: about 100 of these units.
    assert slope == pytest.approx(torque, rel=1e-5, abs=1e-5)


@SCENES
def test_the_rate_is_the_truths_own_over_whole_rounds(name):
    scene = scenes()[name]
    rate = next(o for o in scene.observables if o.name == "frequency").scale(scene, None)
    motion = scene.truth(scene, np.array([0.0, 7 * 2 * np.pi / rate]))
    turned = motion.joint_position[1, 0] - motion.joint_position[0, 0]
    # Seven rounds of phase, each rounded at most a few times.
    assert turned == pytest.approx(14 * np.pi if scene.variant == "round" else 0.0, abs=1e-12)
    assert motion.joint_velocity[1] == pytest.approx(motion.joint_velocity[0], rel=1e-12)


def test_an_engine_that_folds_its_angle_fails_only_where_the_pendulum_goes_round(failed):
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")

    class Folding(mujoco_.MuJoCo):
        """Its hinge's angle is the one between −π and π."""

        def state(self):
            state = super().state()
            folded = (state.joint_position + np.pi) % (2 * np.pi) - np.pi
            return state._replace(joint_position=folded)

    assert ("truth", "hinge angle") in failed(Folding, scenes()["large_pendulum[round]"])
    assert ("truth", "orientation") not in failed(Folding, scenes()["large_pendulum[round]"])
    assert not failed(Folding, scenes()["large_pendulum[swing]"])
