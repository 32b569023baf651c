"""A round body on an incline: it rolls, slips, or slips until it rolls."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from .checked import Array, not_negative, number, positive, times, within
from .errors import InputError

#: k²/a² of common shapes, k the radius of gyration about the axis, a the radius [1].
GYRATION = {"hoop": 1.0, "disc": 0.5, "cylinder": 0.5, "sphere": 0.4, "thin hollow sphere": 2.0 / 3.0}


class Rolling(NamedTuple):
    """Motion at n times; x and v down the slope, the turn such that rolling down is positive."""

    x: Array  # (n,) of the centre [m]
    v: Array  # (n,) [m/s]
    angle: Array  # (n,) [rad]
    omega: Array  # (n,) [rad/s]
    slip: Array  # (n,) v − aω, velocity of the point of contact [m/s]
    friction: Array  # (n,) acceleration of the centre by friction, up the slope positive [m/s²]


def rolling_acceleration(gravity: float, slope: float, gyration: float) -> float:
    """Acceleration g sinθ/(1 + k²/a²) [m/s²], of a body that rolls without slipping.

    ``slope`` θ is −π/2 to π/2 [rad], ``gyration`` k²/a² ≥ 0. Goldstein, sect. 2.4 (a hoop).
    """
    g, kk = not_negative("gravity", gravity), not_negative("gyration", gyration)
    return float(g * np.sin(within("slope", slope, -np.pi / 2, np.pi / 2)) / (1 + kk))


def slipping_slope(friction: float, gyration: float) -> float:
    """Steepest slope [rad] on which a body can roll: tanθ = μ(1 + a²/k²), a right angle for k = 0.

    Beyond it the friction that rolling needs, mg sinθ/(1 + a²/k²), is more than μ mg cosθ.
    """
    mu, kk = not_negative("friction", friction), not_negative("gyration", gyration)
    return float(np.arctan2(mu * (1 + kk), kk)) if kk > 0 else np.pi / 2


def down_an_incline(
    radius: float,
    gyration: float,
    gravity: float,
    slope: float,
    friction: float,
    t: npt.ArrayLike,
    v0: float = 0.0,
    omega0: float = 0.0,
) -> Rolling:
    """Motion of a round body on an incline with Coulomb's friction, from any start.

    Parameters
    ----------
    radius : a [m]
    gyration : k²/a², moment of inertia over ma² [1]; see ``GYRATION``
    gravity : g [m/s²]
    slope : θ, −π/2 to π/2, positive where x goes downhill [rad]
    friction : μ, the same at rest and in motion [1]
    t : (n,) times, 0 or later [s]
    v0, omega0 : velocity down the slope [m/s] and turning [rad/s] at t = 0; (0, 0) is a start from rest

    Returns
    -------
    Rolling

    Raises
    ------
    InputError
        For values out of range.

    Notes
    -----
    While the contact slips at u = v − aω, friction is μg cosθ against u, so that u changes at
    g sinθ ∓ μg cosθ (1 + a²/k²). If it reaches 0 the body rolls from then on where tan|θ| ≤ μ(1 + a²/k²), and
    slips on downhill where the slope is steeper. Goldstein, sect. 2.4; Sommerfeld, *Mechanics*, ch. IV
    (billiard balls).
    """
    a, kk = positive("radius", radius), positive("gyration", gyration)
    g, mu, t = not_negative("gravity", gravity), not_negative("friction", friction), times("t", t)
    theta = within("slope", slope, -np.pi / 2, np.pi / 2)
    v0, u0 = number("v0", v0), number("v0", v0) - a * number("omega0", omega0)
    if np.any(t < 0):
        raise InputError(f"t: got {t.min()}, expected 0 or later: friction does not run backwards")
    pull, grip = g * np.sin(theta), mu * g * np.cos(theta)
    needed = pull * kk / (1 + kk)  # friction, up the slope, that rolling needs
    steady = needed if abs(needed) <= grip else np.copysign(grip, pull)
    first = steady if u0 == 0 else np.copysign(grip, u0)
    stops = _end_of_slip(u0, pull - first * (1 + 1 / kk))
    early, late = np.minimum(t, stops), np.maximum(t - stops, 0.0)
    friction_now = np.where(t < stops, first, steady)
    # Two stretches of constant acceleration, of the centre and of the turning, one after the other.
    x, v = _stretches(v0, pull - first, pull - steady, early, late)
    angle, omega = _stretches(omega0, first / (kk * a), steady / (kk * a), early, late)
    rolls = (t >= stops) & (abs(needed) <= grip)
    slip = np.where(rolls, 0.0, v - a * omega)
    return Rolling(x, v, angle, omega, slip, friction_now)


def _end_of_slip(slip: float, change: float) -> float:
    """When a slip [m/s] that changes at ``change`` [m/s²] reaches 0; infinite if it never does."""
    if slip == 0:
        return 0.0
    with np.errstate(over="ignore"):  # with next to no friction, later than any number
        return float(-slip / np.float64(change)) if np.sign(slip) == -np.sign(change) else np.inf


def _stretches(rate: float, first: float, second: float, early: Array, late: Array) -> tuple[Array, Array]:
    between = rate + first * early
    place = rate * early + 0.5 * first * early**2 + between * late + 0.5 * second * late**2
    return place, between + second * late
