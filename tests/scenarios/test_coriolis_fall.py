"""The Coriolis fall: 2.2 cm from 100 m, a gyration at 2Ω, and engines that turn stones the wrong way."""

from dataclasses import replace

import numpy as np
import pytest
from poinsot.reference import rotating_frames
from poinsot.scenarios import coriolis_fall
from poinsot.scenarios.forces import Coriolis
from poinsot.scenarios.registry import scenes


def test_a_stone_lands_two_centimetres_east():
    scene = scenes()["coriolis_fall[dropped]"]
    fall = np.sqrt(2 * 100.0 / coriolis_fall.G)
    motion = scene.truth(scene, np.array([0.0, fall]))
    assert motion.position[1, 0, 0] == pytest.approx(0.022, abs=1e-4)
    assert motion.position[1, 0, 2] == pytest.approx(0.0, abs=1e-5)


def test_the_deflection_is_the_first_orders_but_for_the_square_of_the_turn():
    scene = scenes()["coriolis_fall[dropped]"]
    motion = scene.truth(scene, scene.sample_times())
    first_order = coriolis_fall._to_first_order(scene)
    turned = coriolis_fall.PLANETS["dropped"][0] * scene.duration
    assert abs(coriolis_fall._eastward(scene, motion) / first_order - 1) < turned**2


def test_the_gyration_is_the_phase_of_the_truth(own_rate):
    scene = scenes()["coriolis_fall[thrown]"]
    # The acceleration across the axis turns at 2Ω exactly: only rounding is left.
    assert abs(own_rate(scene, "gyration")) == pytest.approx(1.0, rel=1e-13)


def test_the_truth_is_straight_but_for_gravity_seen_from_the_room():
    # Coriolis' force alone is a turning frame's but for the centrifugal part, of second order in Ω.
    scene = scenes()["coriolis_fall[thrown]"]
    small = 1e-6
    planet = np.array(scene.forces[0].Omega) / coriolis_fall.PLANETS["thrown"][0] * small
    t = np.array([0.0, 2.0])
    r, _ = rotating_frames.straight_line_seen_turning(planet, (1.0, 2.0, 3.0), (3.0, -4.0, 12.0), t)
    straight = np.array((1.0, 2.0, 3.0)) + np.outer(t, (3.0, -4.0, 12.0))
    bent, _ = rotating_frames.coriolis_fall(small, 0.7, 0.0, (1.0, 2.0, 3.0), (3.0, -4.0, 12.0), t)
    assert r[1] - straight[1] == pytest.approx(bent[1] - straight[1], abs=1e-9)


@pytest.mark.parametrize("factor", [-1.0, 0.5])
@pytest.mark.parametrize("variant", ["dropped", "thrown"])
def test_an_engine_with_another_coriolis_force_is_seen(factor, variant, failed):
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")

    class Turned(mujoco_.MuJoCo):
        def build(self, scene, scheme, dt):
            omega = tuple(factor * part for part in scene.forces[0].Omega)
            super().build(replace(scene, forces=(Coriolis(omega),)), scheme, dt)

    scene = scenes()[f"coriolis_fall[{variant}]"]
    own = "gyration" if variant == "thrown" else "eastward deflection"
    assert {("truth", own), ("truth", "position, limit")} <= failed(Turned, scene)
