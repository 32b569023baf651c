"""What of a scene is where in PyBullet: numbers of its bodies and links, places of coordinates."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from ..reference.checked import Array
from ..reference.quaternions import conjugate, cross, matrix, product, rotated
from ..scenarios.scene import Scene
from .pybullet_urdf import joint_name

#: PyBullet's number of a tree, and of a link in it; -1 is the tree's base.
Place = tuple[int, int]


class Free(NamedTuple):
    """A base that moves freely: the scene's number of its body, PyBullet's of the tree."""

    body: int
    uid: int
    q: slice
    v: slice


class Ball(NamedTuple):
    """A ball joint; ``carried`` is the body that it carries, or -1 if another joint comes between."""

    uid: int
    link: int
    carried: int
    q: slice
    v: slice


class Scalar(NamedTuple):
    """A hinge or a slide."""

    uid: int
    link: int
    q: int
    v: int
    stiffness: float


@dataclass(frozen=True)
class Layout:
    """Where every body is, and every joint, in the scene's order."""

    bodies: tuple[Place, ...]
    free: tuple[Free, ...]
    balls: tuple[Ball, ...]
    scalars: tuple[Scalar, ...]

    @cached_property
    def linked(self) -> dict[int, list[int]]:
        """Numbers of the bodies that are no base, by tree."""
        return _by_tree((uid, number) for number, (uid, link) in enumerate(self.bodies) if link >= 0)

    @cached_property
    def hinged(self) -> dict[int, list[int]]:
        """Numbers of the hinges and slides, by tree."""
        return _by_tree((scalar.uid, number) for number, scalar in enumerate(self.scalars))

    @cached_property
    def springs(self) -> list[tuple[int, list[int], list[float]]]:
        """Of each tree with springs: its number, their links, and the force that each gives at 1."""
        found = _by_tree((scalar.uid, i) for i, scalar in enumerate(self.scalars) if scalar.stiffness)
        return [
            (uid, [self.scalars[i].link for i in numbers], [-self.scalars[i].stiffness for i in numbers])
            for uid, numbers in found.items()
        ]


def layout(scene: Scene, uids: Mapping[int, int], links: Mapping[str, Place]) -> Layout:
    """The layout, from the tree that each body is in and the places of the joints by name."""
    bodies, free, balls, scalars = [], [], [], []
    slices = iter(scene.slices())
    for number, body in enumerate(scene.bodies):
        place = links.get(joint_name(number, max(0, len(body.joints) - 1)), (uids[number], -1))
        bodies.append(place)
        for k, joint in enumerate(body.joints):
            _, _, q, v = next(slices)
            uid, link = links.get(joint_name(number, k), place)
            if joint.kind == "free":
                free.append(Free(number, uid, q, v))
            elif joint.kind == "ball":
                balls.append(Ball(uid, link, number if (uid, link) == place else -1, q, v))
            else:
                scalars.append(Scalar(uid, link, q.start, v.start, joint.stiffness))
    return Layout(tuple(bodies), tuple(free), tuple(balls), tuple(scalars))


def of_base(q: Array, v: Array, center: Array, axes: Array) -> tuple[Array, Array, Array, Array]:
    """Place, turn, velocity and ω of a base in PyBullet, in world axes, from those of a free joint.

    PyBullet's are those of the inertial frame, at ``center`` (3,) and along ``axes`` (4,) in the body.
    """
    turn, omega = q[3:], rotated(q[3:], v[3:])
    arm = rotated(turn, center)
    return q[:3] + arm, product(turn, axes), v[:3] + cross(omega, arm), omega


def of_ball(q: Array, v: Array, axes: Array) -> tuple[Array, Array]:
    """Turn and ω of a ball joint in PyBullet, along the principal ``axes`` (4,) of what it carries."""
    return product(conjugate(axes), product(q, axes)), rotated(conjugate(axes), v)


def of_inertia(
    name: str, mass: float, moments: Sequence[float], center: Array, axes: Array
) -> dict[str, Any]:
    """A body's settings by name, from PyBullet's: principal moments, along ``axes`` (4,) in the body."""
    turn = matrix(axes)
    inertia = turn @ np.diag(moments) @ turn.T
    return {f"body/{name}/mass": mass, f"body/{name}/center_of_mass": center, f"body/{name}/inertia": inertia}


def inertial_frame(p: Any, client: int, uid: int, link: int) -> tuple[Array, Array]:
    """Centre of mass (3,) and turn (4,) to the principal axes in a link's frame, right after loading.

    A base that was put at the origin is where its inertial frame is in its own; ``getDynamicsInfo``
    would tell of memory never written in maximal coordinates.
    """
    base = p.getBasePositionAndOrientation(uid, client)
    frame = base if link < 0 else p.getLinkState(uid, link, 0, 0, client)[2:4]
    return np.array(frame[0]), np.array(frame[1])


def _by_tree(pairs: Iterable[tuple[int, int]]) -> dict[int, list[int]]:
    found: dict[int, list[int]] = {}
    for uid, number in pairs:
        found.setdefault(uid, []).append(number)
    return found
