"""Rigid bodies and the joints that carry them, described once for every engine."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ..reference.checked import (
    Array,
    finite,
    not_negative,
    number,
    positive,
    principal_moments,
    unit_quaternion,
)
from ..reference.errors import InputError
from .solid import Solid, together

JointKind = Literal["free", "ball", "hinge", "slide"]
Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]
Matrix = tuple[Vector, Vector, Vector]

#: Length of a joint's position and velocity in ``Scene.q0`` and ``Scene.v0``.
WIDTHS: dict[str, tuple[int, int]] = {"free": (7, 6), "ball": (4, 3), "hinge": (1, 1), "slide": (1, 1)}
#: What finding principal moments may cost, in units of the largest's last place: of 20000 plates at random
#: attitudes none came out beyond itself by more than 8.
TURNED = 16
IDENTITY: Quaternion = (0.0, 0.0, 0.0, 1.0)


@dataclass(frozen=True)
class Joint:
    """One joint between a body and its parent, at the origin of the body's frame.

    Coordinates: ``free`` position (3) of the body frame's origin in world axes [m] and quaternion
    (4); ``ball`` quaternion (4), body frame to the frame before it; ``hinge`` angle [rad];
    ``slide`` displacement [m]. Velocities: ``free`` velocity (3) of the frame's origin in world
    axes [m/s] and angular velocity (3) in body axes [rad/s]; ``ball`` angular velocity (3) in body
    axes [rad/s]; ``hinge`` [rad/s]; ``slide`` [m/s].

    A hinge or slide may carry a spring and a damper: generalised force −stiffness·q − damping·q̇
    [N m/rad, N/m and N m s/rad, N s/m].
    """

    name: str
    kind: JointKind
    axis: Vector = (0.0, 0.0, 1.0)
    stiffness: float = 0.0
    damping: float = 0.0

    def __post_init__(self) -> None:
        if self.kind not in WIDTHS:
            raise InputError(
                f"joint {self.name!r}: got kind {self.kind!r}, expected one of {', '.join(WIDTHS)}"
            )
        axis = finite(f"joint {self.name!r} axis", self.axis, (3,))
        if abs(math.hypot(*axis) - 1) > 1e-12:
            raise InputError(f"joint {self.name!r} axis: got {self.axis}, expected a unit vector")
        not_negative(f"joint {self.name!r} stiffness", self.stiffness)
        not_negative(f"joint {self.name!r} damping", self.damping)
        if self.kind not in ("hinge", "slide") and (self.stiffness or self.damping):
            raise InputError(
                f"joint {self.name!r}: a {self.kind} joint takes no spring or damper, only hinge and slide do"
            )


@dataclass(frozen=True)
class Body:
    """One rigid body: mass [kg], centre of mass [m] and inertia about it [kg m²], in body axes.

    ``joints`` lead from the parent (``None``: the world) to the body, the first nearest to the
    parent; none at all welds the body to it. ``position`` and ``quaternion`` place the body's
    frame in the parent's where every joint coordinate is zero; a body with a free joint has no
    such place, its coordinates say where it is.

    With ``solids``, an engine is told of those alone and works out the rest: mass, centre of mass and
    inertia are then what it must come to. `of_solids` makes such a body.
    """

    name: str
    mass: float
    inertia: Matrix
    joints: tuple[Joint, ...]
    center_of_mass: Vector = (0.0, 0.0, 0.0)
    parent: str | None = None
    position: Vector = (0.0, 0.0, 0.0)
    quaternion: Quaternion = IDENTITY
    solids: tuple[Solid, ...] = ()

    def __post_init__(self) -> None:
        positive(f"body {self.name!r} mass", self.mass)
        finite(f"body {self.name!r} center_of_mass", self.center_of_mass, (3,))
        finite(f"body {self.name!r} position", self.position, (3,))
        unit_quaternion(f"body {self.name!r} quaternion", self.quaternion)
        inertia = finite(f"body {self.name!r} inertia", self.inertia, (3, 3))
        (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = inertia.tolist()
        if (xy, xz, yz) != (yx, zx, zy):
            raise InputError(
                f"body {self.name!r} inertia: got {inertia.tolist()}, expected a symmetric tensor"
            )
        diagonal = not (xy or xz or yz)
        moments = (xx, yy, zz) if diagonal else _moments(inertia)
        principal_moments(f"body {self.name!r} inertia", moments, 4 if diagonal else TURNED)
        if any(joint.kind == "free" for joint in self.joints) and (len(self.joints) > 1 or self.parent):
            raise InputError(
                f"body {self.name!r}: a free joint must be its body's only one, and its parent the world"
            )
        if any(joint.kind == "free" for joint in self.joints) and (
            any(self.position) or any(self.quaternion[:3])
        ):
            raise InputError(
                f"body {self.name!r}: got position {self.position} and quaternion {self.quaternion}, "
                "expected none: the coordinates of its free joint say where it is"
            )

    @property
    def inertia_array(self) -> Array:
        """Inertia about the centre of mass, (3, 3) [kg m²], body axes."""
        return np.asarray(self.inertia, dtype=np.float64)


def of_solids(
    name: str,
    solids: Sequence[Solid],
    joints: tuple[Joint, ...],
    position: Vector = (0.0, 0.0, 0.0),
    quaternion: Quaternion = IDENTITY,
) -> Body:
    """A body made of ``solids``: mass, centre of mass and inertia as their closed forms add up to."""
    mass, centre, inertia = together(solids)
    x, y, z = centre.tolist()
    (a, b, c), (d, e, f), (g, h, i) = inertia.tolist()
    return Body(
        name, mass, ((a, b, c), (d, e, f), (g, h, i)), joints, (x, y, z),
        position=position, quaternion=quaternion, solids=tuple(solids),
    )  # fmt: skip


def diagonal(I1: float, I2: float, I3: float) -> Matrix:
    """Inertia tensor with these principal moments [kg m²] along the body axes."""
    return (
        (number("I1", I1), 0.0, 0.0),
        (0.0, number("I2", I2), 0.0),
        (0.0, 0.0, number("I3", I3)),
    )


def _moments(inertia: Array) -> tuple[float, ...]:
    """Principal moments of a tensor with products; one of 0 would come out as a rounding of the others."""
    moments = np.linalg.eigvalsh(inertia)
    rounding = TURNED * np.finfo(np.float64).eps * abs(moments).max()
    return tuple(np.where(abs(moments) > rounding, moments, 0.0).tolist())
