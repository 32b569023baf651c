"""A rocket straight up, its mass falling as it burns at a steady rate."""

import numpy as np
import numpy.typing as npt

from .checked import Array, not_negative, number, positive, times
from .errors import InputError


def rocket_mass(mass: float, burning: float, t: npt.ArrayLike) -> Array:
    """Mass m0 − γt (n,) [kg] at times ``t`` (n,) [s]; raises InputError from where it would be used up."""
    m0, gamma, t = positive("mass", mass), not_negative("burning", burning), times("t", t)
    left = m0 - gamma * t
    if np.any(left <= 0):
        raise InputError(f"t: got {t.max()}, expected below {m0 / gamma}, when no mass is left")
    return np.asarray(left)


def rocket_motion(
    mass: float,
    burning: float,
    exhaust: float,
    gravity: float,
    t: npt.ArrayLike,
    z0: float = 0.0,
    v0: float = 0.0,
) -> tuple[Array, Array]:
    """Height and velocity while the motor burns.

    Parameters
    ----------
    mass : m0, at t = 0 [kg]
    burning : γ, mass burnt per time [kg/s]
    exhaust : u, speed of what is thrown out, relative to the rocket, downward [m/s]
    gravity : g, downward [m/s²]
    t : (n,) times before all is burnt [s]
    z0, v0 : height [m] and upward velocity [m/s] at t = 0

    Returns
    -------
    z, v : (n,) v = v0 − gt + u ln(m0/(m0 − γt)) [m], [m/s]

    Raises
    ------
    InputError
        For values out of range, and times at which no mass is left.

    Notes
    -----
    Taylor, sect. 3.2 and problem 3.11; z is its integral,
    z0 + v0 t − ½gt² + uτ [x + (1 − x) ln(1 − x)], τ = m0/γ, x = t/τ.
    """
    rocket_mass(mass, burning, t)
    u, g, t = not_negative("exhaust", exhaust), number("gravity", gravity), times("t", t)
    z0, v0 = number("z0", z0), number("v0", v0)
    used = np.minimum(burning / mass * t, np.nextafter(1.0, 0.0))  # not 1 by rounding: some mass is left
    v = v0 - g * t - u * np.log1p(-used)
    return z0 + v0 * t - 0.5 * g * t**2 + u * t * _gain(used), v


def _gain(x: Array) -> Array:
    """1 + (1 − x) ln(1 − x)/x: half of x at first, so that the formula itself would lose all digits."""
    small = np.abs(x) < 0.1
    series = np.zeros_like(x)
    for n in range(16, 1, -1):  # Σ xⁿ⁻¹/(n(n − 1)); the seventeenth term is below 1e-18 of the first
        series = (1 / (n * (n - 1)) + series) * np.where(small, x, 0.0)
    away = np.where(small, 1.0, x)
    closed = 1 + (1 - away) * np.log1p(-np.where(small, 0.0, x)) / away
    return np.where(small, series, closed)
