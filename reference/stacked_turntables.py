"""Turntables stacked on one another, each turning about an axis fixed in the one below: full kinematics."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from . import quaternions
from .checked import Array, finite, times
from .double_double import turning
from .errors import InputError
from .precise import mp


class Stack(NamedTuple):
    """All k tables at m times, in world axes unless said otherwise; rates are relative to the room."""

    quaternion: Array  # (m, k, 4) table to world
    omega_world: Array  # (m, k, 3) [rad/s]
    omega: Array  # (m, k, 3) in the table's own axes [rad/s]
    alpha_world: Array  # (m, k, 3) dω/dt [rad/s²]
    position: Array  # (m, k, 3) of each table's origin [m]
    velocity: Array  # (m, k, 3) [m/s]
    acceleration: Array  # (m, k, 3) [m/s²]


def stacked_turntables(
    axes: npt.ArrayLike,
    rates: npt.ArrayLike,
    t: npt.ArrayLike,
    offsets: npt.ArrayLike | None = None,
    angles: npt.ArrayLike | None = None,
) -> Stack:
    """Motion of tables that each turn steadily on the one below.

    Parameters
    ----------
    axes : (k, 3) each table's axis, in the axes of the one below (and its own); any length but 0
    rates : (k,) relative to the one below, right-handed about the axis [rad/s]
    t : (m,) times [s], of either sign
    offsets : (k, 3) where each table's origin, on its axis, is on the one below [m]; all 0 if not given
    angles : (k,) through which each is turned at t = 0 [rad]; all 0 if not given

    Raises
    ------
    InputError
        For shapes that do not fit, numbers that are not finite, an axis of no length, or times past 10¹⁵
        turns.

    Notes
    -----
    Angular velocities relative to successive frames add, ω31 = ω32 + ω21 (Taylor, sect. 9.3), so that each
    joint adds its own rate about where its axis now points; that axis is carried round by all below it, hence
    dω/dt = Σ ω(below) × (axis rate) (Landau & Lifshitz, *Mechanics*, § 31; Taylor, sect. 9.4).
    """
    axes, rates, t = finite("axes", axes, (-1, 3)), finite("rates", rates, (-1,)), times("t", t)
    offsets = finite("offsets", np.zeros_like(axes) if offsets is None else offsets, axes.shape)
    angles = finite("angles", np.zeros_like(rates) if angles is None else angles, rates.shape)
    lengths = np.linalg.norm(axes, axis=1)
    if len(axes) != len(rates) or len(axes) == 0 or np.any(lengths == 0):
        raise InputError(f"axes: got {axes.tolist()}, expected {len(rates)} directions, one for each rate")
    n = len(t)
    turn = np.broadcast_to([0.0, 0.0, 0.0, 1.0], (n, 4))
    omega = alpha = position = velocity = acceleration = np.zeros((n, 3))
    tables = []
    for axis, rate, offset, angle in zip(axes / lengths[:, None], rates, offsets, angles, strict=True):
        arm = quaternions.rotated(turn, offset)
        arm_rate = np.cross(omega, arm)
        position, velocity = position + arm, velocity + arm_rate
        acceleration = acceleration + np.cross(alpha, arm) + np.cross(omega, arm_rate)
        own_rate = rate * quaternions.rotated(turn, axis)
        alpha = alpha + np.cross(omega, own_rate)
        omega = omega + own_rate
        cosine, sine = turning(mp.mpf(float(rate)) / 2, mp.mpf(float(angle)) / 2, t)
        turn = quaternions.product(turn, np.column_stack([np.outer(sine, axis), cosine]))
        own_axes = quaternions.rotated(quaternions.conjugate(turn), omega)
        tables.append((turn, omega, own_axes, alpha, position, velocity, acceleration))
    return Stack(*(np.stack(column, axis=1) for column in zip(*tables, strict=True)))


def carried_point(stack: Stack, table: int, place: npt.ArrayLike) -> tuple[Array, Array, Array]:
    """Position, velocity and acceleration (m, 3) of a point at rest on a table, in the world [m, s].

    Parameters
    ----------
    stack : what ``stacked_turntables`` returned
    table : index of the table, the lowest being 0
    place : (3,) in the table's axes [m]

    Raises
    ------
    InputError
        If there is no such table, or ``place`` does not fit.

    Notes
    -----
    v = V + ω×r and a = A + dω/dt×r + ω×(ω×r): Landau & Lifshitz, *Mechanics*, §§ 31, 39.
    """
    count = stack.position.shape[1]
    if not 0 <= table < count:
        raise InputError(f"table: got {table}, expected 0 to {count - 1}")
    omega, alpha = stack.omega_world[:, table], stack.alpha_world[:, table]
    arm = quaternions.rotated(stack.quaternion[:, table], finite("place", place, (3,)))
    arm_rate = np.cross(omega, arm)
    return (
        stack.position[:, table] + arm,
        stack.velocity[:, table] + arm_rate,
        stack.acceleration[:, table] + np.cross(alpha, arm) + np.cross(omega, arm_rate),
    )
