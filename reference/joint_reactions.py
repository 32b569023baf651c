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
) -> Array:
    """Reactions (..., k, 6) on the links numbered ``held`` (k,), at ``q`` (..., nq) and ``v`` (..., nv).

    Force [N] and moment [N m] about the origin of the link's frame, both in the link's own axes; springs and
    dampers of its joints are part of them. ``gravity`` (3,) [m/s²]. Raises InputError as
    `equations_of_motion.accelerations`.
    """
    acceleration = equations_of_motion.accelerations(links, q, v, gravity)
    place, turn, _, omega = equations_of_motion.link_motion(links, q, v)
    linear, alpha = equations_of_motion.link_accelerations(links, q, v, acceleration)
    inertia = np.array([link.inertia for link in links])
    push = np.array([[link.mass] for link in links]) * (linear - finite("gravity", gravity, (3,)))
    spin = np.einsum("lij,...lj->...li", inertia, omega)
    own = np.einsum("lij,...lj->...li", inertia, alpha) + quaternions.cross(omega, spin)
    twist = quaternions.rotated(turn, own)
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
