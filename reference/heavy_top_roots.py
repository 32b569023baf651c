"""The turning points of a heavy top's axis: roots of the cubic of `heavy_top_constants`.

On and near the separatrix, in regular precession and near the vertical it is differences of the roots that
matter, however small; the working precision is raised until each has its digits.
"""

from fractions import Fraction
from typing import Any, NamedTuple

from .heavy_top_constants import Constants, real
from .precise import DIGITS, mp

#: Digits after which two roots that are not equal count as so: no motion of doubles comes near.
_MOST_DIGITS = 6000


class Roots(NamedTuple):
    """Roots d3 ≤ 0 ≤ d2 ≤ d ≤ d1 ≤ 2, as differences that kept their digits; dE is where Ω1 = Ω2 = 0."""

    d1: Any
    #: d1 − d2, d1 − d3, d2 − d3.
    d12: Any
    d13: Any
    d23: Any
    #: d1 − d0, d0 − d2, d0 − d3.
    from_start: tuple[Any, Any, Any]
    #: 2 − d1, 2 − d2, 2 − d3.
    from_hanging: tuple[Any, Any, Any]
    #: d2, −d3.
    from_upright: tuple[Any, Any]
    #: d1 − dE, d2 − dE, dE − d3.
    from_rest: tuple[Any, Any, Any]


def roots(motion: Constants) -> Roots:
    """The roots of a motion with k > 0 that is not steady, each difference good to 50 digits."""
    digits = 2 * DIGITS
    while True:
        with mp.workdps(digits):
            found = _roots(motion)
            needed = min(DIGITS + _digits_lost(found), _MOST_DIGITS)
        if digits >= needed:
            return found
        digits = max(2 * digits, needed)


def _roots(motion: Constants) -> Roots:
    """Viète's trigonometric solution, with an exact discriminant: equal roots come out equal."""
    k, a, c, e, d0 = motion[:5]
    # d³ + A d² + B d + C = 0
    A, B, C = (e + a * a - 2 * k) / k, 2 * (a * c - e) / k, c * c / k
    Q, R = A * A / 9 - B / 3, (2 * A * A * A - 9 * A * B + 27 * C) / 54
    discriminant = mp.sqrt(real(max(Q * Q * Q - R * R, Fraction(0))))
    size = 2 * mp.sqrt(3 * real(Q))
    d12 = size * mp.sin(mp.atan2(discriminant, real(R)) / 3)
    d23 = size * mp.sin(mp.atan2(discriminant, -real(R)) / 3)
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
    """How far a point is from the roots on both sides of it; where f = 0, it is one of them, or both."""
    if not exactly:
        return above, below
    nearest = min(above, below)
    gaps = [mp.mpf(0) if gap == nearest or not apart else gap for gap in (above, below)]
    return gaps[0], gaps[1]


def _digits_lost(found: Roots) -> int:
    """Digits by which the least difference is below the largest number that it was computed from."""
    gaps = [
        found.d1,
        *found[1:4],
        *found.from_start,
        *found.from_hanging,
        *found.from_upright,
        *found.from_rest,
    ]
    least = min(gap for gap in gaps if gap != 0)
    return _MOST_DIGITS if least < 0 else int(mp.log10((1 + max(gaps)) / least)) + 5
