"""The gimbal: angles followed through gimbal lock, its conditioning, an engine that adds rates too simply."""

import re

import numpy as np
import pytest
from poinsot.scenarios.registry import scenes
from scipy.spatial.transform import Rotation

SCENES = pytest.mark.parametrize("variant", ["general", "near zero", "through zero"])


def gimbal(variant):
    return scenes()[f"euler_angles[{variant}]"]


@SCENES
def test_the_hinges_turn_the_body_as_z_y_and_z_do(variant):
    motion = gimbal(variant).truth(gimbal(variant), np.linspace(0.0, 1.2, 50))
    expected = Rotation.from_euler("ZYZ", motion.joint_position).as_matrix()
    found = Rotation.from_quat(motion.quaternion[:, 0]).as_matrix()
    # Near β = 0 the angles lose what the conditioning gains, but in their sum it cancels.
    assert found == pytest.approx(expected, abs=1e-13)


@SCENES
def test_the_angles_run_on_without_a_jump_as_their_rates_say(variant):
    h, t = 1e-6, np.linspace(1e-3, 1.199, 997)
    before, here, after = (gimbal(variant).truth(gimbal(variant), t + dt) for dt in (-h, 0, h))
    slope = (after.joint_position - before.joint_position) / (2 * h)
    # The quotient divides the rounding of an angle, 1e-16 times the conditioning of up to 1e4, by h.
    assert slope == pytest.approx(here.joint_velocity, rel=1e-5, abs=1e-5)
    assert gimbal(variant).truth(gimbal(variant), np.array([0.0])).joint_position[0] == pytest.approx(
        gimbal(variant).q0, abs=1e-14
    )


def test_the_conditioning_is_what_the_summary_says():
    for variant in ("general", "near zero"):
        scene = gimbal(variant)
        beta = np.abs(scene.truth(scene, np.linspace(0.0, scene.duration, 2001)).joint_position[:, 1]).min()
        said = float(re.search(r"up to ([0-9]+[.][0-9])", scene.summary)[1])
        # The singular values of the rates' matrix, whose squares are 1 ± cos β, said to three digits.
        assert said == pytest.approx(np.sqrt((1 + np.cos(beta)) / (1 - np.cos(beta))), abs=0.05)
    assert "6°" in scene.summary
    assert beta == pytest.approx(np.radians(6), abs=np.radians(0.5))


def test_one_variant_goes_straight_through():
    scene = gimbal("through zero")
    angles = scene.truth(scene, np.linspace(0.0, scene.duration, 101)).joint_position
    assert np.count_nonzero(np.diff(np.sign(angles[:, 1]))) == 1
    assert angles[:, [0, 2]] == pytest.approx(np.tile([0.4, -1.1], (101, 1)), abs=1e-13)
    # Its crossing is as far from steps and half steps as it is said to be, in every ladder.
    crossing = 0.6 + 0.008 / 3
    for dt in {step for steps in scene.ladders.values() for step in steps}:
        beat = crossing / (dt / 2) % 1
        assert min(beat, 1 - beat) == pytest.approx(1 / 3, abs=1e-9)
    assert scene.truth(scene, np.array([crossing])).joint_position[0, 1] == pytest.approx(0, abs=1e-14)


def test_an_engine_that_adds_rates_along_axes_that_do_not_turn(failed):
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")

    class Adding(mujoco_.MuJoCo):
        """Takes hinges of one body for independent of each other when it tells ω."""

        def state(self):
            state = super().state()
            joints = self._scene.scalar_joints
            if not joints:
                return state
            rates = zip(state.joint_velocity, joints, strict=True)
            return state._replace(omega=sum(rate * np.array(joint.axis) for rate, joint in rates)[None])

    found = failed(Adding, gimbal("general"))
    assert {("invariant", "omega of the rates"), ("truth", "omega"), ("invariant", "energy")} <= found
    assert not {observable for _, observable in found} & {"orientation", "attitude of the angles"}
    assert not failed(Adding, scenes()["large_pendulum[swing]"])
