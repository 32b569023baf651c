"""Where down is on a turning planet, and how a pendulum hangs at rest on whatever turns."""

from typing import NamedTuple

import numpy as np

from .checked import not_negative, number, positive, within
from .errors import InputError


class EffectiveGravity(NamedTuple):
    """Gravity as a plumb line and a spring balance show it on a turning planet [m/s², rad]."""

    radial: float  # towards the centre
    tangential: float  # towards the equator, positive in either hemisphere
    magnitude: float
    deflection: float  # angle of the plumb line from the line to the centre, towards the equator


def effective_gravity(gravity: float, Omega: float, radius: float, colatitude: float) -> EffectiveGravity:
    """What turning makes of the gravity of a round planet.

    Parameters
    ----------
    gravity : g0, pull of the planet at its surface [m/s²]
    Omega : its angular velocity [rad/s]
    radius : R [m]
    colatitude : θ from either pole to the other, 0 to π [rad]

    Raises
    ------
    InputError
        For values out of range, or a planet that turns so fast that its ground is thrown off.

    Notes
    -----
    radial g0 − Ω²R sin²θ, tangential Ω²R sinθ cosθ, their quotient the deflection's tangent: Taylor,
    sect. 9.6. On Earth 0.0017 rad at 45°, and 0.3 % of g at the equator.
    """
    g0, Omega, R = positive("gravity", gravity), number("Omega", Omega), positive("radius", radius)
    theta = within("colatitude", colatitude, 0.0, np.pi)
    _refuse_flying(g0, Omega, R)
    radial = g0 - Omega**2 * R * np.sin(theta) ** 2
    tangential = Omega**2 * R * np.sin(theta) * abs(np.cos(theta))
    return EffectiveGravity(
        float(radial),
        float(tangential),
        float(np.hypot(radial, tangential)),
        float(np.arctan2(tangential, radial)),
    )


def pendulum_on_a_planet(
    gravity: float, Omega: float, radius: float, colatitude: float, length: float
) -> float:
    """Angle [rad] from the line to the centre, towards the equator, of a pendulum at rest on a planet.

    The bob is nearer the axis than the pivot, and is flung out less: this is the exact angle of a bob on
    a string of ``length`` [m] from a pivot at ``radius``, in a field g0 of constant size and the
    direction that it has at the pivot. As length → 0 it is ``effective_gravity``'s deflection.
    Other arguments and errors as there.
    """
    g0, Omega, R = positive("gravity", gravity), number("Omega", Omega), positive("radius", radius)
    L, theta = not_negative("length", length), within("colatitude", colatitude, 0.0, np.pi)
    _refuse_flying(g0, Omega, R + L)
    if L > R:
        raise InputError(f"length: got {L}, expected at most the radius {R}")
    theta = min(theta, np.pi - theta)
    return _rest_angle(g0, Omega, R * np.sin(theta), L, theta)


def pendulum_on_a_turntable(gravity: float, Omega: float, distance: float, length: float) -> float:
    """Angle [rad] from the vertical, outward, of a pendulum at rest on a turntable.

    Parameters
    ----------
    gravity : g [m/s²]
    Omega : angular velocity about the vertical [rad/s]
    distance : of the pivot from the axis [m]; with 0 this is the conical pendulum
    length : of the pendulum [m]

    Raises
    ------
    InputError
        For values out of range.

    Notes
    -----
    tan φ = Ω²(d + L sinφ)/g (Taylor, sect. 9.6, in the turning frame). For d = 0 the pendulum hangs
    down up to Ω² = g/L and beyond that swings out to cos φ = g/(Ω²L), its only stable rest.
    """
    g, Omega = positive("gravity", gravity), number("Omega", Omega)
    d, L = not_negative("distance", distance), positive("length", length)
    if d == 0:
        # (1 − c)(1 + c) keeps the digits of a small angle that the arc cosine would lose.
        swing = max(Omega**2 * L - g, 0.0)
        return float(np.arctan2(np.sqrt(swing * (Omega**2 * L + g)), g))
    return _rest_angle(g, Omega, d, L, 0.0)


def _refuse_flying(gravity: float, Omega: float, radius: float) -> None:
    if Omega**2 * radius >= gravity:
        raise InputError(
            f"Omega: got {Omega}, expected below {np.sqrt(gravity / radius)} in size: "
            "faster, the equator would be thrown off"
        )


def _rest_angle(gravity: float, Omega: float, distance: float, length: float, tilt: float) -> float:
    """The angle δ where gravity and the centrifugal force balance across the string.

    g sinδ = Ω²ρ cos(θ − δ), ρ = d − L sin(θ − δ) the bob's distance from the axis, θ (``tilt``) the
    angle of the field to the axis, d the pivot's ``distance``; solved for u = tanδ.
    """
    s, c = np.sin(tilt), np.cos(tilt)
    most = Omega**2 * (distance + length)
    u = most * c / (gravity - most * s)  # as if the bob were as far out as it can be: never too small
    # Newton's steps come down on the root from above; only next to a threshold do they take long.
    for _ in range(100):
        root = np.sqrt(1 + u * u)
        rho = distance + length * (c * u - s) / root
        outward = c + s * u
        slope = gravity - Omega**2 * (rho * s + length * outward**2 / root**3)
        step = (gravity * u - Omega**2 * rho * outward) / slope
        u -= step
        if abs(step) <= np.finfo(np.float64).eps * abs(u):
            break
    return float(np.arctan(u))
