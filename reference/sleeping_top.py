"""A symmetric top spinning upright, or hanging: small motions about the vertical, and where they grow.

With ζ = x + iy the horizontal part of e3, and s = 1 upright, −1 hanging, the horizontal part of the angular
momentum, s·iI1ζ̇ + I3ω3ζ, changes as the torque of the weight, iMglζ:

    I1 ζ̈ − i s I3ω3 ζ̇ − s Mgl ζ = 0

so ζ goes as exp(iνt) with s I1ν² − I3ω3ν + Mgl = 0, which is regular precession at no tilt. Goldstein,
*Classical Mechanics*, § 5.7 (sleeping top); Landau & Lifshitz, *Mechanics*, § 35, problem 2; Klein &
Sommerfeld, ch. V. Arguments are those of `heavy_top.motion`, and so is what raises InputError.
"""

import math

import numpy.typing as npt

from .checked import number
from .heavy_top import regular_precession
from .heavy_top_constants import moments_of_a_top, real, weight_moment
from .precise import mp


def threshold_spin(mass: float, length: float, moments: npt.ArrayLike, gravity: float) -> float:
    """Least |ω3| [rad/s] at which the upright top sleeps: 2√(MglI1)/I3.

    Stable from there on, the threshold itself included: (I3ω3)² ≥ 4MglI1. Goldstein § 5.7; Landau &
    Lifshitz § 35, problem 2.
    """
    I1, I3 = moments_of_a_top(moments)
    return float(2 * mp.sqrt(real(weight_moment(mass, length, gravity)) * I1) / I3)


def growth_rate(mass: float, length: float, moments: npt.ArrayLike, gravity: float, omega3: float) -> float:
    """How fast a small tilt of the upright top grows [1/s]: √(4MglI1 − (I3ω3)²)/(2I1), 0 if it is stable.

    Meanwhile it goes round at I3ω3/(2I1). The imaginary part of ν. Source: the module's.
    """
    I1, I3 = moments_of_a_top(moments)
    spin = mp.mpf(I3) * number("omega3", omega3)
    under = 4 * real(weight_moment(mass, length, gravity)) * I1 - spin * spin
    return float(mp.sqrt(max(under, mp.mpf(0))) / (2 * I1))


def upright_rates(
    mass: float, length: float, moments: npt.ArrayLike, gravity: float, omega3: float
) -> tuple[float, float]:
    """Slow and fast rate ν [rad/s] at which a stable upright top's axis circles the vertical.

    They add up to I3ω3/I1, and the tilt comes and goes at their difference. Raises InputError below
    `threshold_spin`, too. Source: the module's.
    """
    return regular_precession(mass, length, moments, gravity, 0.0, omega3)


def hanging_rates(
    mass: float, length: float, moments: npt.ArrayLike, gravity: float, omega3: float
) -> tuple[float, float]:
    """Slow and fast rate ν [rad/s] at which a hanging top's axis circles the vertical; always stable.

    They add up to −I3ω3/I1 (e3 points down), and the slow one has the sign of ω3. At ω3 = 0 both are the
    pendulum's √(Mgl/I1) in size, and the slow one is taken as positive. Source: the module's.
    """
    return regular_precession(mass, length, moments, gravity, math.pi, omega3)
