"""What holds the links of a tree: the force and moment of each link's parent on it, through its joints.

Newton's and Euler's equations, summed over a link and all that it carries (d'Alembert; Goldstein, *Classical
Mechanics*, sects. 1.2 and 5.5): the force is Σ m (a − g), the moment Σ r × m (a − g) + I α + ω×Iω.
"""

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from . import equations_of_motion, quaternions
from .checked import Array, finite
from .equations_of_motion import Link


def reactions(
    links: Sequence[Link],
    q: npt.ArrayLike,
    v: npt.ArrayLike,
    gravity: npt.ArrayLike,
    held: Sequence[int],
    forces: npt.ArrayLike = 0.0,
) -> Array:
    """Reactions (..., k, 6) on the links numbered ``held`` (k,), at ``q`` (..., nq) and ``v`` (..., nv).

    Force [N] and moment [N m] about the origin of the link's frame, both in the link's own axes; springs and
    dampers of its joints are part of them, ``forces`` (..., links, 3) [N] from outside at the centres of mass
    are not. ``gravity`` (3,) [m/s²]. Raises InputError as `equations_of_motion.accelerations`.
    """
    place, turn, _, omega = equations_of_motion.link_motion(links, q, v)
    outer = np.broadcast_to(np.asarray(forces, dtype=np.float64), place.shape)
    acceleration = equations_of_motion.accelerations(links, q, v, gravity, forces=outer)
    linear, alpha = equations_of_motion.link_accelerations(links, q, v, acceleration)
    inertia = np.array([link.inertia for link in links])
    push = np.array([[link.mass] for link in links]) * (linear - finite("gravity", gravity, (3,)))
    push = push - outer
    spin = np.einsum("lij,...lj->...li", inertia, omega)
    own = np.einsum("lij,...lj->...li", inertia, alpha) + quaternions.cross(omega, spin)
    return _gathered(links, place, turn, push, quaternions.rotated(turn, own), held)


def of_outer_forces(
    links: Sequence[Link], q: npt.ArrayLike, v: npt.ArrayLike, forces: npt.ArrayLike, held: Sequence[int]
) -> Array:
    """What ``forces`` (..., links, 3) [N] at centres of mass come to on links ``held`` and what they carry.

    Shape, axes and point as of `reactions`, which an engine has too large by this if it forgets them.
    Source: a system of forces reduced to a point (Goldstein § 1.2).
    """
    place, turn, _, _ = equations_of_motion.link_motion(links, q, v)
    outer = np.broadcast_to(np.asarray(forces, dtype=np.float64), place.shape)
    return _gathered(links, place, turn, outer, np.zeros(place.shape), held)


def _gathered(
    links: Sequence[Link], place: Array, turn: Array, push: Array, twist: Array, held: Sequence[int]
) -> Array:
    """Forces ``push`` at ``place`` and moments ``twist`` (..., l, 3), world axes, on each of ``held``."""
    found = []
    for link in held:
        back = quaternions.conjugate(turn[..., link, :])
        origin = place[..., link, :] - quaternions.rotated(turn[..., link, :], np.array(links[link].com))
        carried = _carried(links, link)
        force = push[..., carried, :].sum(axis=-2)
        arms = place[..., carried, :] - origin[..., None, :]
        moments = quaternions.cross(arms, push[..., carried, :]) + twist[..., carried, :]
        moment = moments.sum(axis=-2)
        found.append(np.concatenate([quaternions.rotated(back, part) for part in (force, moment)], axis=-1))
    return np.stack(found, axis=-2)


def _carried(links: Sequence[Link], first: int) -> list[int]:
    """The link itself and all that hang on it; a parent stands before its children."""
    found = [first]
    for number, link in enumerate(links):
        if link.parent in found and number not in found:
            found.append(number)
    return found
