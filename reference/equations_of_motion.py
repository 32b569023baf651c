"""Equations of motion of any tree of rigid links, in Kane's form, solved densely: no engine's method.

Along each velocity, the forces applied and the forces of inertia of all links add up to nothing (Kane &
Levinson, *Dynamics: Theory and Applications*, ch. 6; d'Alembert's principle in generalised coordinates,
Goldstein, sect. 1.4):

    M(q) v̇ + b(q, v) = Q,    M = Σ m V·V + W·I W,    b = Σ m V·(V̇ v) + W·(I Ẇ v + ω×Iω)

with V and W the partial velocities of a link's centre of mass and of its turning. What the coordinates and
velocities of each joint mean is said at ``Joint``.
"""

from collections.abc import Mapping, Sequence

import numpy as np
import numpy.typing as npt

from . import quaternions
from .checked import Array, finite
from .errors import InputError
from .multibody_tree import VELOCITIES, Joint, Link, sizes
from .tree_kinematics import (
    Motion,
    checked_state,
    coordinate_rates,
    joints_of,
    link_accelerations,
    link_motion,
    motion,
    summed,
)

__all__ = [
    "Joint",
    "Link",
    "accelerations",
    "bias",
    "coordinate_rates",
    "link_accelerations",
    "link_motion",
    "mass_matrix",
    "required_forces",
    "sizes",
]


def accelerations(
    links: Sequence[Link],
    q: npt.ArrayLike,
    v: npt.ArrayLike,
    gravity: npt.ArrayLike = (0.0, 0.0, 0.0),
    joint_forces: npt.ArrayLike | None = None,
    forces: npt.ArrayLike | None = None,
    torques: npt.ArrayLike | None = None,
    driven: Mapping[int, npt.ArrayLike] | None = None,
) -> Array:
    """Rates v̇ of the velocities at a state.

    Parameters
    ----------
    links : the tree
    q, v : (..., nq), (..., nv) coordinates and velocities [m, rad, 1; m/s, rad/s]
    gravity : (3,) its acceleration, world axes [m/s²]
    joint_forces : (..., nv) applied along each velocity, beside springs and damping [N, N m]
    forces : (..., n, 3) on each link at its centre of mass, world axes [N]
    torques : (..., n, 3) on each link, world axes [N m]
    driven : from the index of a velocity to the acceleration (...) that a motor gives it, whatever force
        that takes [rad/s², m/s²]

    Returns
    -------
    (..., nv) : v̇; of a free joint, the acceleration of its origin in world axes and dω/dt in its own.

    Raises
    ------
    InputError
        If something does not fit, is not finite, or some combination of velocities moves no inertia, as
        in a gimbal whose outer and inner axes coincide.
    """
    state, v = motion(links, q, v), finite("v", v)
    M = _mass_matrix(links, state)
    known = dict(driven or {})
    free = [index for index in range(v.shape[-1]) if index not in known]
    if len(free) + len(known) != v.shape[-1]:
        raise InputError(f"driven: got velocities {sorted(known)}, expected indices below {v.shape[-1]}")
    result = np.zeros_like(v)
    for index, value in known.items():
        result[..., index] = finite(f"driven[{index}]", value)
    applied = _applied(links, state, *checked_state(links, q, v), gravity, joint_forces, forces, torques)
    rest = applied - _bias(links, state, v) - np.einsum("...ij,...j->...i", M, result)
    result[..., free] = _solved(M[..., free, :][..., free], rest[..., free])
    return result


def required_forces(
    links: Sequence[Link],
    q: npt.ArrayLike,
    v: npt.ArrayLike,
    acceleration: npt.ArrayLike,
    gravity: npt.ArrayLike = (0.0, 0.0, 0.0),
    joint_forces: npt.ArrayLike | None = None,
    forces: npt.ArrayLike | None = None,
    torques: npt.ArrayLike | None = None,
) -> Array:
    """What is missing along each velocity for v̇ to be ``acceleration`` (..., nv) [N, N m].

    A motor's force where there is one; elsewhere the residual of the equations of motion, zero for a
    true motion. Other arguments, shapes and errors as for ``accelerations``.
    """
    state, v = motion(links, q, v), finite("v", v)
    a = finite("acceleration", acceleration, v.shape)
    applied = _applied(links, state, *checked_state(links, q, v), gravity, joint_forces, forces, torques)
    result: Array = _bias(links, state, v) - applied
    if a.any():  # at rest the mass matrix, by far the longest part, counts for nothing
        result += np.einsum("...ij,...j->...i", _mass_matrix(links, state), a)
    return result


def mass_matrix(links: Sequence[Link], q: npt.ArrayLike) -> Array:
    """M (..., nv, nv) at coordinates ``q`` (..., nq); 2T = v·Mv. Raises as ``accelerations`` does."""
    at_rest = np.zeros((*np.shape(q)[:-1], sizes(links)[1]))
    return _mass_matrix(links, motion(links, q, at_rest))


def bias(links: Sequence[Link], q: npt.ArrayLike, v: npt.ArrayLike) -> Array:
    """The b (..., nv) above: what holds v̇ = 0 where no force acts. Raises as ``accelerations`` does."""
    return _bias(links, motion(links, q, v), finite("v", v))


def _mass_matrix(links: Sequence[Link], state: Motion) -> Array:
    V, W = state.partial_velocity, state.partial_omega
    # Links and directions side by side: a product for each link takes a hundred times as long for 64 of them.
    translating = _flat(V * _masses(links)[:, None, None]) @ np.swapaxes(_flat(V), -1, -2)
    rotating = _flat(W @ _world_inertia(links, state)) @ np.swapaxes(_flat(W), -1, -2)
    result: Array = translating + rotating
    return result


def _flat(partial: Array) -> Array:
    """Partial velocities (..., n, nv, 3) as (..., nv, 3 n)."""
    by_velocity = np.moveaxis(partial, -3, -2)
    return by_velocity.reshape(*by_velocity.shape[:-2], -1)


def _solved(M: Array, rest: Array) -> Array:
    """The x of M x = ``rest``, if M is positive definite in units in which its diagonal is 1."""
    diagonal = np.einsum("...ii->...i", M)
    scale = 1 / np.sqrt(np.where(diagonal > 0, diagonal, np.inf))
    scaled = scale[..., :, None] * M * scale[..., None, :]
    # A chain of mass ratio r has a least eigenvalue near 1/r here: 1e8 is far above the rounding of M.
    if scaled.size and np.linalg.eigvalsh(scaled).min() < 16 * np.finfo(np.float64).eps:
        raise InputError("links: a combination of velocities moves nothing that has inertia")
    result: Array = scale * np.linalg.solve(scaled, (scale * rest)[..., None])[..., 0]
    return result


def _bias(links: Sequence[Link], state: Motion, v: Array) -> Array:
    omega, alpha = summed(state.partial_omega, v), summed(state.partial_omega_rate, v)
    inertia = _world_inertia(links, state)
    turning = (inertia @ alpha[..., None])[..., 0] + quaternions.cross(
        omega, (inertia @ omega[..., None])[..., 0]
    )
    return _along(state, _masses(links)[:, None] * summed(state.partial_velocity_rate, v), turning)


def _applied(
    links: Sequence[Link],
    state: Motion,
    q: Array,
    v: Array,
    gravity: npt.ArrayLike,
    joint_forces: npt.ArrayLike | None,
    forces: npt.ArrayLike | None,
    torques: npt.ArrayLike | None,
) -> Array:
    force = np.outer(_masses(links), finite("gravity", gravity, (3,)))
    force = force + _fitting("forces", forces, state.com.shape)
    result = _along(state, force, _fitting("torques", torques, state.com.shape))
    result = result + _fitting("joint_forces", joint_forces, v.shape)
    for joint, at_q, at_v in joints_of(links):
        here = slice(at_v, at_v + VELOCITIES[joint.kind])
        result[..., here] -= joint.damping * v[..., here]
        if joint.kind == "ball":
            turn = quaternions.rotation_vector(q[..., at_q : at_q + 4])
            result[..., here] -= joint.stiffness * turn
        elif joint.kind != "free":
            result[..., at_v] -= joint.stiffness * (q[..., at_q] - joint.rest)
    return result


def _fitting(name: str, value: npt.ArrayLike | None, shape: tuple[int, ...]) -> Array:
    array = finite(name, 0.0 if value is None else value)
    try:
        return np.broadcast_to(array, shape)
    except ValueError as cause:
        raise InputError(f"{name}: got shape {array.shape}, expected {shape}") from cause


def _along(state: Motion, force: Array, torque: Array) -> Array:
    """What forces (..., n, 3) at the centres of mass and torques (..., n, 3) do along each velocity."""
    pushed = np.sum(state.partial_velocity * force[..., None, :], axis=(-3, -1))
    turned = np.sum(state.partial_omega * torque[..., None, :], axis=(-3, -1))
    result: Array = pushed + turned
    return result


def _masses(links: Sequence[Link]) -> Array:
    return np.array([link.mass for link in links])


def _world_inertia(links: Sequence[Link], state: Motion) -> Array:
    R = quaternions.matrix(state.quaternion)
    result: Array = R @ np.stack([np.asarray(link.inertia) for link in links]) @ np.swapaxes(R, -1, -2)
    return result
