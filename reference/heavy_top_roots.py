"""What fixes one motion of a heavy symmetric top: its constants, exact, and the turning points of its axis.

All is divided by I1, and the body is watched from axes that turn about e3 so that it moves as a top with
three equal moments I1 would: its spin is then a = I3ω3/I1, and Ω1, Ω2 its other rates. With d = 1 − cos β,
which alone keeps its digits near the vertical (Goldstein, *Classical Mechanics*, § 5.7, with u = 1 − d):

    ḋ² = f(d) = (e + k d) d (2 − d) − (c + a d)²

k = 2Mgl/I1; c = (p_α − p_γ)/I1 and e = 2(E′ − Mgl)/I1 are what is left of the other two constants. The
doubles that come in are ratios of whole numbers, and so are all these: whether a motion is regular, asleep
or on the separatrix is decided exactly.
"""

from collections.abc import Sequence
from fractions import Fraction
from typing import Any, NamedTuple

from .precise import mp

#: Decimal digits that every difference of two roots keeps.
_KEPT = 45

#: Digits after which two roots that are not equal count as so: no double input comes near.
_MOST_DIGITS = 6000


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


class Roots(NamedTuple):
    """Turning points d3 ≤ 0 ≤ d2 ≤ d ≤ d1 ≤ 2 of the cubic, as differences that kept their digits.

    ``dE`` is the d at which Ω1 and Ω2 would vanish: d3 ≤ dE ≤ d2.
    """

    d1: Any
    d12: Any
    d13: Any
    d23: Any
    #: d0 from the three roots: d1 − d0, d0 − d2, d0 − d3.
    from_start: tuple[Any, Any, Any]
    #: 2 − d1, 2 − d2, 2 − d3.
    from_hanging: tuple[Any, Any, Any]
    #: d2 and −d3.
    from_upright: tuple[Any, Any]
    #: d1 − dE, d2 − dE, dE − d3.
    from_rest: tuple[Any, Any, Any]


def constants(
    weight_moment: Fraction, I1: float, I3: float, q0: Sequence[float], omega0: Sequence[float]
) -> Constants:
    """The constants of a motion from Mgl [N m], moments [kg m²], q0 (4,) and ω0 (3,) [rad/s].

    Without rounding; a quaternion that is not quite of unit length is divided by its length.
    """
    x, y, z, w = (Fraction(v) for v in q0)
    w1, w2, w3 = (Fraction(v) for v in omega0)
    norm = x * x + y * y + z * z + w * w
    d0 = 2 * (x * x + y * y) / norm
    # The vertical in body axes: R(q) transposed, last column.
    g1, g2 = 2 * (x * z - w * y) / norm, 2 * (y * z + w * x) / norm
    a = Fraction(I3) * w3 / Fraction(I1)
    k = 2 * weight_moment / Fraction(I1)
    across = w1 * w1 + w2 * w2
    c = g1 * w1 + g2 * w2 - a * d0
    return Constants(k, a, c, across - k * d0, d0, g1 * w2 - g2 * w1, across, w3 - a)


def steady(motion: Constants) -> bool:
    """Whether the axis keeps its tilt for ever: regular precession, upright or hanging, and k > 0."""
    if motion.rise:
        return False
    k, a, c, e, d0 = motion[:5]
    # f′(d0) = 0 where f(d0) = 0: a double root, which is at d0 alone unless it is the unstable upright one.
    slope = k * d0 * (2 - d0) + (e + k * d0) * (2 - 2 * d0) - 2 * a * (c + a * d0)
    return slope == 0


def roots(motion: Constants) -> Roots:
    """The turning points of a motion with k > 0 that is not `steady`, good to 45 digits each."""
    digits = 2 * _KEPT
    while True:
        with mp.workdps(digits):
            result = _roots(motion)
            lost = _digits_lost(motion, result)
        if digits >= min(_KEPT + lost, _MOST_DIGITS):
            return result
        digits = min(max(2 * digits, _KEPT + lost), _MOST_DIGITS)


def _roots(motion: Constants) -> Roots:
    """Viète's trigonometric roots, the discriminant exact: equal roots come out equal."""
    k, a, c, e, d0 = motion[:5]
    A, B, C = (e + a * a - 2 * k) / k, 2 * (a * c - e) / k, c * c / k
    Q, R = A * A / 9 - B / 3, (2 * A * A * A - 9 * A * B + 27 * C) / 54
    under = Q * Q * Q - R * R
    height = mp.sqrt(real(max(under, Fraction(0))))
    low = mp.atan2(height, real(R)) / 3
    high = mp.atan2(height, -real(R)) / 3
    size = 2 * mp.sqrt(3 * real(Q))
    d12, d23 = size * mp.sin(low), size * mp.sin(high)
    d1 = (2 * d12 + d23 - real(A)) / 3
    d2, d3 = d1 - d12, d1 - d12 - d23
    start, rest = real(d0), -real(e / k)
    return Roots(
        d1,
        d12,
        d12 + d23,
        d23,
        (*_touching(motion.rise == 0, d1 - start, start - d2), start - d3),
        (mp.mpf(0) if 2 * a + c == 0 else 2 - d1, 2 - d2, 2 - d3),
        _touching(c == 0, d2, -d3, d23),
        (d1 - rest, *_touching(c * k == a * e, d2 - rest, rest - d3, d23)),
    )


def _touching(exactly: bool, above: Any, below: Any, apart: Any = 1) -> tuple[Any, Any]:
    """The gaps of a point between two roots; if f vanishes there, it is one of them, or both if not apart."""
    if not exactly:
        return above, below
    nearest = min(above, below)
    zero = mp.mpf(0)
    return (zero if above == nearest or not apart else above), (
        zero if below == nearest or not apart else below
    )


def _digits_lost(motion: Constants, found: Roots) -> int:
    """Digits by which the smallest difference is below the largest number that it was computed from."""
    largest = 1 + max(abs(found.d13), abs(found.from_rest[0]))
    differences = [found.d1, *found[1:4], *found.from_start, *found.from_hanging, *found.from_upright]
    smallest = min(gap for gap in (*differences, *found.from_rest) if gap != 0)
    return _MOST_DIGITS if smallest < 0 else int(mp.log10(largest / smallest)) + 5


def real(x: Fraction) -> Any:
    """The mpmath number nearest to ``x`` at the working precision."""
    return mp.mpf(x.numerator) / mp.mpf(x.denominator)
