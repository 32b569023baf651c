"""Rigid bodies that nothing turns: their exact motion, whatever their tensors and wherever their centres."""

import numpy as np

from ..reference import inertia, quaternions, torque_free
from ..reference.checked import Array
from .body import Body, Vector
from .scene import Scene
from .trajectory import Trajectory


def truth(scene: Scene, t: Array) -> Trajectory:
    """Motion of the scene's bodies, each on a free joint, at the times ``t`` (n,) [s]; they may fall."""
    q0, v0 = np.array(scene.q0), np.array(scene.v0)
    flights = [_flight(body, q0[q], v0[v], scene.gravity, t) for body, _, q, v in scene.slices()]
    position, q, velocity, omega = (np.stack(part, axis=1) for part in zip(*flights, strict=True))
    none = np.empty((len(t), 0))
    return Trajectory(t, position, q, velocity, omega, none, none)


def _flight(body: Body, q0: Array, v0: Array, gravity: Vector, t: Array) -> tuple[Array, Array, Array, Array]:
    q, omega = turning(body.inertia_array, q0[3:], v0[3:], t)
    centre = np.array(body.center_of_mass)
    velocity = v0[:3] + quaternions.rotated(q0[3:], np.cross(v0[3:], centre))
    fallen = np.outer(t, gravity)
    position = q0[:3] + quaternions.rotated(q0[3:], centre) + t[:, None] * (velocity + fallen / 2)
    return position, q, velocity + fallen, omega


def turning(tensor: Array, q0: Array, omega0: Array, t: Array) -> tuple[Array, Array]:
    """Attitude (n, 4) and ω (n, 3) in body axes [rad/s] of a body that no torque acts on.

    ``tensor`` (3, 3) [kg m²]: inertia about the fixed point or centre, in body axes, diagonal or not.
    """
    if np.array_equal(tensor, np.diag(np.diag(tensor))):
        return torque_free.motion(np.diag(tensor), q0, omega0, t)
    moments, axes = inertia.principal(tensor)
    turn = quaternions.from_matrix(axes)
    back = quaternions.conjugate(turn)
    q, omega = torque_free.motion(
        moments, quaternions.product(q0, turn), quaternions.rotated(back, omega0), t
    )
    return quaternions.product(q, back), quaternions.rotated(turn, omega)


def circled_axis(scene: Scene) -> int:
    """The body axis that L circles: of the largest moment if L² > 2T·I2, else of the smallest."""
    moments, omega = np.diag(scene.bodies[0].inertia_array), np.array(scene.v0[-3:])
    beyond = moments @ (omega**2 * (moments - np.median(moments)))
    return int(np.argmax(moments) if beyond > 0 else np.argmin(moments))


def around_axis(scene: Scene, vectors: Array) -> Array:
    """Body ``vectors`` (n, 3) seen along the axis that L circles: as complex numbers (n,).

    The phase of those of ω turns by 2π in one round of the polhode.
    """
    axis = circled_axis(scene)
    return np.asarray(vectors[:, (axis + 1) % 3] + 1j * vectors[:, (axis + 2) % 3])


def around_momentum(scene: Scene, vectors: Array) -> Array:
    """World ``vectors`` (n, 3) seen along the L that the body starts with: as complex numbers (n,).

    Their phase turns as the vectors go round L, in the sense of L.
    """
    along = momentum_direction(scene)
    across = np.cross(along, np.eye(3)[int(np.argmin(np.abs(along)))])
    across /= np.linalg.norm(across)
    return np.asarray(vectors @ across + 1j * (vectors @ np.cross(along, across)))


def momentum_direction(scene: Scene) -> Array:
    """L/|L| (3,) of the body's spin at the start, world axes: where it points for ever."""
    spin = scene.bodies[0].inertia_array @ np.array(scene.v0[-3:])
    return quaternions.rotated(np.array(scene.q0[-4:]), spin / np.linalg.norm(spin))
