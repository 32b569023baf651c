"""A disc or hoop that rolls on a level plane without slipping: its equations, steady motions, stability.

θ is the angle from the vertical to the disc's axis e3 (π/2 when it stands upright), φ the heading of the
line of nodes e1, level and in the disc's plane; e2 = e3×e1 points up the disc, and the contact is at −r e2.
With s = sinθ, c = cosθ, J = I3 + mr² and v = r(θ̇ e3 − ω3 e1) the velocity of the centre, the force at the
contact from Newton's law put into Euler's equations gives

    (I1 + mr²) θ̈ = I1 φ̇² s c − J ω3 φ̇ s − mgr c
    I1 s φ̈ = I3 ω3 θ̇ − 2 I1 φ̇ θ̇ c
    J ω̇3 = mr² φ̇ θ̇ s

(derived here; Routh, *Advanced Rigid Dynamics*, and Neimark & Fufaev, *Dynamics of Nonholonomic Systems*,
treat the disc). I1 is the moment about a diameter, I3 about the axis, both through the centre.
"""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from .checked import Array, finite, number, positive, principal_moments
from .errors import InputError


class Wobble(NamedTuple):
    """Small departure from a steady motion: one of the two is 0."""

    frequency: float  # if it swings [rad/s]
    growth: float  # if it grows [1/s]


def accelerations(
    mass: float,
    radius: float,
    moments: npt.ArrayLike,
    gravity: float,
    theta: npt.ArrayLike,
    theta_rate: npt.ArrayLike,
    phi_rate: npt.ArrayLike,
    omega3: npt.ArrayLike,
) -> tuple[Array, Array, Array]:
    """Rates θ̈, φ̈ and ω̇3 (...) [rad/s²] of the equations above.

    Parameters
    ----------
    mass, radius, moments, gravity : m [kg], r [m], (I1, I3) about the centre [kg m²], g [m/s²]
    theta : (...) angle of the axis from the vertical, above 0 and below π [rad]
    theta_rate, phi_rate : (...) θ̇, φ̇ [rad/s]
    omega3 : (...) component of ω along the disc's axis [rad/s]

    Raises
    ------
    InputError
        For values out of range, and for a disc that lies flat.
    """
    m, r, I1, I3, g = disc("disc", mass, radius, moments, gravity)
    theta, theta_rate = finite("theta", theta), finite("theta_rate", theta_rate)
    phi_rate, omega3 = finite("phi_rate", phi_rate), finite("omega3", omega3)
    s, c, J = np.sin(theta), np.cos(theta), I3 + m * r**2
    if np.any((theta <= 0) | (theta >= np.pi)):
        raise InputError(f"theta: got {theta.tolist()}, expected between 0 and π: flat, a disc cannot roll")
    leaning = I1 * phi_rate**2 * s * c - J * omega3 * phi_rate * s - m * g * r * c
    heading = (I3 * omega3 - 2 * I1 * phi_rate * c) * theta_rate
    spinning = m * r**2 * phi_rate * theta_rate * s
    return leaning / (I1 + m * r**2), heading / (I1 * s), spinning / J


def steady_spin(
    mass: float, radius: float, moments: npt.ArrayLike, gravity: float, theta: float, phi_rate: float
) -> float:
    """The ω3 [rad/s] with which the disc rolls round a circle at constant θ [rad] and φ̇ [rad/s], not 0.

    ω3 = I1φ̇c/J − mgr c/(Jφ̇ s). The centre circles at radius r|ω3/φ̇|. Raises as ``accelerations``.
    """
    m, r, I1, I3, g = disc("disc", mass, radius, moments, gravity)
    theta, Omega = _leaning(theta), number("phi_rate", phi_rate)
    if Omega == 0:
        raise InputError("phi_rate: got 0, expected another: rolling straight on is steady only upright")
    s, c, J = np.sin(theta), np.cos(theta), I3 + m * r**2
    return float((I1 * Omega * c - m * g * r * c / (Omega * s)) / J)


def steady_wobble(
    mass: float,
    radius: float,
    moments: npt.ArrayLike,
    gravity: float,
    theta: float,
    phi_rate: float,
    omega3: float,
) -> Wobble:
    """Frequency or growth of a small change of lean about a steady motion.

    Arguments as for ``accelerations``, of a steady motion: θ̈ = 0 (straight upright rolling, φ̇ = 0, any
    ω3; spinning upright on the spot, ω3 = 0, any φ̇; ``steady_spin``). Raises InputError where it is not.

    Notes
    -----
    Along with the lean, the integrals of the last two equations change φ̇ by (I3ω3 − 2I1φ̇c)/(I1 s) and ω3
    by mr²φ̇s/J per radian; put into the first, they leave one oscillator.
    """
    m, r, I1, I3, g = disc("disc", mass, radius, moments, gravity)
    theta, Omega, w3 = _leaning(theta), number("phi_rate", phi_rate), number("omega3", omega3)
    s, c, J, weight = np.sin(theta), np.cos(theta), I3 + m * r**2, m * g * r
    terms = [I1 * Omega**2 * s * c, -J * w3 * Omega * s, -weight * c]
    # The caller's θ or ω3 is rounded: that much of a mismatch is still the steady motion.
    if abs(sum(terms)) > 1e-9 * (np.abs(terms).max() + weight * s):
        raise InputError(f"theta, phi_rate, omega3: got {theta}, {Omega}, {w3}, which is no steady motion")
    by_lean = I1 * Omega**2 * (c * c - s * s) - J * w3 * Omega * c + weight * s
    by_heading = (2 * I1 * Omega * c - J * w3) * (I3 * w3 - 2 * I1 * Omega * c) / I1
    by_spin = -m * r**2 * Omega**2 * s * s
    growth_squared = float((by_lean + by_heading + by_spin) / (I1 + m * r**2))
    if growth_squared > 0:
        return Wobble(0.0, float(np.sqrt(growth_squared)))
    return Wobble(float(np.sqrt(-growth_squared)), 0.0)


def upright_threshold(mass: float, radius: float, moments: npt.ArrayLike, gravity: float) -> float:
    """Least ω3 [rad/s] at which upright rolling is stable: ω3² = I1 mgr/(I3 J).

    A speed squared of gr/4 for a hoop, gr/3 for a disc. Raises as ``accelerations``.
    """
    m, r, I1, I3, g = disc("disc", mass, radius, moments, gravity)
    return float(np.sqrt(I1 * m * g * r / (I3 * (I3 + m * r**2))))


def spinning_threshold(mass: float, radius: float, moments: npt.ArrayLike, gravity: float) -> float:
    """Least φ̇ [rad/s] at which spinning upright on the spot is stable: φ̇² = mgr/(I1 + mr²).

    Raises as ``accelerations``.
    """
    m, r, I1, _, g = disc("disc", mass, radius, moments, gravity)
    return float(np.sqrt(m * g * r / (I1 + m * r**2)))


def disc(
    name: str, mass: float, radius: float, moments: npt.ArrayLike, gravity: float
) -> tuple[float, float, float, float, float]:
    """m, r, I1, I3 and g, checked: positive, and moments that some body has."""
    I1, I3 = finite("moments", moments, (2,))
    principal_moments(name, [I1, I1, I3])
    return positive("mass", mass), positive("radius", radius), I1, I3, positive("gravity", gravity)


def _leaning(theta: float) -> float:
    theta = number("theta", theta)
    if not 0 < theta < np.pi:
        raise InputError(f"theta: got {theta}, expected between 0 and π: flat, a disc cannot roll")
    return theta
