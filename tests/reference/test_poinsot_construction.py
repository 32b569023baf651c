"""Poinsot's construction: the ellipsoid rolls on the plane without slipping."""

import numpy as np
import pytest
from poinsot.reference import quaternions
from poinsot.reference.errors import InputError
from poinsot.reference.poinsot_construction import (
    contact_point,
    curves,
    herpolhode_radii,
    plane_distance,
    semiaxes,
)
from poinsot.reference.wobble import flip_period

MOMENTS = np.array([1.0, 2.0, 2.5])
Q0 = np.array([0.1, -0.5, 0.7, 0.5])
STARTS = [np.array([0.5, 0.7, 2.0]), np.array([-2.0, 0.3, 0.4]), np.array([0.01, -2.0, 0.0])]

# A dozen roundings.
ROUNDING = 4e-15


def angular_momentum(omega0):
    return quaternions.rotated(Q0, MOMENTS * omega0)


def test_semiaxes_end_on_the_ellipsoid():
    assert np.allclose(MOMENTS * semiaxes(MOMENTS) ** 2, 1.0, rtol=4e-16)


@pytest.mark.parametrize("omega0", STARTS)
def test_the_contact_point_is_on_the_ellipsoid_and_on_the_plane(omega0):
    t = np.linspace(-20, 30, 101)
    rho, rho_world = curves(MOMENTS, Q0, omega0, t)
    assert np.abs(np.sum(MOMENTS * rho**2, axis=-1) - 1).max() < ROUNDING
    L = angular_momentum(omega0)
    distance = plane_distance(MOMENTS, omega0)
    assert np.abs(rho_world @ L / np.linalg.norm(L) - distance).max() < ROUNDING
    two_T = np.sum(MOMENTS * omega0**2)
    assert abs(distance - np.sqrt(two_T) / np.linalg.norm(L)) < ROUNDING
    assert np.abs(contact_point(MOMENTS, omega0) - omega0 / np.sqrt(two_T)).max() < ROUNDING


@pytest.mark.parametrize("omega0", STARTS)
def test_the_ellipsoid_touches_the_plane_there(omega0):
    """Its normal, the gradient 2Iρ turned into world axes, is along L."""
    q0_rho, _ = curves(MOMENTS, Q0, omega0, [0.0])
    L = angular_momentum(omega0)
    normal = quaternions.rotated(Q0, MOMENTS * q0_rho[0])
    assert np.abs(np.cross(normal, L)).max() < ROUNDING * np.linalg.norm(L)


@pytest.mark.parametrize("omega0", STARTS)
def test_it_rolls_without_slipping(omega0):
    """The point of contact moves as fast over the ellipsoid as over the plane: dρ/dt alike in both axes."""
    step = 1e-5
    q, _ = Q0, None
    rho, rho_world = curves(MOMENTS, Q0, omega0, [-step, step])
    body = quaternions.rotated(q, (rho[1] - rho[0]) / (2 * step))
    world = (rho_world[1] - rho_world[0]) / (2 * step)
    # Central differences of step 1e-5.
    assert np.abs(body - world).max() < 1e-9


@pytest.mark.parametrize("omega0", STARTS[:2])
def test_the_polhode_closes_and_the_herpolhode_does_not(omega0):
    period = flip_period(MOMENTS, omega0)
    rho, rho_world = curves(MOMENTS, Q0, omega0, [0.0, period])
    assert np.abs(rho[1] - rho[0]).max() < ROUNDING
    assert np.abs(rho_world[1] - rho_world[0]).max() > 1e-2


@pytest.mark.parametrize("omega0", STARTS)
def test_the_herpolhode_runs_between_its_two_radii(omega0):
    period = flip_period(MOMENTS, omega0)
    _, rho_world = curves(MOMENTS, Q0, omega0, np.linspace(0, period, 20001))
    along = angular_momentum(omega0) / np.linalg.norm(angular_momentum(omega0))
    radius = np.linalg.norm(np.cross(rho_world, along), axis=-1)
    low, high = herpolhode_radii(MOMENTS, omega0)
    assert 0 < low < high
    # Sampled extremes are off by the square of the sampling step.
    assert abs(radius.min() - low) < 1e-6
    assert abs(radius.max() - high) < 1e-6
    assert radius.min() >= low - ROUNDING
    assert radius.max() <= high + ROUNDING


@pytest.mark.parametrize("moments", [[2.0, 2.0, 1.0], [1.0, 2.0, 2.0], [2.0, 1.5, 2.0]])
def test_both_curves_are_circles_for_a_symmetric_top(moments):
    omega0 = np.array([1.0, 0.5, 2.0])
    low, high = herpolhode_radii(moments, omega0)
    assert abs(low - high) < ROUNDING
    _, rho_world = curves(moments, Q0, omega0, np.linspace(0, 5, 11))
    L = quaternions.rotated(Q0, moments * omega0)
    radius = np.linalg.norm(np.cross(rho_world, L / np.linalg.norm(L)), axis=-1)
    assert np.abs(radius - low).max() < ROUNDING


def test_the_herpolhode_of_a_steady_spin_is_a_point_and_on_the_separatrix_a_spiral():
    assert herpolhode_radii(MOMENTS, [0.0, 2.0, 0.0]) == (0.0, 0.0)
    low, high = herpolhode_radii([1.0, 2.0, 2.25], [3.0, 0.0, 4.0])
    assert low == 0.0
    # n1² n3² (1/I1 − 1/I3)² over 2T/L² with n = (3, 0, 9)/√90, L² = 90, 2T = 45: all at the start.
    assert abs(high - np.sqrt(0.1 * 0.9 * (1 - 1 / 2.25) ** 2 / 0.5)) < ROUNDING


def test_bad_input_is_refused():
    for call in (
        lambda: contact_point(MOMENTS, [0.0, 0.0, 0.0]),
        lambda: contact_point(MOMENTS, [[1.0, 0.0, 0.0], [0.0, 0.0, 0.0]]),
        lambda: contact_point(MOMENTS, [1.0, 0.0]),
        lambda: contact_point(MOMENTS, 1.0),
        lambda: contact_point([1.0, 2.0, 4.0], [1.0, 0.0, 0.0]),
        lambda: plane_distance(MOMENTS, [[1.0, 0.0, 0.0]]),
        lambda: semiaxes([1.0, 2.0, 4.0]),
        lambda: herpolhode_radii([1.0, 2.0, 4.0], [1.0, 0.0, 0.0]),
        lambda: curves(MOMENTS, Q0, [0.0, 0.0, 0.0], [0.0]),
    ):
        with pytest.raises(InputError, match="got"):
            call()
