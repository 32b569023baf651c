"""Where the links of a tree are, how they move, and their partial velocities with the rates of these.

A partial velocity is what one unit of one velocity adds to a link's (Kane & Levinson, *Dynamics: Theory
and Applications*, ch. 2). Each is written from the joint's own axis and point; nothing here is the
recursion over spatial vectors that engines use.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from . import quaternions
from .checked import Array, finite
from .errors import InputError
from .multibody_tree import COORDINATES, VELOCITIES, Joint, Link, sizes
from .tree_joints import NO_TURN, Columns, Frame, joined, moved, placed


@dataclass(frozen=True)
class Motion:
    """All n links of a tree at a state, and what each of its k velocities moves; world axes."""

    quaternion: Array  # (..., n, 4) link to world
    com: Array  # (..., n, 3) centres of mass [m]
    partial_velocity: Array  # (..., n, k, 3) ∂v_com/∂v
    partial_omega: Array  # (..., n, k, 3) ∂ω/∂v
    partial_velocity_rate: Array  # (..., n, k, 3)
    partial_omega_rate: Array  # (..., n, k, 3)


def motion(links: Sequence[Link], q: npt.ArrayLike, v: npt.ArrayLike) -> Motion:
    """Place and partial velocities of every link.

    Parameters
    ----------
    links : the tree
    q, v : (..., nq), (..., nv) its coordinates and velocities, see ``multibody_tree.Joint``

    Raises
    ------
    InputError
        If the links are no tree, the shapes do not fit it, a number is not finite or a quaternion has a
        length below ½.
    """
    q, v = checked_state(links, q, v)
    frames, columns, moved_by = _walk(links, q, v)
    origin = np.stack([frame.origin for frame in frames], axis=-2)
    quaternion = np.stack([frame.quaternion for frame in frames], axis=-2)
    offset = quaternions.rotated(quaternion, np.stack([np.asarray(link.com) for link in links]))
    velocity = np.stack([frame.velocity for frame in frames], axis=-2)
    velocity = velocity + quaternions.cross(np.stack([frame.omega for frame in frames], axis=-2), offset)
    turns, slides = moved_by & columns.rotates, moved_by & ~columns.rotates
    axis, axis_rate = columns.axis[..., None, :, :], columns.axis_rate[..., None, :, :]
    arm = (origin + offset)[..., :, None, :] - columns.point[..., None, :, :]
    arm_rate = velocity[..., :, None, :] - columns.point_velocity[..., None, :, :]
    turning_rate = quaternions.cross(axis_rate, arm) + quaternions.cross(axis, arm_rate)
    return Motion(
        quaternion=quaternion,
        com=origin + offset,
        partial_velocity=_where(turns, quaternions.cross(axis, arm)) + _where(slides, axis),
        partial_omega=_where(turns, axis),
        partial_velocity_rate=_where(turns, turning_rate) + _where(slides, axis_rate),
        partial_omega_rate=_where(turns, axis_rate),
    )


def link_motion(
    links: Sequence[Link], q: npt.ArrayLike, v: npt.ArrayLike
) -> tuple[Array, Array, Array, Array]:
    """Place and velocity of each link, as a trajectory has them. Arguments and errors as for ``motion``.

    Returns
    -------
    position (..., n, 3) of the centre of mass [m], quaternion (..., n, 4), velocity (..., n, 3) [m/s], all
    in world axes, and omega (..., n, 3) in the link's own axes [rad/s]
    """
    state, v = motion(links, q, v), finite("v", v)
    omega = summed(state.partial_omega, v)
    return state.com, state.quaternion, summed(state.partial_velocity, v), _in_link_axes(state, omega)


def link_accelerations(
    links: Sequence[Link], q: npt.ArrayLike, v: npt.ArrayLike, acceleration: npt.ArrayLike
) -> tuple[Array, Array]:
    """Accelerations of the links when v̇ is ``acceleration`` (..., nv); otherwise as ``motion``.

    Returns
    -------
    (..., n, 3) of each centre of mass, world axes [m/s²], and (..., n, 3) dω/dt in the link's axes [rad/s²]
    """
    state, v = motion(links, q, v), finite("v", v)
    a = finite("acceleration", acceleration, v.shape)
    linear = summed(state.partial_velocity, a) + summed(state.partial_velocity_rate, v)
    angular = summed(state.partial_omega, a) + summed(state.partial_omega_rate, v)
    return linear, _in_link_axes(state, angular)


def coordinate_rates(links: Sequence[Link], q: npt.ArrayLike, v: npt.ArrayLike) -> Array:
    """dq/dt (..., nq) at velocities ``v``: the other half of a first-order system for (q, v)."""
    q, v = checked_state(links, q, v)
    result = np.empty_like(q)
    for joint, at_q, at_v in joints_of(links):
        if joint.kind in ("hinge", "slide"):
            result[..., at_q] = v[..., at_v]
            continue
        if joint.kind == "free":
            result[..., at_q : at_q + 3] = v[..., at_v : at_v + 3]
            at_q, at_v = at_q + 3, at_v + 3
        turn = quaternions.rate(q[..., at_q : at_q + 4], v[..., at_v : at_v + 3])
        result[..., at_q : at_q + 4] = turn
    return result


def checked_state(links: Sequence[Link], q: npt.ArrayLike, v: npt.ArrayLike) -> tuple[Array, Array]:
    """``q`` (..., nq) and ``v`` (..., nv) as arrays with the same leading shape; see ``motion``."""
    number_of_q, number_of_v = sizes(links)
    q, v = finite("q", q), finite("v", v)
    if q.ndim < 1 or q.shape[-1] != number_of_q or v.shape != (*q.shape[:-1], number_of_v):
        raise InputError(
            f"state: got q of shape {q.shape} and v of shape {v.shape}, "
            f"expected (..., {number_of_q}) and (..., {number_of_v})"
        )
    return q, v


def joints_of(links: Sequence[Link]) -> list[tuple[Joint, int, int]]:
    """Every joint, with the index of its first coordinate and of its first velocity."""
    result = []
    at_q = at_v = 0
    for joint in (joint for link in links for joint in link.joints):
        result.append((joint, at_q, at_v))
        at_q, at_v = at_q + COORDINATES[joint.kind], at_v + VELOCITIES[joint.kind]
    return result


def summed(partial: Array, rates: Array) -> Array:
    """(..., n, 3) of each link: the sum of ``rates`` (..., k) times partial velocities (..., n, k, 3)."""
    result: Array = np.einsum("...nkc,...k->...nc", partial, rates)
    return result


def _where(mask: npt.NDArray[np.bool_], vectors: Array) -> Array:
    return np.where(mask[..., None], vectors, 0.0)


def _in_link_axes(state: Motion, vectors: Array) -> Array:
    return quaternions.rotated(quaternions.conjugate(state.quaternion), vectors)


def _walk(links: Sequence[Link], q: Array, v: Array) -> tuple[list[Frame], Columns, npt.NDArray[np.bool_]]:
    """Each link's frame, the columns of all joints, and (n, k) whether a velocity moves a link."""
    batch = q.shape[:-1]
    zero = np.zeros((*batch, 3))
    world = Frame(np.broadcast_to(NO_TURN, (*batch, 4)), zero, zero, zero)
    frames: list[Frame] = []
    parts = [Columns(np.zeros(0, bool), *(np.zeros((*batch, 0, 3)) for _ in range(4)))]
    moved_by = np.zeros((len(links), v.shape[-1]), dtype=bool)
    at_q = at_v = 0
    for index, link in enumerate(links):
        frame = world
        if link.parent >= 0:
            frame, moved_by[index] = frames[link.parent], moved_by[link.parent]
        frame = placed(frame, np.asarray(link.position), np.asarray(link.quaternion))
        for joint in link.joints:
            next_q, next_v = at_q + COORDINATES[joint.kind], at_v + VELOCITIES[joint.kind]
            frame, part = moved(frame, joint, q[..., at_q:next_q], v[..., at_v:next_v])
            parts.append(part)
            moved_by[index, at_v:next_v] = True
            at_q, at_v = next_q, next_v
        frames.append(frame)
    return frames, joined(parts), moved_by
