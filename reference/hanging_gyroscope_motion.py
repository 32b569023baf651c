"""Motion of a gyroscope on a rope, from any start: the equations of `hanging_gyroscope`, integrated.

There is no closed form but for the steady precession. Each body turns at ω = u × u̇ + ω3 u, u being its axis;
the ω3 of both are constant. The rope's own moment about its axis is taken for none.

Source: Goldstein, *Classical Mechanics*, § 5.5; Hairer, Nørsett & Wanner, *Solving Ordinary Differential
Equations I*, § II.5 (the method of order 8).
"""

from typing import Any

import numpy as np
import numpy.typing as npt
import scipy

from . import quaternions
from .checked import Array, finite, times, unit_quaternions
from .errors import InputError
from .hanging_gyroscope import Gyroscope, Rope, accelerations

_untyped: Any = scipy.integrate

_AXIS = np.array([0.0, 0.0, 1.0])


def motion(
    rope: Rope,
    gyroscope: Gyroscope,
    gravity: float,
    q0: npt.ArrayLike,
    omega0: npt.ArrayLike,
    t: npt.ArrayLike,
    tolerance: float = 1e-12,
) -> tuple[Array, Array]:
    """Attitudes q (m, 2, 4), body to world, and ω (m, 2, 3) in body axes [rad/s], of rope and gyroscope.

    ``q0`` (2, 4), ``omega0`` (2, 3) at t = 0; times t (m,) [s], from 0 on, ascending. e3 of each body is its
    axis, away from the fixed point. Good to about a hundred times ``tolerance`` a second. Raises InputError
    as `hanging_gyroscope.accelerations`, or for times that descend.
    """
    q, spin = unit_quaternions("q0", q0), finite("omega0", omega0, (2, 3))
    moments = times("t", t)
    if np.any(np.diff(moments, prepend=0.0) < 0):
        raise InputError(f"t: got {moments.tolist()}, expected times from 0 on, ascending")

    def rates(_: float, state: Array) -> Array:
        turns, omega = _parts(state)
        axes, axis_rates = (
            quaternions.rotated(turns, _AXIS),
            quaternions.rotated(turns, quaternions.cross(omega, _AXIS)),
        )
        omega3 = omega[:, 2:]
        (n, e), (n_rate, e_rate) = axes, axis_rates
        curving = accelerations(rope, gyroscope, gravity, (n, e), (n_rate, e_rate), float(omega3[1, 0]))
        turned = quaternions.cross(axes, np.array(curving)) + omega3 * axis_rates
        change = quaternions.rotated(quaternions.conjugate(turns), turned)
        return np.concatenate([quaternions.rate(turns, omega).ravel(), change.ravel()])

    found = _untyped.solve_ivp(
        rates,
        (0.0, float(moments[-1]) or 1.0),
        np.concatenate([q.ravel(), spin.ravel()]),
        "DOP853",
        moments,
        rtol=tolerance,
        atol=tolerance,
    ).y.T
    return _parts(found)


def _parts(state: Array) -> tuple[Array, Array]:
    """Unit quaternions (..., 2, 4) and ω (..., 2, 3) of states (..., 14)."""
    turns = state[..., :8].reshape(*state.shape[:-1], 2, 4)
    omega = state[..., 8:].reshape(*state.shape[:-1], 2, 3)
    return turns / np.linalg.norm(turns, axis=-1, keepdims=True), omega
