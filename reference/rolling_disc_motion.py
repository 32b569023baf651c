"""The motion of a rolling disc from any start, integrated far below an engine's error."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt
import scipy

from . import quaternions
from .checked import Array, finite, times, unit_quaternion
from .errors import InputError
from .euler_angles import zxz_angles, zxz_attitude, zxz_omega, zxz_rates
from .rolling_disc import disc

_integrate: Any = scipy.integrate  # ships no types

#: Below this sine of the tilt, the disc counts as fallen flat [1].
FLAT = 1e-6


def motion(
    mass: float,
    radius: float,
    moments: npt.ArrayLike,
    gravity: float,
    q0: npt.ArrayLike,
    omega0: npt.ArrayLike,
    t: npt.ArrayLike,
    place: npt.ArrayLike = (0.0, 0.0),
) -> tuple[Array, Array, Array, Array]:
    """Place, attitude, velocity and angular velocity of a disc that rolls without slipping on z = 0.

    Parameters
    ----------
    mass, radius, moments, gravity : m [kg], r [m], (I1, I3) about the centre [kg m²], g [m/s²]
    q0 : (4,) attitude at t = 0, the disc's axis being its third; not flat
    omega0 : (3,) angular velocity at t = 0, body axes [rad/s]; it decides the velocity too
    t : (n,) times [s], of either sign, in any order
    place : (2,) x and y of the centre at t = 0 [m]

    Returns
    -------
    position : (n, 3) of the centre, world axes [m]
    q : (n, 4) attitude
    velocity : (n, 3) world axes [m/s]
    omega : (n, 3) body axes [rad/s]

    Raises
    ------
    InputError
        For values out of range, shapes that do not fit, and from when the disc has fallen flat.

    Notes
    -----
    The equations of ``rolling_disc`` have no closed form in elementary functions. Dormand and Prince's
    method of order 8 (Hairer, Nørsett & Wanner, *Solving Ordinary Differential Equations I*, § II.5) goes
    from one time to the next at a relative tolerance of 1e-13.
    """
    m, r, I1, I3, g = disc("disc", mass, radius, moments, gravity)
    q0, omega0, t = unit_quaternion("q0", q0), finite("omega0", omega0, (3,)), times("t", t)
    angles = zxz_angles(q0)
    if math.sin(angles[1]) < FLAT:
        raise InputError(f"q0: got {q0.tolist()}, expected a disc that stands on its rim, not a flat one")
    # With r and √(r/g) for units, tolerances mean the same for a coin and a millstone.
    second = math.sqrt(r / g)
    heading, lean, _ = zxz_rates(angles, omega0) * second
    start = np.array([0.0, 0.0, *angles, heading, lean, omega0[2] * second])
    I1, I3 = I1 / (m * r * r), I3 / (m * r * r)
    y = _sampled(lambda _, y: _rates(I1, I3, y), start, t / second)
    angles, theta, (heading, lean, omega3) = y[:, 2:5], y[:, 3], y[:, 5:].T / second
    nodes = zxz_attitude(angles * [1.0, 1.0, 0.0])  # the axes e1, e2, e3
    velocity = quaternions.rotated(nodes, r * np.column_stack([-omega3, 0 * omega3, lean]))
    centre = finite("place", place, (2,)) + r * y[:, :2]
    rates = np.column_stack([heading, lean, omega3 - heading * np.cos(theta)])
    position = np.column_stack([centre, r * np.sin(theta)])
    return position, zxz_attitude(angles), velocity, zxz_omega(angles, rates)


def _rates(I1: float, I3: float, y: Array) -> list[float]:
    """Of x, y, φ, θ, ψ, φ̇, θ̇, ω3 where m = r = g = 1; see ``rolling_disc.accelerations``."""
    _, _, phi, theta, _, heading, lean, omega3 = y.tolist()
    s, c = math.sin(theta), math.cos(theta)
    if s < FLAT:
        raise InputError("t: by then the disc has fallen flat")
    leaning = (I1 * heading**2 * s * c - (I3 + 1) * omega3 * heading * s - c) / (I1 + 1)
    turning = (I3 * omega3 - 2 * I1 * heading * c) * lean / (I1 * s)
    spinning = heading * lean * s / (I3 + 1)
    # v = θ̇ e3 − ω3 e1, with e1 = (cosφ, sinφ, 0) and e3 = (sinθ sinφ, −sinθ cosφ, cosθ).
    vx = lean * s * math.sin(phi) - omega3 * math.cos(phi)
    vy = -lean * s * math.cos(phi) - omega3 * math.sin(phi)
    return [vx, vy, heading, lean, omega3 - heading * c, turning, leaning, spinning]


def _sampled(rates: Callable[[float, Array], list[float]], start: Array, t: Array) -> Array:
    """States (n, k) at the times ``t``: integrated outward from 0, from each sample to the next."""
    states = np.empty((len(t), len(start)))
    for half in (np.flatnonzero(t >= 0), np.flatnonzero(t < 0)):
        now, y = 0.0, start
        for index in half[np.argsort(np.abs(t[half]), kind="stable")]:
            if t[index] != now:
                span = (now, t[index])
                step = _integrate.solve_ivp(rates, span, y, method="DOP853", rtol=1e-13, atol=1e-14)
                now, y = float(t[index]), step.y[:, -1]
            states[index] = y
    return states
