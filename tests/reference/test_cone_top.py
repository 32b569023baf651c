"""The cone on its tip against the cone about its centre, and against a sum over its slices."""

import math

import numpy as np
import pytest
from poinsot.reference import cone_top
from poinsot.reference.errors import InputError
from poinsot.reference.inertia import about_point
from poinsot.reference.inertia_of_shapes import cone


def test_the_moments_are_the_books():
    """Taylor, example 10.3: with M = 20/3 they are R² + 4h² and 2R²."""
    assert cone_top.moments(20 / 3, 2.0, 3.0) == pytest.approx((40, 8), rel=1e-15)
    assert cone_top.length(8.0) == 6.0


def test_they_are_those_about_the_centre_carried_to_the_tip():
    mass, radius, height = 1.7, 0.4, 0.9
    solid = cone(radius, height)
    tensor = about_point(mass * solid.inertia, mass, solid.centre)
    I1, I3 = cone_top.moments(mass, radius, height)
    assert np.allclose(tensor, np.diag([I1, I1, I3]), rtol=1e-14, atol=1e-16)
    assert cone_top.length(height) == pytest.approx(solid.centre[2], rel=1e-15)


def test_they_are_the_sum_over_discs():
    """Discs of radius Rz/h: dI3 = ½ r² dm, dI1 = (¼ r² + z²) dm, dm = 3Mz²dz/h³; Gauss's rule is exact."""
    mass, radius, height = 1.7, 0.4, 0.9
    nodes, weights = np.polynomial.legendre.leggauss(4)
    z = height * (nodes + 1) / 2
    dm = 3 * mass * z**2 / height**3 * weights * height / 2
    r = radius * z / height
    I1, I3 = cone_top.moments(mass, radius, height)
    assert math.isclose(I3, np.sum(r**2 / 2 * dm), rel_tol=1e-14)
    assert math.isclose(I1, np.sum((r**2 / 4 + z**2) * dm), rel_tol=1e-14)
    assert math.isclose(cone_top.length(height) * mass, np.sum(z * dm), rel_tol=1e-14)


@pytest.mark.parametrize("arguments", [(0, 1, 1), (1, -1, 1), (1, 1, 0), (1, 1, math.nan)])
def test_what_cannot_be_is_refused(arguments):
    with pytest.raises(InputError):
        cone_top.moments(*arguments)
    with pytest.raises(InputError, match="height"):
        cone_top.length(0)
