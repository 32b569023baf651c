"""A symmetric top with one point fixed, under gravity: its exact motion, and what its axis does."""

from functools import cache

import numpy as np

from ..reference import heavy_top, heavy_top_rates
from ..reference.checked import Array
from .body import Body, Joint, diagonal
from .scene import Scene
from .trajectory import Trajectory, about_fixed_point

#: Mass, length, moments about the fixed point, gravity, attitude and ω: what the reference asks for.
Arguments = tuple[float, float, tuple[float, float], float, tuple[float, ...], tuple[float, ...]]


def top(mass: float, length: float, I1: float, I3: float, name: str = "top") -> Body:
    """A top on a ball joint, its centre of mass at ``length`` [m] along e3.

    ``mass`` [kg]; ``I1`` and ``I3`` [kg m²] about the fixed point.
    """
    about_center = diagonal(I1 - mass * length**2, I1 - mass * length**2, I3)
    return Body(name, mass, about_center, (Joint("pivot", "ball"),), center_of_mass=(0.0, 0.0, length))


def arguments(scene: Scene) -> Arguments:
    """What the reference's functions of a heavy top ask for."""
    body = scene.bodies[0]
    length = body.center_of_mass[2]
    moments = (body.inertia[0][0] + body.mass * length**2, body.inertia[2][2])
    return body.mass, length, moments, -scene.gravity[2], scene.q0, scene.v0


def truth(scene: Scene, t: Array) -> Trajectory:
    """Motion of the scene's one body at the times ``t`` (n,) [s]."""
    q, omega = heavy_top.motion(*arguments(scene), t)
    return about_fixed_point(t, np.array(scene.bodies[0].center_of_mass), q, omega)


def from_above(scene: Scene, motion: Trajectory) -> Array:
    """The centre of mass as complex numbers x + iy (n,) [m]: their phase is the azimuth of the axis."""
    x, y, _ = motion.position[:, 0].T
    return np.asarray(x + 1j * y)


def tilt(scene: Scene, motion: Trajectory) -> Array:
    """Angle (n,) [rad] between the axis and the vertical."""
    return np.arctan2(np.abs(from_above(scene, motion)), motion.position[:, 0, 2])


@cache
def mean_precession(scene: Scene) -> float:
    """Mean rate of the azimuth [rad/s]."""
    return heavy_top_rates.mean_precession(*arguments(scene))


@cache
def nutation_frequency(scene: Scene) -> float:
    """Nods of 2π a second [rad/s]."""
    return 2 * np.pi / heavy_top_rates.nutation_period(*arguments(scene))


def nutating(scene: Scene, motion: Trajectory) -> Array:
    """Height about its mean, and its speed over the nutation frequency: a circle (n,), if a dented one."""
    length = scene.bodies[0].center_of_mass[2]
    lowest, highest, *_ = heavy_top_rates.turning_points(*arguments(scene))
    height = motion.position[:, 0, 2] - length * (lowest + highest) / 2
    return np.asarray(height - 1j * motion.velocity[:, 0, 2] / nutation_frequency(scene))
