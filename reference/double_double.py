"""Phases that grow for a long time: products and sums with an exact remainder, as pairs of doubles.

An angle ``rate·t`` of 4·10⁶ rad in one double is wrong by 10⁻¹⁰ once it is reduced to a circle. Here a
number is the unevaluated sum ``high + low`` of two doubles (about 32 digits), made by the error-free
transformations of Dekker, *Numer. Math.* 18 (1971) 224, and Knuth, *The Art of Computer Programming*
vol. 2, § 4.2.2. ``numpy.longdouble`` would do on some machines only; this does on all.
"""

from typing import Any

import numpy as np
import numpy.typing as npt

from .checked import Array
from .errors import InputError
from .precise import mp

#: ``high + low``, |low| at most half a unit in the last place of high.
Pair = tuple[Array, Array]

#: Turns (or other natural units of a phase) up to which a reduced phase keeps 16 digits [1].
LARGEST_PHASE = 1e15

_SPLITTER = 2.0**27 + 1


def two_sum(a: npt.ArrayLike, b: npt.ArrayLike) -> Pair:
    """``a + b`` and its exact rounding error (Knuth § 4.2.2, theorem B); shapes broadcast."""
    a, b = np.asarray(a, dtype=np.float64), np.asarray(b, dtype=np.float64)
    total = a + b
    shadow = total - a
    return total, (a - (total - shadow)) + (b - shadow)


def two_product(a: npt.ArrayLike, b: npt.ArrayLike) -> Pair:
    """``a · b`` and its exact rounding error (Dekker's product); |a|, |b| below 10²⁹⁹, shapes broadcast."""
    a, b = np.asarray(a, dtype=np.float64), np.asarray(b, dtype=np.float64)
    product = a * b
    a_high, a_low = _split(a)
    b_high, b_low = _split(b)
    error = ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low
    return product, error


def scale(x: Pair, factor: tuple[float, float]) -> Pair:
    """The product of two pairs, good to a few units in the 31st digit."""
    high, low = two_product(x[0], factor[0])
    return two_sum(high, low + (x[0] * factor[1] + x[1] * factor[0]))


def pair(x: Any) -> tuple[float, float]:
    """The two doubles nearest to an mpmath number."""
    high = float(x)
    return high, float(x - high)


def affine(rate: Any, start: Any, t: Array) -> Pair:
    """``start + rate·t`` for mpmath numbers ``rate`` and ``start`` and exact times ``t`` (n,).

    The rate's power of two goes over to ``t``, so that neither a slow clock nor a fast top overflows.
    Raises InputError where the phase passes 10¹⁵ of its unit: no sixteen digits of it would be left.
    """
    mantissa, exponent = mp.frexp(rate)
    with np.errstate(over="ignore", under="ignore"):
        scaled = np.ldexp(t, int(exponent)) if rate else np.zeros_like(t)
    if not np.all(np.abs(scaled) <= LARGEST_PHASE):
        latest, most = float(np.abs(t).max()), mp.nstr(LARGEST_PHASE / abs(rate), 6)
        raise InputError(f"t: got {latest}, expected at most {most}: later, this motion's phase is unknown")
    high, low = scale((scaled, np.zeros_like(scaled)), pair(mantissa))
    start_high, start_low = pair(start)
    high, carry = two_sum(high, start_high)
    return two_sum(high, carry + (low + start_low))


def fraction(x: Pair) -> tuple[Array, Pair]:
    """The nearest whole number of a pair (as float64) and the signed rest, itself a pair."""
    whole = np.rint(x[0])
    return whole, two_sum(x[0] - whole, x[1])


def turning(rate: Any, start: Any, t: Array) -> tuple[Array, Array]:
    """Cosine and sine (n,) of ``start + rate·t`` [rad], good to 10⁻¹⁶ however large the angle."""
    circle = 2 * mp.pi
    _, rest = fraction(affine(rate / circle, start / circle, t))
    high, low = scale(rest, pair(circle))
    cosine, sine = np.cos(high), np.sin(high)
    return cosine - low * sine, sine + low * cosine


def _split(a: Array) -> Pair:
    shifted = _SPLITTER * a
    high = shifted - (shifted - a)
    return high, a - high
