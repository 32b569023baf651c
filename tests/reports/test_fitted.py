"""What is fitted to a motion: its value, its closed form, and how well the looks tell it."""

from dataclasses import fields, replace

import numpy as np
import pytest
from poinsot.reference import quaternions
from poinsot.reports.cell import Cell
from poinsot.reports.fitted import fitted
from poinsot.scenarios.observables import Observable
from poinsot.scenarios.registry import scenes
from poinsot.scenarios.trajectory import Provenance

SCENE = scenes()["heavy_top[moderate]"]
PRECESSION = next(o for o in SCENE.observables if o.name == "precession")


def cell(scene=SCENE, turned=0.0, shaken=0.0):
    """The exact motion, turned about z at a rate [rad/s], and by an angle [rad] at every other late look."""
    t = scene.sample_times()
    motion = scene.truth(scene, t)
    angle = turned * t + shaken * (np.arange(len(t)) % 2) * (t > t[-1] / 2)
    about_z = np.stack([0 * t, 0 * t, np.sin(angle / 2), np.cos(angle / 2)], axis=-1)[:, None]
    motion = replace(
        motion,
        quaternion=quaternions.product(about_z, motion.quaternion),
        position=quaternions.rotated(about_z, motion.position),
        provenance=Provenance(scene.full_name, "e", "1", "s", 1, "", 1e-3, 1000),
    )
    return Cell.of(motion, {scene.full_name: scene})


def test_a_rate_that_is_off_is_told_with_its_closed_form():
    found = fitted(cell(turned=1e-3), PRECESSION)
    assert found.exact == pytest.approx(PRECESSION.exact(SCENE))
    assert found.value - found.exact == pytest.approx(1e-3, rel=1e-6)
    assert found.uncertainty < 1e-12


def test_what_differs_from_look_to_look_makes_it_uncertain():
    found = fitted(cell(shaken=1e-3), PRECESSION)
    # Every other look alone tells nothing of the shaking: what all of them make of it is the uncertainty.
    assert abs(found.value - found.exact) > 1e-6
    assert found.uncertainty == pytest.approx(abs(found.value - found.exact), rel=1e-3)


def test_only_rates_are_fitted():
    assert fitted(cell(), SCENE.observables[0]) is None


def test_too_few_looks_tell_no_uncertainty():
    found = fitted(cell(replace(SCENE, samples=3, duration=0.03)), PRECESSION)
    assert found.uncertainty is None


@pytest.mark.parametrize("name", scenes())
def test_every_rate_has_a_closed_form_and_can_be_told_from_half_the_looks(name):
    scene = scenes()[name]
    motion = replace(
        scene.truth(scene, scene.sample_times()),
        provenance=Provenance(scene.full_name, "e", "1", "s", 1, "", scene.dt, 1),
    )
    rates: list[Observable] = [o for o in scene.observables if o.kind == "rate"]
    looked = Cell.of(motion, {scene.full_name: scene})
    for rate in rates:
        found = fitted(looked, rate)
        assert found.value == found.exact
        assert 0 < found.uncertainty <= 1e-12 * looked.scale(rate)


@pytest.mark.parametrize("name", scenes())
def test_a_rate_goes_the_way_that_its_closed_form_says(name):
    scene = scenes()[name]
    motion = scene.truth(scene, scene.sample_times())
    held = [part.name for part in fields(motion) if part.name not in ("t", "provenance")]
    still = replace(motion, **{part: np.repeat(getattr(motion, part)[:1], len(motion.t), 0) for part in held})
    for rate in scene.observables:
        if rate.kind == "rate" and rate.unit == "rad/s":
            # Over the part of a turn that a run shows, an uneven one is faster or slower than on the whole.
            turned = rate.difference(scene, motion, still)[0, 0]
            assert 0.4 < turned / rate.exact(scene) < 2.5, rate.name
