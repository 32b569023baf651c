"""Foucault's pendulum: the turn of its plane, and engines that leave out part of a turning frame."""

from dataclasses import replace

import numpy as np
import pytest
from poinsot.reference import foucault
from poinsot.scenarios import foucault_pendulum
from poinsot.scenarios.forces import Centrifugal, Coriolis
from poinsot.scenarios.registry import scenes


def test_the_plane_turns_at_the_rate_of_the_planet(own_rate):
    scene = scenes()["foucault_pendulum"]
    # The phase is 2φ exactly, wherever in its swing the bob is.
    assert own_rate(scene, "turn of the plane, twice") == pytest.approx(
        -2 * foucault_pendulum.TURN, rel=1e-12
    )


def test_small_swings_are_those_of_the_textbooks():
    t = np.linspace(0.0, 5.0, 20)
    small = 1e-4
    hung = foucault_pendulum._hung
    w = np.sqrt(foucault_pendulum.G / foucault_pendulum.LENGTH)
    motion = hung(t, small * np.cos(w * t), -small * w * np.sin(w * t))
    start = motion.position[0, 0, :2], motion.velocity[0, 0, :2]
    arguments = foucault_pendulum.LENGTH, foucault_pendulum.G, foucault_pendulum.TURN
    r, _ = foucault.motion_on_a_turntable(*arguments, *start, t)
    # A sine differs from its angle by the cube.
    assert np.abs(motion.position[:, 0, :2] - r).max() < small**3


def test_the_velocity_is_the_slope_of_the_place():
    scene = scenes()["foucault_pendulum"]
    t, h = np.linspace(0.1, 2.0, 9), 1e-5
    before, now, after = (scene.truth(scene, t + shift) for shift in (-h, 0.0, h))
    for place, rate in (("position", "velocity"), ("joint_position", "joint_velocity")):
        slope = (getattr(after, place) - getattr(before, place)) / (2 * h)
        # The quotient is off by h²/6 of a third derivative: about 100 of these units.
        assert getattr(now, rate) == pytest.approx(slope, abs=1e-8)


@pytest.mark.parametrize("kept", [Coriolis, Centrifugal])
def test_an_engine_with_only_part_of_the_turning_frame_is_seen(kept, failed):
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")

    class Partial(mujoco_.MuJoCo):
        def build(self, scene, scheme, dt):
            forces = tuple(force for force in scene.forces if isinstance(force, kept))
            super().build(replace(scene, forces=forces), scheme, dt)

    seen = failed(Partial, scenes()["foucault_pendulum"])
    assert ("truth", "position, limit") in seen
    # Without its centrifugal part the plane still turns as it did: the swing itself is slower.
    assert (("truth", "turn of the plane, twice") in seen) == (kept is Centrifugal)
