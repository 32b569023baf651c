"""What fixes one motion of a heavy symmetric top: its constants, without rounding.

All is divided by I1, and the body is watched from axes that turn about e3 so that it moves as a top with
three equal moments I1 would: its spin is then a = I3ω3/I1, and Ω1, Ω2 its other rates. With d = 1 − cos β,
which alone keeps its digits near the vertical (Goldstein, *Classical Mechanics*, § 5.7, with u = 1 − d):

    ḋ² = f(d) = (e + k d) d (2 − d) − (c + a d)²

k = 2Mgl/I1; c = (p_α − p_γ)/I1 and e = 2(E′ − Mgl)/I1 are what is left of the other two constants. The
doubles that come in are ratios of whole numbers, and so are all these: whether a motion is regular, asleep
or on the separatrix is decided exactly.
"""

from fractions import Fraction
from typing import Any, NamedTuple

import numpy.typing as npt

from .checked import finite, not_negative, positive, principal_moments, unit_quaternion
from .precise import mp


class Constants(NamedTuple):
    """Of one motion, exact: k, a, c, e as above [1/s², 1/s, 1/s, 1/s²], and the state at t = 0."""

    k: Fraction
    a: Fraction
    c: Fraction
    e: Fraction
    d0: Fraction
    #: −ḋ at t = 0 [1/s]: above 0 while the axis rises.
    rise: Fraction
    #: Ω1² + Ω2² at t = 0 [1/s²].
    across: Fraction
    #: ω3 − a [1/s]: how fast the body turns in the axes that it is watched from.
    spin: Fraction


def constants(
    mass: float,
    length: float,
    moments: npt.ArrayLike,
    gravity: float,
    q0: npt.ArrayLike,
    omega0: npt.ArrayLike,
) -> Constants:
    """The constants of the motion that `heavy_top.motion` describes, its arguments checked.

    A quaternion that is not quite of unit length is divided by its length, again without rounding. Raises
    InputError as `heavy_top.motion` does.
    """
    unit_quaternion("q0", q0)
    x, y, z, w = (Fraction(v) for v in finite("q0", q0).tolist())
    w1, w2, w3 = (Fraction(v) for v in finite("omega0", omega0, (3,)).tolist())
    I1, I3 = (Fraction(v) for v in moments_of_a_top(moments))
    norm = x * x + y * y + z * z + w * w
    d0 = 2 * (x * x + y * y) / norm
    # The vertical in body axes: the last row of R(q).
    g1, g2 = 2 * (x * z - w * y) / norm, 2 * (y * z + w * x) / norm
    k, a = 2 * weight_moment(mass, length, gravity) / I1, I3 * w3 / I1
    across = w1 * w1 + w2 * w2
    c = g1 * w1 + g2 * w2 - a * d0
    return Constants(k, a, c, across - k * d0, d0, g1 * w2 - g2 * w1, across, w3 - a)


def moments_of_a_top(moments: npt.ArrayLike) -> tuple[float, float]:
    """(I1, I3) [kg m²], checked: above 0, and I3 at most 2 I1 as in every body."""
    I1, I3 = finite("moments", moments, (2,)).tolist()
    principal_moments("moments (I1, I1, I3)", [I1, I1, I3])
    return I1, I3


def weight_moment(mass: float, length: float, gravity: float) -> Fraction:
    """Mgl [N m] without rounding, its factors checked: mass above 0, the others not below."""
    M = Fraction(positive("mass", mass))
    return M * Fraction(not_negative("length", length)) * Fraction(not_negative("gravity", gravity))


def is_weightless(motion: Constants, latest: float) -> bool:
    """Whether gravity turns the body by less than 10⁻²⁰ rad up to the time ``latest`` [s], forth or back."""
    return motion.k * Fraction(latest) ** 2 < Fraction(1, 10**20)


def is_steady(motion: Constants) -> bool:
    """Whether the axis keeps its tilt for ever under gravity: regular precession, upright, or hanging."""
    if motion.rise:
        return False
    k, a, c, e, d0 = motion[:5]
    # f′(d0) = 0 where f(d0) = 0. If the two equal roots are not the lower two, they are upright at d = 0.
    return k * d0 * (2 - d0) + (e + k * d0) * (2 - 2 * d0) == 2 * a * (c + a * d0)


def real(x: Fraction) -> Any:
    """The mpmath number nearest to ``x``."""
    return mp.mpf(x.numerator) / mp.mpf(x.denominator)
