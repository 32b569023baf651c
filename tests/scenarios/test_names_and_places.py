"""What engines would silently read in different ways is refused before any of them sees it."""

import re

import pytest
from poinsot.reference.errors import InputError
from poinsot.scenarios.body import Body, Joint, diagonal
from poinsot.scenarios.scene import Scene

MOMENTS = diagonal(1.0, 1.0, 1.0)


def scene(*bodies, q0=(0.0,), v0=(0.0,)):
    return Scene("s", "", "", bodies, q0, v0, 1.0, 1, truth=None, observables=())


@pytest.mark.parametrize("place", [{"position": (1.0, 0.0, 0.0)}, {"quaternion": (0.0, 0.6, 0.0, 0.8)}])
def test_a_free_body_has_no_place_but_its_coordinates(place):
    with pytest.raises(InputError, match="coordinates of its free joint say where it is"):
        Body("top", 1.0, MOMENTS, (Joint("free", "free"),), **place)


def test_a_free_body_without_a_place_is_fine():
    assert Body("top", 1.0, MOMENTS, (Joint("free", "free"),)).position == (0.0, 0.0, 0.0)


def test_joints_of_two_bodies_may_not_share_a_name():
    first = Body("a", 1.0, MOMENTS, (Joint("hinge", "hinge"),))
    second = Body("b", 1.0, MOMENTS, (Joint("hinge", "hinge"),))
    with pytest.raises(InputError, match=re.escape("joints: got the names ['hinge', 'hinge']")):
        scene(first, second, q0=(0.0, 0.0), v0=(0.0, 0.0))
