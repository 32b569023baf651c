"""Rates of a heavy symmetric top that people quote: its nutation, its mean precession, the textbook limits.

Arguments are those of `heavy_top.motion`, and so is what raises InputError. Goldstein, *Classical Mechanics*,
§ 5.7; Landau & Lifshitz, *Mechanics*, § 35, problem 1.
"""

from fractions import Fraction
from typing import Any, NamedTuple

import numpy.typing as npt

from .checked import finite, number
from .errors import InputError
from .heavy_top_case import Factor, case
from .heavy_top_constants import Constants, constants, is_steady, moments_of_a_top, real, weight_moment
from .heavy_top_roots import roots
from .heavy_top_steady import rates
from .precise import mp


class TurningPoints(NamedTuple):
    """cos β at the lowest and at the highest place of the axis, and the tilts β there [rad]."""

    lowest: float
    highest: float
    beta_lowest: float
    beta_highest: float


def turning_points(
    mass: float,
    length: float,
    moments: npt.ArrayLike,
    gravity: float,
    q0: npt.ArrayLike,
    omega0: npt.ArrayLike,
) -> TurningPoints:
    """Between which tilts the axis nutates: roots u1 ≤ u2 of u̇² = f(u), u = cos β, of any motion.

    β_lowest − β_highest is the nutation's width. Goldstein § 5.7.
    """
    motion = constants(mass, length, moments, gravity, q0, omega0)
    d1, d2, over1, over2 = _turning(motion)
    return TurningPoints(float(1 - d1), float(1 - d2), _tilt(d1, over1), _tilt(d2, over2))


def nutation_period(
    mass: float,
    length: float,
    moments: npt.ArrayLike,
    gravity: float,
    q0: npt.ArrayLike,
    omega0: npt.ArrayLike,
) -> float:
    """Time [s] from one lowest place of the axis to the next: 2K(m)/p, p = ½√(k(u3 − u1)).

    For regular precession and the sleeping top it is that of the least nutation; infinite on the
    separatrix, for an upright top that does not sleep, and for a body at rest without gravity.
    Goldstein § 5.7; Whittaker & Watson § 22.
    """
    motion = constants(mass, length, moments, gravity, q0, omega0)
    if not motion.k:
        return _quotient(2 * mp.pi, mp.sqrt(real(motion.e + motion.a**2)))
    if is_steady(motion):
        # The third root of the cubic, from the sum of all: the square of the frequency is k (d0 − d3).
        square = 3 * motion.k * motion.d0 + motion.e + motion.a**2 - 2 * motion.k
        return _quotient(2 * mp.pi, mp.sqrt(real(max(square, Fraction(0)))))
    this = case(motion, roots(motion))
    return float(2 * this.modulus.lattice.K / this.rate)


def mean_precession(
    mass: float,
    length: float,
    moments: npt.ArrayLike,
    gravity: float,
    q0: npt.ArrayLike,
    omega0: npt.ArrayLike,
) -> float:
    """Mean rate [rad/s] at which the axis goes round the vertical, nutation averaged out.

    The angle gained in a nutation period over that period. Where the axis passes through the vertical its
    azimuth jumps by π, forth or back: the mean of the two is given (0 for a plane pendulum). On the
    separatrix it is the rate in the long run. Raises InputError where the axis is vertical for ever.
    Source: Klein & Sommerfeld, *Über die Theorie des Kreisels*, ch. VI.
    """
    motion = constants(mass, length, moments, gravity, q0, omega0)
    if not motion.across and motion.d0 in (0, 2):
        raise InputError(
            f"q0: got {finite('q0', q0).tolist()}, with its axis vertical for ever: no precession"
        )
    if not motion.k:
        turns = _sign(2 * motion.a + motion.c) + _sign(motion.c)
        return float(turns * mp.sqrt(real(motion.e + motion.a**2)) / 2)
    if is_steady(motion):
        return float(sum(real(rate) for rate in rates(motion)[:2]))
    this = case(motion, roots(motion))
    alpha, beta, _ = this.factors
    # Each half of a swing of θ1 or θ2 above the real axis turns its argument back by π, below it forth.
    winding = mp.pi * (_side(alpha) + _side(beta)) * this.rate / (2 * this.modulus.lattice.K)
    return float(alpha.rate + beta.rate - winding)


def weak_torque_precession(mass: float, length: float, I3: float, gravity: float, omega3: float) -> float:
    """The books' precession rate of a fast top [rad/s]: Mgl/(I3ω3), whatever its tilt.

    ``omega3`` [rad/s] about e3, not 0. Goldstein § 5.7 (mean precession of a fast top); Landau & Lifshitz
    § 35, problem 3; Taylor § 10.6. `weak_torque_error` says how good it is.
    """
    moments_of_a_top([I3, I3])
    if number("omega3", omega3) == 0:
        raise InputError("omega3: got 0, expected a spin: without one there is no slow precession")
    return float(real(weight_moment(mass, length, gravity)) / (mp.mpf(I3) * omega3))


def weak_torque_error(
    mass: float, length: float, moments: npt.ArrayLike, gravity: float, theta: float, omega3: float
) -> float:
    """By which part of the slow regular precession Mgl/(I3ω3) is off it, at the tilt ``theta`` [rad].

    (√(1 − x) − 1)/2, x = 4MglI1 cosθ/(I3ω3)²: about −MglI1 cosθ/(I3ω3)² for a fast top, 0 at the
    horizontal, −½ at most. From `heavy_top.regular_precession`; raises InputError where x > 1.
    """
    I1, I3 = moments_of_a_top(moments)
    spin = mp.mpf(I3) * number("omega3", omega3)
    x = 4 * real(weight_moment(mass, length, gravity)) * I1 * mp.cos(number("theta", theta))
    if not spin or x > spin * spin:
        raise InputError(f"omega3: got {omega3}, too slow for regular precession at theta = {theta}")
    x /= spin * spin
    return float(-x / (2 * (1 + mp.sqrt(1 - x))))


def fast_top_nutation(
    mass: float, length: float, moments: npt.ArrayLike, gravity: float, theta: float, omega3: float
) -> tuple[float, float]:
    """A fast top's nutation when released at rest at ``theta``: its rate and its width, both [rad/s], [rad].

    I3ω3/I1, and 2MglI1 sinθ/(I3ω3)² between the turning points: first order in Mgl I1/(I3ω3)². Goldstein
    § 5.7 (the fast top).
    """
    I1, I3 = moments_of_a_top(moments)
    spin = mp.mpf(I3) * number("omega3", omega3)
    if not spin:
        raise InputError("omega3: got 0, expected a spin: this is the limit of a fast one")
    width = 2 * real(weight_moment(mass, length, gravity)) * I1 * mp.sin(number("theta", theta)) / spin**2
    return float(abs(spin) / I1), float(width)


def _turning(motion: Constants) -> tuple[Any, Any, Any, Any]:
    """The d = 1 − cos β at the lowest and at the highest place, and 2 − d there."""
    k, a, c, e, d0 = motion[:5]
    if k and not is_steady(motion):
        found = roots(motion)
        return found.d1, found.from_upright[0], found.from_hanging[0], found.from_hanging[1]
    if k or not e + a * a:
        return real(d0), real(d0), 2 - real(d0), 2 - real(d0)
    # Without gravity f is of second degree: (e + a²) d² − 2(e − ac) d + c².
    size, middle = real(e + a * a), real((e - a * c) / (e + a * a))
    width = mp.sqrt(real(e * (e - 2 * a * c - c * c))) / size
    # The lesser of each pair from the product of both, which is c² at d = 0 and (2a + c)² at d = 2.
    d1, over2 = middle + width, 2 - middle + width
    d2 = real(c * c) / (size * d1) if d1 else d1
    over1 = real((2 * a + c) ** 2) / (size * over2) if over2 else over2
    return d1, d2, over1, over2


def _tilt(d: Any, over: Any) -> float:
    return float(2 * mp.atan2(mp.sqrt(d), mp.sqrt(over)))


def _quotient(numerator: Any, denominator: Any) -> float:
    return float(numerator / denominator) if denominator else float("inf")


def _sign(x: Any) -> int:
    return int(x > 0) - int(x < 0)


def _side(factor: Factor) -> int:
    """Above (1), below (−1) or on (0) the real axis."""
    return _sign(factor.height)
