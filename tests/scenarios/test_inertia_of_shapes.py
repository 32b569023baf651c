"""Solids whose inertia engines work out: closed forms, and engines that work it out wrong and hide it."""

from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("mujoco")
pytest.importorskip("pinocchio")

from poinsot.adapters.mujoco_ import MuJoCo
from poinsot.adapters.pinocchio_ import Pinocchio
from poinsot.reference import inertia_of_shapes as forms
from poinsot.reference.inertia import about_point
from poinsot.scenarios import inertia_of_shapes as scene_file
from poinsot.scenarios.body import diagonal
from poinsot.scenarios.registry import scenes


def scene(variant):
    return scenes()[f"inertia_of_shapes[{variant}]"]


class Mistaken:
    """Takes solids for others; mass, centre and inertia as the scene has them are not what it looks at."""

    def build(self, scene, scheme, dt):
        bodies = tuple(
            replace(body, solids=tuple(self.taken_for(solid) for solid in body.solids))
            for body in scene.bodies
        )
        super().build(replace(scene, bodies=bodies), scheme, dt)


class Shells(Mistaken, MuJoCo):
    """Solid spheres of the right mass, but all of it in the surface."""

    def taken_for(self, solid):
        shell = forms.shell(*solid.sizes)
        return replace(solid, form="shell", density=solid.mass() / shell.volume)


class DensityOfWater(Mistaken, Pinocchio):
    def taken_for(self, solid):
        return replace(solid, density=1000.0)


class Unmoved(Mistaken, MuJoCo):
    def taken_for(self, solid):
        return replace(solid, position=(0.0, 0.0, 0.0))


class Unturned(Mistaken, Pinocchio):
    def taken_for(self, solid):
        return replace(solid, quaternion=(0.0, 0.0, 0.0, 1.0))


class Boxes(Mistaken, MuJoCo):
    """A box around each capsule, of the same mass."""

    def taken_for(self, solid):
        radius, height = solid.sizes
        edges = (2 * radius, 2 * radius, height + 2 * radius)
        return replace(solid, form="box", sizes=edges, density=solid.mass() / np.prod(edges))


class AMillionthWider(Mistaken, Pinocchio):
    def taken_for(self, solid):
        return replace(solid, sizes=(solid.sizes[0] * (1 + 1e-6), *solid.sizes[1:]))


class DiscsForCylinders(Mistaken, Pinocchio):
    """What tumbles freely shows the ratios of its moments."""

    def taken_for(self, solid):
        return replace(solid, sizes=(*solid.sizes[:-1], solid.sizes[-1] / 2), density=2 * solid.density)


CAUGHT = [
    (Shells, "sphere"),
    (DensityOfWater, "sphere"),
    (DensityOfWater, "molecule"),
    (Unmoved, "corner"),
    (Unmoved, "molecule"),
    (Unturned, "turned box"),
    (Unturned, "cone"),
    (Boxes, "capsule"),
    (AMillionthWider, "cylinder"),
]


@pytest.mark.parametrize(("engine", "variant"), CAUGHT)
def test_caught_by_motion_though_it_reads_back_what_was_asked(failed, engine, variant):
    found = failed(engine, scene(variant))
    assert {("truth", "orientation, limit"), ("truth", "omega, limit")} <= found
    assert not any(check == "setup" for check, _ in found)
    assert engine is AMillionthWider or any(name.startswith("moment about") for _, name in found)


def test_a_wrong_ratio_of_moments_is_caught_in_free_flight(failed):
    assert ("truth", "omega, limit") in failed(DiscsForCylinders, scene("tumbling"))


def test_no_other_scene_tells_an_engine_of_solids():
    assert {s.name for s in scenes().values() if "solid" in s.features} == {"inertia_of_shapes"}


def test_the_engines_themselves_are_not_caught(failed):
    assert not failed(MuJoCo, scene("capsule"))
    assert not failed(Pinocchio, scene("molecule"))


def test_the_moments_that_a_motion_tells_are_those_it_was_made_with():
    exact = scene("box")
    larger = replace(
        exact,
        bodies=tuple(
            replace(body, inertia=diagonal(*1.3 * np.diag(body.inertia_array))) for body in exact.bodies
        ),
    )
    t = exact.sample_times()
    told = [o for o in exact.observables if o.name.startswith("moment about")]
    assert len(told) == 3
    for observable, body in zip(told, exact.bodies, strict=True):
        difference = observable.difference(exact, larger.truth(larger, t), exact.truth(exact, t))
        # A slower motion goes round an ellipse where the exact one goes round a circle.
        assert difference[0, 0] == pytest.approx(0.3 * scene_file.moment(body), rel=0.1)
        assert observable.difference(exact, exact.truth(exact, t), exact.truth(exact, t))[0, 0] == 0


def test_a_cube_about_its_corner_has_the_moments_of_the_book():
    tensor = forms.cube_about_corner(scene("corner").bodies[0].mass, scene_file.EDGE)
    for body in scene("corner").bodies:
        axis = np.array(body.joints[0].axis)
        assert scene_file.moment(body) == pytest.approx(axis @ tensor @ axis, rel=1e-14)


def test_the_molecule_is_points_and_balls_about_them():
    body = scene("molecule").bodies[0]
    masses = np.array([solid.mass() for solid in body.solids])
    centre, tensor = forms.molecule(masses, [solid.position for solid in body.solids])
    balls = sum(0.4 * m * solid.sizes[0] ** 2 for m, solid in zip(masses, body.solids, strict=True))
    np.testing.assert_allclose(body.center_of_mass, centre, rtol=1e-14)
    np.testing.assert_allclose(body.inertia_array, tensor + balls * np.eye(3), rtol=1e-13)


def test_the_cone_is_a_pyramid_of_many_sides():
    sides, radius, height = scene_file.SIDES, scene_file.RADIUS, scene_file.HEIGHT
    solid, pyramid = scene_file.cone(sides, radius, height).whole(), forms.pyramid(sides, radius, height)
    assert solid.volume == pytest.approx(pyramid.volume, rel=1e-14)
    np.testing.assert_allclose(solid.centre, pyramid.centre, atol=1e-16)
    np.testing.assert_allclose(solid.inertia, pyramid.inertia, atol=1e-16)


def test_the_hollow_sphere_has_the_closed_form_of_the_book():
    body = scene("hollow sphere").bodies[0]
    exact = forms.hollow_sphere(0.1, 0.15)
    np.testing.assert_allclose(body.inertia_array, body.mass * exact.inertia, rtol=1e-14)


def test_a_wire_off_the_centre_feels_the_parallel_axes():
    for body in scene("molecule").bodies:
        axis = np.array(body.joints[0].axis)
        moved = about_point(body.inertia_array, body.mass, body.center_of_mass)
        assert scene_file.moment(body) == pytest.approx(axis @ moved @ axis, rel=1e-14)
