"""Scenes seen from the centres of mass of their free bodies: the same motion, whatever the origin."""

from dataclasses import replace

import numpy as np
import pytest
from poinsot.adapters.centred import centred
from poinsot.reference import equations_of_motion
from poinsot.scenarios.body import Body, Joint, diagonal
from poinsot.scenarios.contact import Contact, Plane, Sphere

SEEDS = [0, 2, 4]
OFFSET = (0.2, -0.1, 0.3)
ENGINES = pytest.mark.parametrize(
    ("module", "name"), [("mujoco_", "MuJoCo"), ("pinocchio_", "Pinocchio")], ids=["mujoco", "pinocchio"]
)


@pytest.fixture
def top(scene_of):
    """A free body whose origin is off its centre, which nothing pulls."""
    body = Body("top", 1.0, diagonal(0.01, 0.02, 0.025), (Joint("free", "free"),), center_of_mass=OFFSET)
    q0 = [0.1, 0.2, 0.3, 0.5, 0.5, 0.5, 0.5]
    return scene_of([body], q0, [1.0, -2.0, 0.5, 1.0, 2.0, 5.0], gravity=(0.0, 0.0, 0.0))


@pytest.mark.parametrize("seed", SEEDS)
def test_every_body_is_where_it_was_and_moves_as_it_did(random_tree, links_of, seed):
    scene = random_tree(seed)
    made = centred(scene)
    before, after = (
        equations_of_motion.link_motion(links_of(s), np.array(s.q0), np.array(s.v0))
        for s in (scene, made.scene)
    )
    for found, expected in zip(after, before, strict=True):
        assert found == pytest.approx(expected, abs=1e-14 * max(1.0, np.abs(expected).max()))


@pytest.mark.parametrize("seed", SEEDS)
def test_accelerations_come_back_to_the_origins_they_were_asked_for(random_tree, links_of, seed):
    scene = random_tree(seed)
    made, q, v = centred(scene), np.array(scene.q0), np.array(scene.v0)
    there = made.state(q, v)
    found = equations_of_motion.accelerations(links_of(made.scene), *there, scene.gravity)
    expected = equations_of_motion.accelerations(links_of(scene), q, v, scene.gravity)
    assert made.acceleration(q, v, found) == pytest.approx(expected, rel=1e-9, abs=1e-9)


def test_bodies_that_are_not_free_or_off_centre_are_left_alone(scene_of, top):
    pivoted = Body("top", 1.0, diagonal(1, 2, 2.5), (Joint("pivot", "ball"),), center_of_mass=OFFSET)
    for scene in (
        scene_of([pivoted], [0, 0, 0, 1], [0, 0, 0]),
        replace(top, bodies=(replace(top.bodies[0], center_of_mass=(0.0, 0.0, 0.0)),)),
    ):
        assert centred(scene).scene is scene


def test_shapes_that_touch_keep_the_origins_they_hang_on(top):
    touching = replace(top, contacts=(Contact("top", Sphere(0.1), None, Plane()),))
    assert centred(touching).scene is touching


@ENGINES
def test_a_body_flies_straight_whatever_its_origin(top, module, name):
    engine = getattr(pytest.importorskip(f"poinsot.adapters.{module}"), name)()
    first_order = next(scheme for scheme in engine.schemes if scheme.twin == "semi-implicit Euler")
    engine.build(top, first_order, 1e-2)
    start = engine.state()
    engine.step(100)
    end = engine.state()
    # Stepped by its origin it would be off by 0.05 m here; a hundred sums of rounded steps are left.
    assert end.position == pytest.approx(start.position + start.velocity, abs=1e-13)
    assert end.velocity == pytest.approx(start.velocity, abs=1e-13)
    assert engine.readback().values["body/top/center_of_mass"] == pytest.approx(OFFSET, rel=1e-15)
