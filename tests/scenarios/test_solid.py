"""Solids: what they come to together, what is refused, and that a body without any stays what it was."""

from dataclasses import replace

import numpy as np
import pytest
from poinsot.reference import inertia, inertia_of_shapes
from poinsot.reference.errors import InputError
from poinsot.reference.quaternions import matrix
from poinsot.scenarios.body import Joint, of_solids
from poinsot.scenarios.contact import Contact, Plane, Sphere
from poinsot.scenarios.registry import scenes
from poinsot.scenarios.solid import Solid, together

TURN = (0.48, -0.36, 0.0, 0.8)


def test_two_spheres_by_parallel_axes():
    ball = Solid("sphere", (0.1,), 500.0, (0.3, 0.0, 0.0))
    other = replace(ball, position=(-0.3, 0.0, 0.0))
    mass, centre, tensor = together([ball, other])
    assert mass == pytest.approx(2 * 500 * 4 / 3 * np.pi * 0.1**3, rel=1e-15)
    np.testing.assert_allclose(centre, 0, atol=1e-17)
    own = 0.4 * mass * 0.1**2
    np.testing.assert_allclose(tensor, np.diag([own, own + mass * 0.09, own + mass * 0.09]), rtol=1e-14)


def test_a_turned_box_off_the_origin():
    box = Solid("box", (0.3, 0.2, 0.1), 700.0, (0.05, -0.1, 0.2), TURN)
    mass, centre, tensor = together([box])
    np.testing.assert_allclose(centre, box.position, rtol=1e-15)
    R = matrix(np.array(TURN))
    np.testing.assert_allclose(
        tensor, mass * R @ inertia_of_shapes.box(0.3, 0.2, 0.1).inertia @ R.T, atol=1e-16
    )
    np.testing.assert_array_equal(tensor, tensor.T)


def test_what_is_taken_away_leaves_the_closed_form_of_the_hollow():
    outer = Solid("sphere", (0.15,), 900.0)
    mass, _, tensor = together([outer, replace(outer, sizes=(0.1,), taken_away=True)])
    exact = inertia_of_shapes.hollow_sphere(0.1, 0.15)
    assert mass == pytest.approx(900 * exact.volume, rel=1e-14)
    np.testing.assert_allclose(tensor, mass * exact.inertia, rtol=1e-14)


def test_a_mesh_of_a_box_is_the_box():
    corners = [(x, y, z) for x in (0.0, 0.3) for y in (0.0, 0.2) for z in (0.0, 0.1)]
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    faces = tuple(face for a, b, c, d in quads for face in ((a, b, c), (a, c, d)))
    mesh = Solid("mesh", (), 700.0, (-0.15, -0.1, -0.05), vertices=tuple(corners), faces=faces)
    for got, expected in zip(together([mesh]), together([Solid("box", (0.3, 0.2, 0.1), 700.0)]), strict=True):
        np.testing.assert_allclose(got, expected, atol=1e-16, rtol=1e-14)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("torus", (0.1,), 1.0), "got form 'torus', expected one of sphere"),
        (("box", (0.1, 0.2), 1.0), "got sizes (0.1, 0.2), expected 3"),
        (("sphere", (-0.1,), 1.0), "radius"),
        (("sphere", (0.1,), 0.0), "sphere density"),
        (("mesh", (), 1.0), "a mesh has some"),
        (("sphere", (0.1,), 1.0, (0.0, 0.0)), "sphere position"),
        (("sphere", (0.1,), 1.0, (0.0, 0.0, 0.0), (1.0, 1.0, 0.0, 0.0)), "sphere quaternion"),
    ],
)
def test_what_is_no_solid_is_refused(arguments, words):
    with pytest.raises(InputError) as caught:
        Solid(*arguments)
    assert words in str(caught.value)


def test_more_taken_away_than_there_is():
    ball = Solid("sphere", (0.1,), 500.0)
    with pytest.raises(InputError, match="mass of all solids together"):
        together([ball, replace(ball, sizes=(0.2,), taken_away=True)])


def test_a_scene_names_what_its_solids_need():
    needs = {
        scene.variant: scene.features for scene in scenes().values() if scene.name == "inertia_of_shapes"
    }
    assert needs["sphere"] == {"hinge", "spring", "solid"}
    assert needs["ellipsoid"] == {"hinge", "spring", "solid", "ellipsoid"}
    assert needs["shell"] == {"hinge", "spring", "solid", "shell"}
    assert needs["hollow sphere"] == {"hinge", "spring", "solid", "hollow"}


def test_a_scene_without_solids_says_nothing_of_them():
    assert "solid" not in scenes()["heavy_top[fast]"].as_json()
    assert '"solids": [{' in scenes()["inertia_of_shapes[box]"].as_json()


def test_solids_touch_nothing():
    scene = scenes()["inertia_of_shapes[tumbling]"]
    with pytest.raises(InputError, match="got body 'box', whose solids touch nothing"):
        replace(scene, contacts=(Contact("box", Sphere(0.1), None, Plane()),))


def test_a_body_of_solids_is_what_they_come_to():
    body = of_solids("ball", [Solid("sphere", (0.1,), 500.0, (0.0, 0.2, 0.0))], (Joint("free", "free"),))
    assert body.center_of_mass == (0.0, 0.2, 0.0)
    np.testing.assert_allclose(body.inertia_array, 0.4 * body.mass * 0.01 * np.eye(3), rtol=1e-14)
    moved = inertia.about_point(body.inertia_array, body.mass, body.center_of_mass)
    assert moved[0, 0] == pytest.approx(body.mass * (0.004 + 0.04), rel=1e-14)
