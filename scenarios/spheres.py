"""Spheres in free flight that do not turn: whatever pulls at their centres leaves their attitudes alone."""

from typing import TypedDict

import numpy as np
import numpy.typing as npt

from ..reference import quaternions
from ..reference.checked import Array
from .body import Body, Joint, diagonal
from .scene import Scene
from .trajectory import Trajectory


class Spheres(TypedDict):
    """The fields of a ``Scene`` that speak of its bodies."""

    bodies: tuple[Body, ...]
    q0: tuple[float, ...]
    v0: tuple[float, ...]


def spheres(masses: dict[str, float], places: npt.ArrayLike, velocities: npt.ArrayLike) -> Spheres:
    """Spheres of these ``masses`` [kg] by name, at ``places`` (b, 3) [m] with ``velocities`` (b, 3) [m/s].

    Each has a radius of 1 m and an attitude of its own: a force along body axes would show.
    """
    # Not at random, for which a listing of scenes would have to load what makes random numbers.
    turns = np.sin(np.arange(1.0, 4 * len(masses) + 1)).reshape(-1, 4)
    turns /= np.linalg.norm(turns, axis=1, keepdims=True)
    bodies = (
        Body(name, m, diagonal(*(0.4 * m,) * 3), (Joint(f"{name} flies", "free"),))
        for name, m in masses.items()
    )
    return {
        "bodies": tuple(bodies),
        "q0": tuple(np.column_stack([np.asarray(places), turns]).ravel().tolist()),
        "v0": tuple(np.column_stack([np.asarray(velocities), np.zeros((len(masses), 3))]).ravel().tolist()),
    }


def start(scene: Scene) -> tuple[Array, Array]:
    """Places and velocities (b, 3) of the centres at the start [m], [m/s]."""
    return np.reshape(scene.q0, (-1, 7))[:, :3], np.reshape(scene.v0, (-1, 6))[:, :3]


def flying(scene: Scene, t: Array, position: Array, velocity: Array) -> Trajectory:
    """The motion of spheres whose centres are at ``position`` (n, b, 3) with ``velocity`` (n, b, 3).

    They turn if the scene's start says so: a kick to their spin is followed.
    """
    attitude, omega = np.reshape(scene.q0, (-1, 7))[:, 3:], np.reshape(scene.v0, (-1, 6))[:, 3:]
    turned = quaternions.product(attitude, quaternions.from_rotation_vector(t[:, None, None] * omega))
    none = np.empty((len(t), 0))
    return Trajectory(t, position, turned, velocity, np.broadcast_to(omega, position.shape), none, none)
