"""How much a kick grows: against closed forms, and small enough for twins on every scene that ships."""

from dataclasses import replace

import numpy as np
import pytest
from poinsot.reports.growth import growth
from poinsot.reports.twin import CHAOTIC
from poinsot.scenarios import observables
from poinsot.scenarios.registry import scenes

FREE, CHAIN = scenes()["free_symmetric_top[oblate]"], scenes()["co2_chain[translation]"]


@pytest.mark.parametrize("scene", scenes().values(), ids=lambda scene: scene.full_name)
def test_a_kick_departs_by_no_less_than_itself(scene):
    # The part of 1e-9 is of the largest velocity, which a state is seldom much larger than.
    assert 0.5 <= growth(scene) < np.inf


@pytest.mark.parametrize("name", ["free_symmetric_top", "heavy_top", "co2_chain"])
def test_rounding_does_not_separate_twins_where_motion_is_regular(name):
    assert max(growth(scene) for scene in scenes().values() if scene.name == name) < 1e3 < CHAOTIC


def test_a_free_top_turns_further_by_the_kick_times_the_time():
    # The fastest velocity is ω3 = 5 rad/s; a kick of 1e-9 of it turns the body by 5e-9 · 10 s more.
    assert growth(FREE) == pytest.approx(50, rel=1e-3)
    assert growth(replace(FREE, duration=20.0)) == pytest.approx(100, rel=1e-3)


def test_every_velocity_is_kicked():
    # Position alone looks only at the three linear ones, which are kicked by 1e-9 of the largest of all, 5.
    position = replace(FREE, observables=(observables.position(),), errors={})
    assert growth(position) == pytest.approx(5 / np.linalg.norm(FREE.v0[:3]), rel=1e-6)


def test_a_drift_departs_as_it_goes():
    # All masses drift at one speed; a kick to the first joint, which carries the others, moves all three.
    assert growth(CHAIN) == pytest.approx(1.0, rel=1e-3)


def test_a_motion_from_rest_is_kicked_by_the_speed_it_reaches():
    scene = scenes()["co2_chain[symmetric]"]
    released = replace(scene, v0=(0.0, 0.0, 0.0))
    # The outer two swing at one speed; a kick to the joint that carries all three moves three, for ever.
    assert growth(released) == pytest.approx(np.sqrt(3 / 2), rel=1e-3)


@pytest.mark.parametrize("name", ["stacked_turntables", "large_pendulum[swing]"])
def test_where_the_truth_takes_no_notice_of_a_kick_it_is_integrated(name):
    scene = scenes()[name]
    deaf = replace(scene, truth=lambda _, t: scene.truth(scene, t))
    assert growth(deaf) == pytest.approx(growth(scene), rel=0.02)
