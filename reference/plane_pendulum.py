"""A pendulum in a plane at any amplitude: to and fro, over the top, and on the line between the two.

θ̈ = −ω0² sin θ, θ from the downward vertical. With e = sin²(θ/2) + (θ̇/2ω0)² it swings below e = 1, as
sin(θ/2) = √e sn(ω0 t), and goes round above, as sin(θ/2) = sn(√e ω0 t); on e = 1 it creeps to the top.

Source: Landau & Lifshitz, *Mechanics*, § 11, problem 1 (the period); Whittaker, *Analytical Dynamics*,
§ 44 (the motion in Jacobi's functions).
"""

from typing import Any

import numpy as np
import numpy.typing as npt

from . import elliptic
from .checked import Array, finite, not_negative, number, positive, times
from .double_double import LARGEST_PHASE
from .errors import InputError
from .precise import mp


def motion(
    gravity: float, length: float, theta0: float, rate0: float, t: npt.ArrayLike
) -> tuple[Array, Array]:
    """Angle and its rate at the times t.

    Parameters
    ----------
    gravity, length : float
        [m/s², m], above 0.
    theta0, rate0 : float
        At t = 0 [rad, rad/s]; any angle, whole turns are kept.
    t : (n,)
        Times of either sign [s]; a single number counts as one.

    Returns
    -------
    theta, rate : (n,)
        [rad, rad/s]; θ is continuous, it counts the turns of a pendulum that goes round.

    Raises
    ------
    InputError
        Numbers that are not finite, gravity or length not above 0, times past 10¹⁵ swings.

    Source: Whittaker § 44.
    """
    square = mp.mpf(positive("gravity", gravity)) / mp.mpf(positive("length", length))
    return swing(square, mp.mpf(number("theta0", theta0)), mp.mpf(number("rate0", rate0)), times("t", t))


def acceleration(gravity: float, length: float, theta: npt.ArrayLike) -> Array:
    """θ̈ = −(g/l) sin θ [rad/s²] at angles of any shape [rad]; raises as `motion`. Source: L&L § 11."""
    return -positive("gravity", gravity) / positive("length", length) * np.sin(finite("theta", theta))


def period(gravity: float, length: float, amplitude: float) -> float:
    """Time of a full swing [s] of a given amplitude [rad]: 4K(sin²(a/2))/ω0 = 2π/(ω0 agm(1, cos(a/2))).

    Raises InputError unless gravity and length are above 0 and the amplitude is from 0 to below π.
    Source: Landau & Lifshitz § 11, problem 1; the mean of arithmetic and geometric mean is Gauss's.
    """
    square = mp.mpf(positive("gravity", gravity)) / mp.mpf(positive("length", length))
    return swing_period(square, amplitude)


def rotation_period(gravity: float, length: float, rate_below: float) -> float:
    """Time of a full turn [s] of a pendulum that passes its lowest point at a rate above 2ω0 [rad/s].

    2K(1/e)/(√e ω0) with e = (rate/2ω0)². Raises InputError for a slower one: it does not go round.
    Source: Whittaker § 44.
    """
    square = mp.mpf(positive("gravity", gravity)) / mp.mpf(positive("length", length))
    e = mp.mpf(number("rate_below", rate_below)) ** 2 / (4 * square)
    if e <= 1:
        least = float(2 * mp.sqrt(square))
        raise InputError(f"rate_below: got {rate_below}, expected a magnitude above 2√(g/l) = {least}")
    # e·agm² with agm(1, √(1 − 1/e)) = agm(√e, √(e − 1))/√e.
    return float(mp.pi / (mp.sqrt(square) * mp.agm(mp.sqrt(e), mp.sqrt(e - 1))))


def swing_period(square: Any, amplitude: float) -> float:
    """`period` for a given ω0² (number of precise.mp) [1/s²]."""
    a = not_negative("amplitude", amplitude)
    if a >= np.pi:
        raise InputError(f"amplitude: got {a}, expected less than π: there it stands on its head")
    return float(2 * mp.pi / (mp.sqrt(square) * mp.agm(1, mp.cos(mp.mpf(a) / 2))))


def swing(square: Any, theta0: Any, rate0: Any, t: Array) -> tuple[Array, Array]:
    """θ and θ̇ (n,) of θ̈ = −ω0² sin θ for a given ω0² and start (numbers of precise.mp) at times t (n,)."""
    turns = mp.nint(theta0 / (2 * mp.pi))
    if abs(turns) > LARGEST_PHASE:
        raise InputError(f"theta0: got {float(theta0)}, expected less than {LARGEST_PHASE:g} whole turns")
    half = theta0 / 2 - mp.pi * turns
    s, c, p = mp.sin(half), mp.cos(half), rate0 / (2 * mp.sqrt(square))
    # Exact to fifty digits: beside a separatrix e − 1 is what decides.
    e, below = s * s + p * p, c * c - p * p
    if e == 0:
        theta, rate = np.zeros_like(t), np.zeros_like(t)
    elif below > 0:
        theta, rate = _to_and_fro(mp.sqrt(square), e, below, (s, c, p), t)
    else:
        theta, rate = _round(mp.sqrt(square), e, below, (s, c, p), t)
    return theta + float(2 * mp.pi * turns), rate


def _to_and_fro(omega: Any, e: Any, below: Any, start: Any, t: Array) -> tuple[Array, Array]:
    s, c, p = start
    modulus, root = elliptic.modulus(e, below), mp.sqrt(e)
    u0 = elliptic.first_kind(s / root, abs(p) / root, c)
    if p < 0:
        u0 = 2 * modulus.lattice.K - u0
    sn, cn, dn = elliptic.jacobi(modulus, elliptic.phase(modulus, omega, u0, t))
    return 2 * np.arctan2(float(root) * sn, dn), float(2 * omega * root) * cn


def _round(omega: Any, e: Any, below: Any, start: Any, t: Array) -> tuple[Array, Array]:
    # Also the separatrix itself, where 1/e = 1 and both forms are one.
    s, c, p = start
    way, root = int(mp.sign(p)), mp.sqrt(e)
    modulus = elliptic.modulus(1 / e, -below / e)
    phase = elliptic.phase(modulus, omega * root, elliptic.first_kind(way * s, c, abs(p) / root), t)
    sn, cn, dn = elliptic.jacobi(modulus, phase)
    half = np.arctan2(sn, cn)
    # am u is within a quarter turn of (π/2)·(u/K) rounded.
    half += 2 * np.pi * np.rint(phase.quarter / 4 - half / (2 * np.pi))
    return 2 * way * half, way * float(2 * omega * root) * dn
