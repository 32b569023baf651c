"""Quaternions, scalar last (x, y, z, w), body to world; every function works on stacks of them."""

import numpy as np

from .checked import Array

_NEXT, _LAST = np.array([1, 2, 0]), np.array([2, 0, 1])


def product(p: Array, q: Array) -> Array:
    """The turn ``q`` followed by the turn ``p``: Hamilton's product p q.

    Parameters
    ----------
    p, q : (..., 4) quaternions, scalar last [1]

    Returns
    -------
    (..., 4) : p q; as rotations R(p q) = R(p) R(q). Goldstein, sect. 4.5; Hamilton (1843).
    """
    pv, pw = p[..., :3], p[..., 3:]
    qv, qw = q[..., :3], q[..., 3:]
    vector = pw * qv + qw * pv + cross(pv, qv)
    scalar = pw * qw - np.sum(pv * qv, axis=-1, keepdims=True)
    result: Array = np.concatenate([vector, scalar], axis=-1)
    return result


def conjugate(q: Array) -> Array:
    """The opposite turn of the unit quaternion ``q`` (..., 4)."""
    return np.concatenate([-q[..., :3], q[..., 3:]], axis=-1)


def rotated(q: Array, vector: Array) -> Array:
    """``vector`` (..., 3), given in body axes, in world axes: R(q) vector, ``q`` (..., 4) of unit length.

    Rodrigues' formula in Euler's parameters (Goldstein, sect. 4.7): v + 2w (u×v) + 2u×(u×v).
    """
    u, w = q[..., :3], q[..., 3:]
    once = cross(u, vector)
    result: Array = vector + 2 * (w * once + cross(u, once))
    return result


def matrix(q: Array) -> Array:
    """The matrix (..., 3, 3) whose columns are the body axes in world axes; ``q`` (..., 4) of unit length."""
    columns = [rotated(q, axis) for axis in np.eye(3)]
    return np.stack(columns, axis=-1)


def from_matrix(turned: Array) -> Array:
    """The turn (..., 4) whose body axes are the columns of ``turned`` (..., 3, 3), in world axes."""
    from scipy.spatial.transform import Rotation  # costs more to load than all of this file's callers

    return np.asarray(Rotation.from_matrix(turned).as_quat())


def from_rotation_vector(vector: Array) -> Array:
    """The turn (..., 4) about ``vector`` (..., 3) by its length [rad]."""
    half = 0.5 * np.linalg.norm(vector, axis=-1, keepdims=True)
    # numpy's sinc(x) is sin(πx)/(πx): exact at no turn at all, where an axis is undefined.
    return np.concatenate([0.5 * np.sinc(half / np.pi) * vector, np.cos(half)], axis=-1)


def rotation_vector(q: Array) -> Array:
    """The shorter turn that ``q`` (..., 4) makes, as a vector (..., 3) of length 0 to π [rad]."""
    q = np.where(q[..., 3:] < 0, -q, q)
    sine = np.linalg.norm(q[..., :3], axis=-1, keepdims=True)
    angle = 2 * np.arctan2(sine, q[..., 3:])
    safe = np.where(sine > 0, sine, 1.0)
    return np.where(sine > 0, angle / safe, 2.0) * q[..., :3]


def rate(q: Array, omega: Array) -> Array:
    """dq/dt (..., 4) [1/s] of ``q`` (..., 4) turning with ``omega`` (..., 3) in body axes [rad/s]: ½ q ω."""
    pure = np.concatenate([omega, np.zeros_like(omega[..., :1])], axis=-1)
    return 0.5 * product(q, pure)


def cross(a: Array, b: Array) -> Array:
    """A × b (..., 3): as numpy's, to the bit, in a tenth of its time where arrays are short."""
    result: Array = a.take(_NEXT, -1) * b.take(_LAST, -1) - a.take(_LAST, -1) * b.take(_NEXT, -1)
    return result
