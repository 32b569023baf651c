"""A gyroscope hung by one end of its axle from a rope: two ball joints in a row.

The rope is a straight rod of length s from a fixed point, along the unit vector n; its moment about any axis
across it through the fixed point is J, its mass moment (mass times distance of the centre) P, and it does
not spin; J = P = 0 is a massless rope. The gyroscope, of mass M and moments (I1, I3) about the rope's end,
has its centre of mass at l on its axis e. With the force F = M(s n̈ + l ë + g ẑ) that the rope gives it, and
I1c = I1 − Ml², the angular momenta about the fixed point and about the centre of mass change as

    n × (J n̈ + s F + P g ẑ) = 0,    e × (I1c ë + l F) + I3ω3 ė = 0,    ω3 constant

(Goldstein, *Classical Mechanics*, § 1.2 and § 5.5, for each body by itself). With a rope of no length the
second is the heavy top's. z is up; directions and their rates are in world axes.
"""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
import scipy

from .checked import Array, finite, not_negative, number, positive, within
from .errors import InputError
from .heavy_top_constants import moments_of_a_top
from .quaternions import cross

_untyped: Any = scipy.optimize

#: How far a direction's length may be from 1, and the angle to its rate from a right one [1].
_TOLERANCE = 1e-9
_UNIT, _UP = np.eye(3), np.array([0.0, 0.0, 1.0])


class Rope(NamedTuple):
    """Length s [m], moment J about the fixed point [kg m²], and mass moment P [kg m]."""

    length: float
    inertia: float = 0.0
    mass_moment: float = 0.0


class Gyroscope(NamedTuple):
    """Mass M [kg], l from the rope's end to its centre [m], moments (I1, I3) about that end [kg m²]."""

    mass: float
    length: float
    moments: tuple[float, float]


class _System(NamedTuple):
    """Coefficients of n̈, of both mixed, and of ë; torque of the weight on each; I1c and I3."""

    rope: float
    mixed: float
    axle: float
    rope_weight: float
    axle_weight: float
    I3: float


def accelerations(
    rope: Rope,
    gyroscope: Gyroscope,
    gravity: float,
    directions: tuple[npt.ArrayLike, npt.ArrayLike],
    rates: tuple[npt.ArrayLike, npt.ArrayLike],
    omega3: float,
) -> tuple[Array, Array]:
    """n̈ and ë, (3,) each [1/s²], at the ``directions`` (n, e) and their ``rates`` (ṅ, ė) [1/s].

    ``gravity`` g [m/s²], ``omega3`` the gyroscope's rate about e [rad/s]. The module's equations, each
    crossed with its direction, solved together. Raises InputError for what is below 0, a gyroscope of no
    mass, I1 ≤ Ml², a rope without length or moment, directions that are not unit vectors, or rates that
    are not across them.
    """
    system = _moving(rope, gyroscope, gravity)
    n, n_rate = _direction("n", directions[0], rates[0])
    e, e_rate = _direction("e", directions[1], rates[1])
    along_n, along_e = n[:, None] * n, e[:, None] * e
    across_n, across_e = _UNIT - along_n, _UNIT - along_e
    mixed = system.mixed * across_n @ across_e
    # The outer products leave the unknown parts of n̈ and ë across n and e; along them they are known.
    matrix = np.empty((6, 6))
    matrix[:3, :3], matrix[:3, 3:] = system.rope * across_n + along_n, mixed
    matrix[3:, :3], matrix[3:, 3:] = mixed.T, system.axle * across_e + along_e
    n_inward, e_inward = -(n_rate @ n_rate) * n, -(e_rate @ e_rate) * e
    on_n = across_n @ (-system.rope_weight * _UP - system.mixed * e_inward)
    on_e = across_e @ (-system.axle_weight * _UP - system.mixed * n_inward)
    gyroscopic = system.I3 * number("omega3", omega3) * cross(e, e_rate)
    parts = np.linalg.solve(matrix, np.concatenate([on_n, on_e + gyroscopic]))
    return n_inward + parts[:3], e_inward + parts[3:]


def steady_precession(
    rope: Rope, gyroscope: Gyroscope, gravity: float, beta: float, Omega: float
) -> tuple[float, float]:
    """Tilt χ of the rope from straight down [rad], and ω3 [rad/s], at which all turns about z at ``Omega``.

    ``beta`` is the axle's tilt from straight up, between 0 and π [rad], ``Omega`` not 0 [rad/s]; rope and
    axle lean to the same side. With r = s sinχ + l sinβ, the module's equations become

        Ω² cosχ (J sinχ + Msr) = g sinχ (Ms + P),  Ω² cosβ (I1c sinβ + Mlr) − I3ω3Ω sinβ + Mgl sinβ = 0.

    Raises InputError as `accelerations` does, but for a rope without length or moment, and for no gravity.
    """
    system = _system(rope, gyroscope, positive("gravity", gravity))
    beta, square = within("beta", beta, 0.0, np.pi), number("Omega", Omega) ** 2
    sine, cosine = np.sin(beta), np.cos(beta)
    if square == 0 or sine == 0:
        raise InputError(f"beta, Omega: got {beta}, {Omega}; expected a tilted axle that goes round")
    # Convex in χ from 0 to π/2, below 0 at the one and above at the other: one root.
    chi = 0.0
    if system.rope_weight:
        chi = _untyped.brentq(
            lambda x: (
                square * np.cos(x) * (system.rope * np.sin(x) + system.mixed * sine)
                - system.rope_weight * np.sin(x)
            ),
            0.0,
            np.pi / 2,
            xtol=1e-16,
        )
    torque = square * cosine * (system.axle * sine + system.mixed * np.sin(chi)) + system.axle_weight * sine
    return float(chi), float(torque / (system.I3 * Omega * sine))


def small_rates(
    rope: Rope, gyroscope: Gyroscope, gravity: float, omega3: float, upright: bool = False
) -> npt.NDArray[np.complex128]:
    """Rates ν (4,) [rad/s] of the small motions exp(iνt) with the rope straight down, in order of Re ν.

    The axle hangs below the rope, or stands ``upright`` on its end: σ = −1 or 1. Horizontal parts x + iy of
    n and e obey ν²(Aζ + Bη) = Cζ, ν²(Bζ + I1η) − σνI3ω3η = −σMglη with A = J + Ms², B = Msl, C = (Ms + P)g.
    Below 0 the imaginary part is a growth rate. Raises InputError as `accelerations` does.
    """
    system = _moving(rope, gyroscope, gravity)
    sigma = 1.0 if upright else -1.0
    inertia = np.array([[system.rope, system.mixed], [system.mixed, system.axle]])
    stiffness = np.diag([system.rope_weight, -sigma * system.axle_weight])
    spin = np.diag([0.0, sigma * system.I3 * number("omega3", omega3)])
    lower = np.linalg.solve(inertia, np.hstack([stiffness, spin]))
    first_order = np.vstack([np.eye(2, 4, 2), lower])
    found = np.linalg.eigvals(first_order).astype(np.complex128)
    result: npt.NDArray[np.complex128] = found[np.lexsort((found.imag, found.real))]
    return result


def _system(rope: Rope, gyroscope: Gyroscope, gravity: float) -> _System:
    M, length = positive("gyroscope.mass", gyroscope.mass), not_negative("gyroscope.length", gyroscope.length)
    I1, I3 = moments_of_a_top(gyroscope.moments)
    s, J = not_negative("rope.length", rope.length), not_negative("rope.inertia", rope.inertia)
    P, g = not_negative("rope.mass_moment", rope.mass_moment), not_negative("gravity", gravity)
    if M * length**2 >= I1:
        raise InputError(
            f"moments: got I1 = {I1}, expected more than M l² = {M * length**2}, about the rope's end"
        )
    return _System(J + M * s * s, M * s * length, I1, (M * s + P) * g, M * length * g, I3)


def _moving(rope: Rope, gyroscope: Gyroscope, gravity: float) -> _System:
    system = _system(rope, gyroscope, gravity)
    if not system.rope:
        raise InputError(f"rope: got {rope}, expected a length above 0 or a moment: n means nothing without")
    return system


def _direction(name: str, direction: npt.ArrayLike, rate: npt.ArrayLike) -> tuple[Array, Array]:
    unit, across = finite(name, direction, (3,)), finite(f"{name}_rate", rate, (3,))
    if abs(unit @ unit - 1) > _TOLERANCE:
        raise InputError(
            f"{name}: got length {np.sqrt(unit @ unit)}, expected a unit vector to {_TOLERANCE:g}"
        )
    if abs(unit @ across) > _TOLERANCE * np.sqrt(across @ across):
        raise InputError(f"{name}_rate: got {across.tolist()}, expected a rate across {unit.tolist()}")
    return unit, across
