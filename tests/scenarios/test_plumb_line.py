"""Plumb lines: the angles of books, and engines whose centrifugal force is missing or elsewhere."""

from dataclasses import replace

import numpy as np
import pytest
from poinsot.reference.plumb_line import effective_gravity
from poinsot.reports.acceleration import expected
from poinsot.scenarios import plumb_line
from poinsot.scenarios.forces import Coriolis, forces_on
from poinsot.scenarios.registry import scenes

SCENES = pytest.mark.parametrize("scene", plumb_line.SCENES, ids=lambda scene: scene.variant)


@SCENES
def test_the_recorded_deflection_is_the_references(scene):
    assert plumb_line.DEFLECTIONS[scene.variant] == plumb_line._deflection(scene)
    motion = scene.truth(scene, scene.sample_times())
    assert plumb_line._hanging(scene, motion) == pytest.approx(plumb_line._deflection(scene), rel=1e-12)


@SCENES
def test_gravity_and_the_centrifugal_force_pull_along_the_string(scene):
    place = scene.truth(scene, np.zeros(1)).position[0]
    pull = forces_on(scene.bodies, scene.forces)(place, np.zeros((1, 3)))
    pull += plumb_line.BODY.mass * np.array(scene.gravity)
    assert np.abs(np.cross(place, pull)).max() < 1e-14 * np.abs(pull).max()


def test_a_plumb_line_at_45_degrees_is_off_by_what_books_say():
    found = effective_gravity(plumb_line.G, plumb_line.OMEGA, plumb_line.RADIUS, np.pi / 4)
    assert found.deflection == pytest.approx(0.0017, abs=5e-5)
    equator = effective_gravity(plumb_line.G, plumb_line.OMEGA, plumb_line.RADIUS, np.pi / 2)
    assert 1 - equator.magnitude / plumb_line.G == pytest.approx(0.0034, abs=1e-4)


@SCENES
def test_an_engine_without_the_centrifugal_force_is_seen(scene, failed):
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")

    class Unmoved(mujoco_.MuJoCo):
        def build(self, scene, scheme, dt):
            forces = tuple(force for force in scene.forces if isinstance(force, Coriolis))
            super().build(replace(scene, forces=forces), scheme, dt)

    assert ("truth", "deflection") in failed(Unmoved, scene)


def test_an_engine_that_takes_it_at_the_joint_is_seen_on_the_table(failed, monkeypatch):
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")

    class AtTheFrame(mujoco_.Forces):
        def _push(self, model, data):
            (force,) = self._total(data.xpos[self._bodies], self._velocity)
            (body,), torque = self._bodies, np.zeros(3)
            self._mujoco.mj_applyFT(model, data, force, torque, data.xpos[body], body, data.qfrc_passive)

    monkeypatch.setattr(mujoco_, "Forces", AtTheFrame)
    assert ("truth", "deflection") in failed(mujoco_.MuJoCo, scenes()["plumb_line[conical]"])


@SCENES
def test_forces_that_cancel_at_rest_still_count_as_what_rounding_is_a_part_of(scene):
    exact = expected(scene)
    # At the start nothing is left of the weight, 20 N on an arm of half a metre, but its rounding.
    assert np.abs(exact.acceleration[0]).max() < 1e-12
    assert exact.size[0] > 1e-2
