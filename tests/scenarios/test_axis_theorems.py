"""The axis theorems: four descriptions of one motion, the cube's 2, 11, 11, and engines that know half."""

import numpy as np
import pytest
from poinsot.reference import inertia, quaternions
from poinsot.scenarios import axis_theorems
from poinsot.scenarios.registry import scenes

ONE, WELDED, ROTATED, OFFSET, CORNER = (
    scenes()[f"axis_theorems[{variant}]"] for variant in ("one", "welded", "rotated", "offset", "corner")
)
FREE = pytest.mark.parametrize("scene", [WELDED, ROTATED, OFFSET], ids=["welded", "rotated", "offset"])


def of_the_whole(scene):
    """Centre of mass, its velocity, attitude of the principal axes and ω in them, of the exact motion."""
    motion, masses = scene.truth(scene, scene.sample_times()), [body.mass for body in scene.bodies]
    centre, velocity = (
        np.average(array, axis=1, weights=masses) for array in (motion.position, motion.velocity)
    )
    turn = quaternions.conjugate(np.array(axis_theorems.TURNED if scene is ROTATED else (0.0, 0.0, 0.0, 1.0)))
    attitude = quaternions.product(motion.quaternion[:, 0], np.broadcast_to(turn, (len(motion.t), 4)))
    omega = quaternions.rotated(quaternions.conjugate(turn), motion.omega[:, 0])
    return quaternions.matrix(attitude), omega, centre, velocity


@FREE
def test_every_description_is_of_one_motion(scene):
    for found, expected in zip(of_the_whole(scene), of_the_whole(ONE), strict=True):
        # Tens of roundings of one and the same closed form, from starts rounded otherwise.
        assert found == pytest.approx(expected, abs=2e-13)


@FREE
def test_every_description_has_the_same_principal_moments(scene):
    _, tensor = axis_theorems.whole(scene.bodies)
    assert inertia.principal(tensor)[0] == pytest.approx(np.diag(ONE.bodies[0].inertia_array), rel=1e-14)


def test_no_description_is_another():
    assert np.count_nonzero(ROTATED.bodies[0].inertia_array) == 9
    assert len(WELDED.bodies) == 2
    assert any(OFFSET.bodies[0].center_of_mass)


def test_the_tensor_is_that_of_the_bricks_points():
    # Eight points of a brick, at its edges over √3 and so of its own second moments, carry its inertia.
    points, masses = [], []
    for mass, edges, place in zip(
        axis_theorems.MASSES, axis_theorems.EDGES, axis_theorems.PLACES, strict=True
    ):
        signs = np.array(np.meshgrid(*[(-1, 1)] * 3)).reshape(3, -1).T
        points.append(np.array(place) + signs * np.array(edges) / 2 / np.sqrt(3))
        masses += [mass / 8] * 8
    found = inertia.of_points(masses, np.vstack(points))
    assert found == pytest.approx(ONE.bodies[0].inertia_array, rel=1e-14, abs=1e-17)
    assert inertia.centre_of(masses, np.vstack(points)) == pytest.approx(np.zeros(3), abs=1e-16)


def test_the_cube_about_its_corner_is_2_11_11():
    cube = CORNER.bodies[0]
    tensor = inertia.about_point(cube.inertia_array, cube.mass, cube.center_of_mass)
    unit = axis_theorems.CUBE * axis_theorems.EDGE**2 / 12
    assert tensor / unit == pytest.approx(np.array([[8, -3, -3], [-3, 8, -3], [-3, -3, 8]]), rel=1e-14)
    assert inertia.principal(tensor)[0] / unit == pytest.approx([2.0, 11.0, 11.0], rel=1e-14)


def test_a_face_of_the_cube_obeys_the_perpendicular_axes():
    edge = axis_theorems.EDGE
    face = inertia.lamina(np.diag([edge**2 / 12, edge**2 / 12]))
    stacked = face + np.diag([edge**2 / 12, edge**2 / 12, 0.0])
    assert axis_theorems.CUBE * stacked == pytest.approx(CORNER.bodies[0].inertia_array, rel=1e-14)


def test_omega_goes_round_the_diagonal_at_the_rate_of_the_books(own_rate):
    (rate,) = (o for o in CORNER.observables if o.name == "Omega_b")
    expected = (2 - 11) / 11 * sum(CORNER.v0) / np.sqrt(3)
    assert rate.scale(CORNER, None) == pytest.approx(abs(expected), rel=1e-14)
    assert abs(own_rate(CORNER, "Omega_b")) == pytest.approx(abs(expected), rel=1e-12)


def test_an_engine_that_drops_the_products_of_inertia_is_found_by_turned_axes_alone(failed, as_if):
    engine = as_if(lambda body: np.diag(np.diag(body.inertia_array)))
    assert {("truth", "orientation, limit"), ("invariant", "energy")} <= failed(engine, ROTATED)
    assert not failed(engine, ONE, duration=0.32)


@pytest.mark.parametrize("scene", [WELDED, OFFSET], ids=["welded", "offset"])
def test_an_engine_that_counts_a_displacement_twice_is_found_off_the_centre_alone(failed, as_if, scene):
    def twice(body):
        return inertia.about_point(body.inertia_array, body.mass, body.center_of_mass)

    assert ("truth", "orientation, limit") in failed(as_if(twice), scene)
    assert not failed(as_if(twice), ONE, duration=0.32)
