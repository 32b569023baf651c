"""A tree of rigid links, in numbers: what the equations of motion are written for."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
import numpy.typing as npt

from .checked import Array, finite, not_negative, number, unit_quaternion
from .errors import InputError

Kind = Literal["free", "ball", "hinge", "slide"]

#: Coordinates and velocities of each kind of joint.
COORDINATES: dict[Kind, int] = {"free": 7, "ball": 4, "hinge": 1, "slide": 1}
VELOCITIES: dict[Kind, int] = {"free": 6, "ball": 3, "hinge": 1, "slide": 1}


@dataclass(frozen=True, eq=False)
class Joint:
    """One joint of a link; several on one link act in turn, the first next to the parent.

    Coordinates (q) and velocities (v) of each kind:
    free: place of the link's origin in the world (3) [m] and quaternion (4); its velocity in world axes
    (3) [m/s] and ω in the link's axes (3) [rad/s]. Only alone, on a link whose parent is the world.
    ball: quaternion (4) of the turn; ω relative to what carries the joint, in the turned axes, which are
    the link's unless another joint follows on the same link [rad/s].
    hinge: angle [rad], right-handed about ``axis``; slide: distance along ``axis`` [m].

    Parameters
    ----------
    kind : "free", "ball", "hinge" or "slide"
    axis : (3,) direction in the link's axes, of any length but zero (hinge, slide)
    position : (3,) point of the link that a hinge or a ball turns about, in the link's axes [m]
    stiffness : spring towards ``rest``: [N m/rad] (a ball's spring pulls along the shortest turn) or [N/m]
    damping : force per velocity [N m s/rad] or [N s/m]
    rest : coordinate at which the spring of a hinge [rad] or slide [m] is slack

    Raises
    ------
    InputError
        For an unknown kind, an axis of no length, negative or not finite numbers, and for a free joint
        with a spring or damping.
    """

    kind: Kind
    axis: npt.ArrayLike = (0.0, 0.0, 1.0)
    position: npt.ArrayLike = (0.0, 0.0, 0.0)
    stiffness: float = 0.0
    damping: float = 0.0
    rest: float = 0.0

    def __post_init__(self) -> None:
        if self.kind not in get_args(Kind):
            raise InputError(f"kind: got {self.kind!r}, expected one of {', '.join(get_args(Kind))}")
        axis = finite("axis", self.axis, (3,))
        if not np.any(axis):
            raise InputError("axis: got (0, 0, 0), expected a direction")
        # Dividing by the largest component first keeps the length of a tiny axis from underflowing.
        axis = axis / np.abs(axis).max()
        object.__setattr__(self, "axis", axis / np.linalg.norm(axis))
        object.__setattr__(self, "position", finite("position", self.position, (3,)))
        not_negative("stiffness", self.stiffness)
        not_negative("damping", self.damping)
        number("rest", self.rest)
        if self.kind == "free" and (self.stiffness or self.damping):
            raise InputError("free joint: got a spring or damping, expected none")
        if self.kind in ("free", "ball") and self.rest:
            raise InputError(f"{self.kind} joint: got rest {self.rest}, expected 0 (no turn at all)")


@dataclass(frozen=True, eq=False)
class Link:
    """One rigid link, with the joints between it and its parent.

    Parameters
    ----------
    mass : [kg]; zero only where other links make up for it
    inertia : (3, 3) about the centre of mass, in the link's axes [kg m²]; zero for a point mass
    com : (3,) centre of mass in the link's axes [m]
    parent : index of the parent link, which must come earlier; -1 is the world
    joints : in order from the parent; none at all welds the link to its parent
    position, quaternion : (3,) [m] and (4,): the link's frame in its parent's when every joint is at zero

    Raises
    ------
    InputError
        For numbers that no link can have (see ``inertia_of_a_body``) or shapes that do not fit.
    """

    mass: float
    inertia: npt.ArrayLike
    com: npt.ArrayLike = (0.0, 0.0, 0.0)
    parent: int = -1
    joints: tuple[Joint, ...] = ()
    position: npt.ArrayLike = (0.0, 0.0, 0.0)
    quaternion: npt.ArrayLike = (0.0, 0.0, 0.0, 1.0)

    def __post_init__(self) -> None:
        not_negative("mass", self.mass)
        object.__setattr__(self, "inertia", inertia_of_a_body("inertia", self.inertia))
        object.__setattr__(self, "com", finite("com", self.com, (3,)))
        object.__setattr__(self, "joints", tuple(self.joints))
        object.__setattr__(self, "position", finite("position", self.position, (3,)))
        object.__setattr__(self, "quaternion", unit_quaternion("quaternion", self.quaternion))


def inertia_of_a_body(name: str, value: npt.ArrayLike) -> Array:
    """``value`` (3, 3) [kg m²], if some body has it: symmetric, no moment below 0 or above the other two.

    Rods and point masses, whose moments reach zero, are bodies; eight units in the last place of the
    largest moment are granted to rounding.
    """
    tensor = finite(name, value, (3, 3))
    slack = 8 * np.finfo(np.float64).eps * np.abs(tensor).max(initial=0.0)
    if np.any(np.abs(tensor - tensor.T) > slack):
        raise InputError(f"{name}: got {tensor.tolist()}, expected a symmetric tensor")
    moments = np.linalg.eigvalsh(tensor)
    if moments[0] < -slack or moments[2] > moments[0] + moments[1] + slack:
        raise InputError(f"{name}: got principal moments {moments.tolist()}; no body has such moments")
    return tensor


def sizes(links: Sequence[Link]) -> tuple[int, int]:
    """How many coordinates and how many velocities the tree has, after checking that it is one.

    Raises
    ------
    InputError
        If a parent does not come before its link, or a free joint is not alone on a link of the world.
    """
    for index, link in enumerate(links):
        if not -1 <= link.parent < index:
            raise InputError(f"link {index}: got parent {link.parent}, expected -1 or an earlier link")
        placed = np.any(link.position) or abs(np.asarray(link.quaternion)[3]) != 1.0
        if any(joint.kind == "free" for joint in link.joints) and (
            len(link.joints) > 1 or link.parent != -1 or placed
        ):
            raise InputError(
                f"link {index}: a free joint must be its only one, its parent the world, and its place "
                "left at zero: the coordinates say where it is"
            )
    kinds: list[Kind] = [joint.kind for link in links for joint in link.joints]
    return sum(COORDINATES[kind] for kind in kinds), sum(VELOCITIES[kind] for kind in kinds)
