"""The URDF for PyBullet: principal axes, angles that lose nothing, trees and their links."""

import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from poinsot.adapters.pybullet_urdf import principal_axes, roll_pitch_yaw, trees, urdf
from poinsot.scenarios.body import Body, Joint, diagonal
from scipy.spatial.transform import Rotation

ANGLES = st.floats(-np.pi, np.pi)


def rotation(roll, pitch, yaw):
    return (Rotation.from_rotvec([0, 0, yaw]) * Rotation.from_rotvec([0, pitch, 0])).as_matrix() @ (
        Rotation.from_rotvec([roll, 0, 0]).as_matrix()
    )


@given(ANGLES, ANGLES, ANGLES)
def test_angles_give_the_rotation_back(roll, pitch, yaw):
    axes = rotation(roll, pitch, yaw)
    # Six products of numbers up to 1, and the rounding of the angles themselves.
    np.testing.assert_allclose(rotation(*roll_pitch_yaw(axes)), axes, atol=2e-15)


@pytest.mark.parametrize("pitch", [np.pi / 2, -np.pi / 2])
@pytest.mark.parametrize("off", [0.0, 1e-16, 1e-12, 1e-9, 1e-8, 1e-6, 1e-3])
def test_angles_lose_nothing_where_the_pitch_is_upright(pitch, off):
    for roll, yaw in np.random.default_rng(1).uniform(-3, 3, (50, 2)):
        axes = rotation(roll, pitch + off, yaw)
        np.testing.assert_allclose(rotation(*roll_pitch_yaw(axes)), axes, atol=2e-15)


@given(st.lists(st.floats(0.5, 1), min_size=3, max_size=3), ANGLES, ANGLES, ANGLES)
def test_principal_axes_are_a_rotation_and_give_the_tensor_back(moments, roll, pitch, yaw):
    axes = rotation(roll, pitch, yaw)
    tensor = axes @ np.diag(moments) @ axes.T
    tensor = (tensor + tensor.T) / 2
    found, turn = principal_axes(tensor)
    np.testing.assert_allclose(turn @ turn.T, np.eye(3), atol=2e-15)
    assert np.linalg.det(turn) == pytest.approx(1.0)
    np.testing.assert_allclose(turn @ np.diag(found) @ turn.T, tensor, atol=3e-15)


def test_a_diagonal_tensor_is_left_as_it_is():
    moments, axes = principal_axes(np.diag([3.0, 2.0, 4.0]))
    assert moments.tolist() == [3.0, 2.0, 4.0]
    assert axes.tolist() == np.eye(3).tolist()


@given(st.floats(1e-9, 1e9), st.floats(1e-9, 1e9))
def test_no_moment_is_beyond_the_sum_of_the_others(a, b):
    moments, _ = principal_axes(np.diag([a, b, np.nextafter(a + b, np.inf)]))
    x, y, z = sorted(moments.tolist())
    assert z <= x + y
    assert z == pytest.approx(a + b, rel=1e-15)


@pytest.fixture
def forest(scene_of):
    """Two trees, listed one through the other."""

    def body(name, parent, *kinds, **place):
        joints = tuple(
            Joint(f"{name} {kind}", kind, (0.0, 0.6, 0.8), damping=0.125 * (kind == "hinge"))
            for kind in kinds
        )
        return Body(name, 0.1, diagonal(0.1, 0.2, 0.25), joints, parent=parent, **place)

    bodies = [
        body("a", None, "free"),
        body("b", None, "hinge", position=(0.1, 0.2, 0.3), quaternion=(0.5, 0.5, 0.5, 0.5)),
        body("c", "a", "slide", "ball"),
        body("d", "b"),
    ]
    return scene_of(bodies, [0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1], [0] * 11)


def test_trees_are_told_apart(forest):
    assert trees(forest) == [[0, 2], [1, 3]]


def test_a_free_body_is_the_base_of_its_tree(forest):
    robot = ElementTree.fromstring(urdf(forest, [0, 2]))
    assert {link.get("name") for link in robot.findall("link")} == {"0 a", "2 c 0", "2 c"}
    joints = [
        (j.get("name"), j.get("type"), *(part.get("link") for part in list(j)[:2]))
        for j in robot.iter("joint")
    ]
    assert joints == [
        ("joint 2.0", "prismatic", "0 a", "2 c 0"),
        ("joint 2.1", "spherical", "2 c 0", "2 c"),
    ]
    assert [float(mass.get("value")) for mass in robot.iter("mass")] == [0.1, 0.1, 0.0]


def test_every_digit_is_written(forest):
    robot = ElementTree.fromstring(urdf(forest, [1, 3]))
    hinge, weld = robot.iter("joint")
    assert (hinge.get("type"), weld.get("type")) == ("continuous", "fixed")
    origin, axis, dynamics = (hinge.find(name) for name in ("origin", "axis", "dynamics"))
    assert [float(x) for x in origin.get("xyz").split()] == [0.1, 0.2, 0.3]
    turn = rotation(*(float(x) for x in origin.get("rpy").split()))
    np.testing.assert_allclose(turn, Rotation.from_quat([0.5, 0.5, 0.5, 0.5]).as_matrix(), atol=1e-15)
    assert [float(x) for x in axis.get("xyz").split()] == [0.0, 0.6, 0.8]
    assert float(dynamics.get("damping")) == 0.125


def test_no_line_is_longer_than_pybullet_reads(scene_of):
    bodies = [Body("b" * 9000, 1.0, diagonal(1, 1, 1), (Joint("j" * 9000, "hinge"),))]
    assert max(map(len, urdf(scene_of(bodies, [0], [0]), [0]).splitlines())) < 1000
