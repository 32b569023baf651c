"""What is looked at in a motion, and how far one motion is from another in it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from ..reference import quaternions
from ..reference.checked import Array
from . import mechanics
from .trajectory import Trajectory

if TYPE_CHECKING:
    from .scene import Scene

Kind = Literal["state", "rate", "invariant"]


@dataclass(frozen=True)
class Observable:
    """One quantity in which a motion is compared with another.

    ``difference(scene, a, b)`` gives its signed components (n, k), ``a`` minus ``b``, in ``unit``,
    one row a sample; a rate, measured over the whole run, has one row. ``scale(scene, b)`` is the
    size [``unit``] against which round-off is measured. A ``state`` is part of the motion itself, a
    ``rate`` is a number fitted to it, of which ``exact(scene)`` is the closed form, an ``invariant`` must
    keep the value it began with; ``always`` says that every scheme keeps it, if any does.
    """

    name: str
    unit: str
    kind: Kind
    difference: Callable[[Scene, Trajectory, Trajectory], Array]
    scale: Callable[[Scene, Trajectory], float]
    exact: Callable[[Scene], float] | None = None
    always: bool = False

    def distance(self, scene: Scene, a: Trajectory, b: Trajectory) -> Array:
        """Length of the difference at each sample, (n,), or (1,) for a rate."""
        return np.asarray(np.linalg.norm(self.difference(scene, a, b), axis=1), dtype=np.float64)


def orientation() -> Observable:
    """Rotation vector from ``b``'s attitude to ``a``'s, per body; its length is the geodesic angle."""

    def difference(scene: Scene, a: Trajectory, b: Trajectory) -> Array:
        turn = quaternions.product(quaternions.conjugate(b.quaternion), a.quaternion)
        return quaternions.rotation_vector(turn).reshape(len(a.t), -1)

    def scale(scene: Scene, b: Trajectory) -> float:
        # A hinge's angle counts whole turns, and is rounded as so large a number; the attitude inherits it.
        hinges = [joint.kind == "hinge" for joint in scene.scalar_joints]
        return max(1.0, float(np.abs(b.joint_position[:, hinges]).max(initial=0.0)))

    return Observable("orientation", "rad", "state", difference, scale)


def _state(name: str, unit: str) -> Observable:
    def difference(scene: Scene, a: Trajectory, b: Trajectory) -> Array:
        n = len(a.t)
        return np.asarray((getattr(a, name) - getattr(b, name)).reshape(n, -1), dtype=np.float64)

    def scale(scene: Scene, b: Trajectory) -> float:
        array = getattr(b, name).reshape(len(b.t), -1)
        return float(np.max(np.linalg.norm(array, axis=1)))

    return Observable(name, unit, "state", difference, scale)


def omega() -> Observable:
    """Angular velocity in body axes."""
    return _state("omega", "rad/s")


def position() -> Observable:
    """Centres of mass in world axes."""
    return _state("position", "m")


def velocity() -> Observable:
    """Velocities of the centres of mass in world axes."""
    return _state("velocity", "m/s")


def rate(
    name: str,
    signal: Callable[[Scene, Trajectory], Array],
    exact: Callable[[Scene], float],
) -> Observable:
    """How fast the phase of a complex ``signal`` (n,) turns, against its closed form ``exact``.

    The phase is followed relative to that of the truth, whose mean rate is ``exact``: what is
    fitted is a small slowly growing angle, so neither the shape of the signal nor the spacing of
    the samples limits it. A test of each scene holds the truth's own phase against ``exact``.
    """

    def difference(scene: Scene, a: Trajectory, b: Trajectory) -> Array:
        relative = np.unwrap(np.angle(signal(scene, a) * np.conj(signal(scene, b))))
        centred = a.t - a.t.mean()
        return np.array([[centred @ relative / (centred @ centred)]])

    return Observable(name, "rad/s", "rate", difference, lambda scene, b: abs(exact(scene)), exact)


def fitted(
    name: str,
    unit: str,
    value: Callable[[Scene, Trajectory], float],
    exact: Callable[[Scene], float],
) -> Observable:
    """One number that ``value`` takes from a whole motion, against what it takes from the exact one.

    Both are taken from the same samples in the same way, so that what the fit itself is off cancels.
    A test of each scene holds what the fit makes of the truth against the closed form ``exact``.
    """

    def difference(scene: Scene, a: Trajectory, b: Trajectory) -> Array:
        return np.array([[value(scene, a) - value(scene, b)]])

    return Observable(name, unit, "rate", difference, lambda scene, b: abs(exact(scene)), exact)


def invariant(
    name: str,
    unit: str,
    compute: Callable[[Scene, Trajectory], Array],
    scale: Callable[[Scene, Trajectory], float],
    always: bool = False,
) -> Observable:
    """What ``compute`` gives, (n, …), which must stay as it is at the start of the exact motion."""

    def difference(scene: Scene, a: Trajectory, b: Trajectory) -> Array:
        n = len(a.t)
        return np.asarray(compute(scene, a).reshape(n, -1) - compute(scene, b).reshape(n, -1)[0])

    return Observable(name, unit, "invariant", difference, scale, always=always)


def energy() -> Observable:
    """Kinetic and potential energy, computed from the states."""
    return invariant(
        "energy", "J", mechanics.energy, lambda scene, b: float(np.max(mechanics.kinetic_energy(scene, b)))
    )


def angular_momentum() -> Observable:
    """Angular momentum about the world's origin, all three components, world axes."""
    return invariant(
        "angular momentum", "kg m²/s", mechanics.angular_momentum_world, mechanics.angular_momentum_scale
    )


def vertical_angular_momentum() -> Observable:
    """The component of the angular momentum along z: p_α of a top about its fixed point."""
    return invariant(
        "p_alpha",
        "kg m²/s",
        lambda scene, a: mechanics.angular_momentum_world(scene, a)[:, 2],
        mechanics.angular_momentum_scale,
    )


def axial_angular_momentum(body: int = 0) -> Observable:
    """I3 ω3 of a body: p_γ of a symmetric top."""
    return invariant(
        "p_gamma",
        "kg m²/s",
        lambda scene, a: scene.bodies[body].inertia_array[2, 2] * a.omega[:, body, 2],
        mechanics.angular_momentum_scale,
    )


def momentum() -> Observable:
    """Linear momentum of all bodies, world axes."""
    return invariant("momentum", "kg m/s", mechanics.momentum, mechanics.momentum_scale, always=True)


def unit_norm() -> Observable:
    """Norm of the quaternions, which must stay 1."""
    return invariant(
        "quaternion norm",
        "1",
        lambda scene, a: np.linalg.norm(a.quaternion, axis=2),
        lambda scene, b: 1.0,
        always=True,
    )


def attitude() -> Observable:
    """Axes of bodies that cannot turn, in world axes."""

    def axes(scene: Scene, a: Trajectory) -> Array:
        return np.stack([quaternions.rotated(a.quaternion, axis) for axis in np.eye(3)], axis=2)

    return invariant("attitude", "1", axes, lambda scene, b: 1.0, always=True)


def turning() -> Observable:
    """Angular velocity of bodies that cannot turn; its round-off is that of one turn in the whole run."""
    return invariant(
        "turning",
        "rad/s",
        lambda scene, a: a.omega,
        lambda scene, b: 2 * np.pi / scene.duration,
        always=True,
    )
