"""Angular momentum and kinetic energy, split into those of the centre of mass and those about it.

Source: Goldstein, *Classical Mechanics*, § 1.2, eqs. (1.28) and (1.31); Taylor, *Classical Mechanics*,
§ 10.1 (the planet's L_orb and L_spin).
"""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from .checked import Array, finite, positive, unit_quaternions
from .errors import InputError
from .inertia import physical
from .quaternions import rotated


class Split(NamedTuple):
    """L_orbital and L_spin (..., 3) [kg m²/s] in world axes; T_orbital and T_spin (...) [J]."""

    L_orbital: Array
    L_spin: Array
    T_orbital: Array
    T_spin: Array


def of_points(masses: npt.ArrayLike, positions: npt.ArrayLike, velocities: npt.ArrayLike) -> Split:
    """Of masses (n,) [kg] at positions (..., n, 3) [m] with velocities (..., n, 3) [m/s].

    The sums of the parts are Σ m r×v and Σ ½mv². L_orbital is constant if the force is central, L_spin
    if there is no torque about the centre. Raises InputError if shapes do not fit or a mass is not
    positive. Source: Goldstein eqs. (1.28), (1.31).
    """
    r, v = finite("positions", positions), finite("velocities", velocities)
    if r.ndim < 2 or r.shape[-1] != 3 or r.shape != v.shape:
        raise InputError(f"positions, velocities: got shapes {r.shape}, {v.shape}, expected two (..., n, 3)")
    m = finite("masses", masses, (r.shape[-2],))[:, None]
    if np.any(m <= 0):
        raise InputError(f"masses: got {m.ravel().tolist()}, expected all above 0")
    total = float(np.sum(m))
    R, V = (np.sum(m * x, axis=-2, keepdims=True) / total for x in (r, v))
    L_spin = np.sum(m * np.cross(r - R, v - V), axis=-2)
    T_spin = np.sum(m * (v - V) ** 2, axis=(-2, -1)) / 2
    L_orbital, T_orbital = _of_centre(total, R[..., 0, :], V[..., 0, :])
    return Split(L_orbital, L_spin, T_orbital, T_spin)


def of_body(
    mass: float,
    inertia: npt.ArrayLike,
    position: npt.ArrayLike,
    velocity: npt.ArrayLike,
    q: npt.ArrayLike,
    omega: npt.ArrayLike,
) -> Split:
    """Of a rigid body with ``inertia`` (3, 3) about its centre, in body axes.

    Centre at ``position`` (..., 3) [m] with ``velocity`` (..., 3) [m/s], world axes; attitude q (..., 4),
    body to world; ω (..., 3) [rad/s] in body axes. Raises InputError if shapes do not fit, q is
    not of unit length or the tensor is no body's. Source: Goldstein eqs. (1.28), (1.31), § 5.1.
    """
    r, v = finite("position", position), finite("velocity", velocity)
    turn, w = unit_quaternions("q", q), finite("omega", omega)
    for name, array, width in (("position", r, 3), ("velocity", v, 3), ("q", turn, 4), ("omega", w, 3)):
        if array.shape != (*r.shape[:-1], width):
            raise InputError(f"{name}: got shape {array.shape}, expected {(*r.shape[:-1], width)}")
    L_body: Array = w @ physical(inertia)
    L_orbital, T_orbital = _of_centre(positive("mass", mass), r, v)
    return Split(L_orbital, rotated(turn, L_body), T_orbital, np.sum(w * L_body, axis=-1) / 2)


def _of_centre(mass: float, r: Array, v: Array) -> tuple[Array, Array]:
    return mass * np.cross(r, v), mass * np.sum(v**2, axis=-1) / 2
