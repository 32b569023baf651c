"""Bodies that each hang on a hinge of their own from the world: their motion, from the hinges' angles."""

from collections.abc import Sequence

import numpy as np

from ..reference import quaternions
from ..reference.checked import Array
from .body import Body
from .observables import Observable, invariant
from .scene import Scene
from .trajectory import Trajectory


def motion(bodies: Sequence[Body], t: Array, angle: Array, rate: Array) -> Trajectory:
    """Motion of ``bodies`` at times ``t`` (n,) [s], whose hinges are at ``angle`` (n, b) with ``rate``.

    [rad, rad/s]; each body has one hinge, whose parent is the world.
    """
    axes, arms = _axes(bodies), np.array([body.center_of_mass for body in bodies])
    q, omega = _turned(bodies, angle), rate[..., None] * axes
    position = np.array([body.position for body in bodies]) + quaternions.rotated(q, arms)
    velocity = quaternions.rotated(q, np.cross(omega, arms))
    return Trajectory(t, position, q, velocity, omega, angle, rate)


def angle() -> Observable:
    """The hinges' angles, whole turns kept."""
    return Observable(
        "hinge angle",
        "rad",
        "state",
        lambda scene, a, b: np.asarray(a.joint_position - b.joint_position),
        lambda scene, b: float(np.abs(b.joint_position).max()),
    )


def residual() -> Observable:
    """What attitudes and ω differ from those that the hinges' whole angles and rates make."""

    def apart(scene: Scene, motion: Trajectory) -> Array:
        turn = _turned(scene.bodies, motion.joint_position)
        attitude = quaternions.product(quaternions.conjugate(turn), motion.quaternion)
        spin = motion.omega - motion.joint_velocity[..., None] * _axes(scene.bodies)
        return np.concatenate([quaternions.rotation_vector(attitude), spin], axis=2)

    return invariant("hinge residual", "1", apart, lambda scene, b: float(np.abs(b.omega).max()))


def centre_residual() -> Observable:
    """What centres of mass and their velocities differ from those that the hinges' angles and rates make."""

    def apart(scene: Scene, a: Trajectory) -> Array:
        made = motion(scene.bodies, a.t, a.joint_position, a.joint_velocity)
        return np.concatenate([a.position - made.position, a.velocity - made.velocity], axis=2)

    return invariant("centre residual", "m, m/s", apart, lambda scene, b: float(np.abs(b.position).max()))


def _axes(bodies: Sequence[Body]) -> Array:
    return np.array([body.joints[0].axis for body in bodies])


def _turned(bodies: Sequence[Body], angle: Array) -> Array:
    at_zero = np.array([body.quaternion for body in bodies])
    turn = quaternions.from_rotation_vector(angle[..., None] * _axes(bodies))
    return quaternions.product(np.broadcast_to(at_zero, turn.shape), turn)
