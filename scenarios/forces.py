"""Forces that act on bodies from outside their joints: each depends on where the bodies are and how fast.

A force acts at centres of mass, in world axes, and turns no body about its own. ``acting`` binds it to
the bodies once, so that a step pays for numbers alone; ``potential`` is the energy that it conserves.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import sqrt
from typing import Protocol

import numpy as np

from ..reference.checked import Array, finite, not_negative, positive
from ..reference.errors import InputError
from .body import Body, Vector

#: ``push(position, velocity, total)``: (b, 3) [m], [m/s]; adds to the forces ``total`` (b, 3) [N].
Push = Callable[[Array, Array, Array], None]


class Force(Protocol):
    """One force, or the forces of one kind on all bodies."""

    @property
    def needs_velocity(self) -> bool:
        """Whether it depends on velocities."""
        ...

    def acting(self, bodies: Sequence[Body]) -> Push:
        """What adds this force to others; raises ``InputError`` for a body that is not there."""
        ...

    def potential(self, bodies: Sequence[Body], position: Array) -> Array:
        """Energy (n,) [J] of bodies at ``position`` (n, b, 3) [m]; 0 for a force that does no work."""
        ...


def forces_on(bodies: Sequence[Body], forces: Sequence[Force]) -> Callable[[Array, Array], Array]:
    """All forces (b, 3) [N] on bodies at ``position`` (b, 3) [m] with ``velocity`` (b, 3) [m/s]."""
    pushes = [force.acting(bodies) for force in forces]

    def total(position: Array, velocity: Array) -> Array:
        result = np.zeros(position.shape)
        for push in pushes:
            push(position, velocity, result)
        return result

    return total


@dataclass(frozen=True)
class Constant:
    """The same ``force`` (3,) [N] on one body, for ever."""

    body: str
    force: Vector
    needs_velocity = False

    def __post_init__(self) -> None:
        finite(f"constant force on {self.body!r}", self.force, (3,))

    def acting(self, bodies: Sequence[Body]) -> Push:
        """See ``Force``."""
        at, force = _place(bodies, self.body), np.array(self.force)

        def push(position: Array, velocity: Array, total: Array) -> None:
            total[at] += force

        return push

    def potential(self, bodies: Sequence[Body], position: Array) -> Array:
        """See ``Force``."""
        return np.asarray(-position[:, _place(bodies, self.body)] @ np.array(self.force))


@dataclass(frozen=True)
class Spring:
    """A spring of this ``stiffness`` [N/m] between the centres of two bodies, slack at ``length`` [m]."""

    first: str
    second: str
    stiffness: float
    length: float = 0.0
    needs_velocity = False

    def __post_init__(self) -> None:
        positive("spring stiffness", self.stiffness)
        not_negative("spring length", self.length)

    def acting(self, bodies: Sequence[Body]) -> Push:
        """See ``Force``."""
        i, j = _place(bodies, self.first), _place(bodies, self.second)
        k, length = self.stiffness, self.length

        def push(position: Array, velocity: Array, total: Array) -> None:
            apart = position[j] - position[i]
            pull = apart * (k * (1 - length / sqrt(apart @ apart)) if length else k)
            total[i] += pull
            total[j] -= pull

        return push

    def potential(self, bodies: Sequence[Body], position: Array) -> Array:
        """See ``Force``."""
        stretch = _distance(bodies, self.first, self.second, position) - self.length
        return np.asarray(self.stiffness * stretch**2 / 2)


@dataclass(frozen=True)
class Attraction:
    """Newton's attraction between two bodies, ``G`` m1 m2/r²; ``G`` [m³/(kg s²)]."""

    first: str
    second: str
    G: float
    needs_velocity = False

    def __post_init__(self) -> None:
        positive("attraction G", self.G)

    def acting(self, bodies: Sequence[Body]) -> Push:
        """See ``Force``."""
        i, j = _place(bodies, self.first), _place(bodies, self.second)
        strength = self._strength(bodies)

        def push(position: Array, velocity: Array, total: Array) -> None:
            apart = position[j] - position[i]
            square = float(apart @ apart)
            pull = apart * (strength / (square * sqrt(square)))
            total[i] += pull
            total[j] -= pull

        return push

    def potential(self, bodies: Sequence[Body], position: Array) -> Array:
        """See ``Force``."""
        return np.asarray(-self._strength(bodies) / _distance(bodies, self.first, self.second, position))

    def _strength(self, bodies: Sequence[Body]) -> float:
        return self.G * bodies[_place(bodies, self.first)].mass * bodies[_place(bodies, self.second)].mass


@dataclass(frozen=True)
class Center:
    """Newton's attraction of every body to a fixed ``center`` (3,) [m]; ``GM`` [m³/s²]."""

    GM: float
    center: Vector = (0.0, 0.0, 0.0)
    needs_velocity = False

    def __post_init__(self) -> None:
        positive("center GM", self.GM)
        finite("center", self.center, (3,))

    def acting(self, bodies: Sequence[Body]) -> Push:
        """See ``Force``."""
        center, strength = np.array(self.center), -self.GM * _masses(bodies)

        def push(position: Array, velocity: Array, total: Array) -> None:
            from_center = position - center
            square = np.einsum("bi,bi->b", from_center, from_center)
            total += (strength / (square * np.sqrt(square)))[:, None] * from_center

        return push

    def potential(self, bodies: Sequence[Body], position: Array) -> Array:
        """See ``Force``."""
        distance = np.linalg.norm(position - np.array(self.center), axis=2)
        return np.asarray((1 / distance) @ (-self.GM * _masses(bodies)))


@dataclass(frozen=True)
class Coriolis:
    """2m v×Ω on every body, seen in a frame that turns with ``Omega`` (3,) [rad/s]; does no work."""

    Omega: Vector
    needs_velocity = True

    def __post_init__(self) -> None:
        finite("Coriolis Omega", self.Omega, (3,))

    def acting(self, bodies: Sequence[Body]) -> Push:
        """See ``Force``."""
        twice = 2 * _crossed(self.Omega)
        masses = _masses(bodies)[:, None]

        def push(position: Array, velocity: Array, total: Array) -> None:
            total += masses * velocity.dot(twice)

        return push

    def potential(self, bodies: Sequence[Body], position: Array) -> Array:
        """See ``Force``."""
        return np.zeros(len(position))


@dataclass(frozen=True)
class Centrifugal:
    """m (Ω×r)×Ω on every body, r from a ``center`` (3,) [m] on the axis, ``Omega`` (3,) [rad/s]."""

    Omega: Vector
    center: Vector = (0.0, 0.0, 0.0)
    needs_velocity = False

    def __post_init__(self) -> None:
        finite("centrifugal Omega", self.Omega, (3,))
        finite("centrifugal center", self.center, (3,))

    def acting(self, bodies: Sequence[Body]) -> Push:
        """See ``Force``."""
        cross = _crossed(self.Omega)
        center, outward = np.array(self.center), -cross @ cross
        masses = _masses(bodies)[:, None]

        def push(position: Array, velocity: Array, total: Array) -> None:
            total += masses * (position - center).dot(outward)

        return push

    def potential(self, bodies: Sequence[Body], position: Array) -> Array:
        """See ``Force``."""
        speed = (position - np.array(self.center)) @ _crossed(self.Omega)
        return np.asarray(np.sum(speed**2, axis=2) @ (-_masses(bodies) / 2))


def _place(bodies: Sequence[Body], name: str) -> int:
    names = [body.name for body in bodies]
    if name not in names:
        raise InputError(f"force: got body {name!r}, expected one of {', '.join(names)}")
    return names.index(name)


def _masses(bodies: Sequence[Body]) -> Array:
    return np.array([body.mass for body in bodies])


def _distance(bodies: Sequence[Body], first: str, second: str, position: Array) -> Array:
    apart = position[:, _place(bodies, second)] - position[:, _place(bodies, first)]
    return np.asarray(np.linalg.norm(apart, axis=1))


def _crossed(Omega: Vector) -> Array:
    """The matrix (3, 3) with v @ matrix = v × Ω."""
    return np.cross(np.eye(3), np.array(Omega))
