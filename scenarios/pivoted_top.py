"""A symmetric top with one point fixed, under gravity: its exact motion, and what its axis does."""

import numpy as np

from ..reference import heavy_top
from ..reference.checked import Array
from .body import Body, Joint, diagonal
from .scene import Scene
from .trajectory import Trajectory, about_fixed_point

#: Mass, length, moments about the fixed point, gravity, attitude and ω: what the reference asks for.
Arguments = tuple[float, float, tuple[float, float], float, tuple[float, ...], tuple[float, ...]]


def top(mass: float, length: float, I1: float, I3: float) -> Body:
    """A top on a ball joint, its centre of mass at ``length`` [m] along e3.

    ``mass`` [kg]; ``I1`` and ``I3`` [kg m²] about the fixed point.
    """
    about_center = diagonal(I1 - mass * length**2, I1 - mass * length**2, I3)
    return Body("top", mass, about_center, (Joint("pivot", "ball"),), center_of_mass=(0.0, 0.0, length))


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
