"""Arguments checked on entry: each function returns a float array or raises ``InputError``."""

import math

import numpy as np
import numpy.typing as npt

from .errors import InputError

Array = npt.NDArray[np.float64]

#: Distance from unit length up to which a quaternion counts as one [1]; it is then normalised.
UNIT_TOLERANCE = 1e-9
#: Spacing of the doubles at 1: what one rounding may cost, relatively [1].
EPSILON = float(np.finfo(np.float64).eps)


def finite(name: str, value: npt.ArrayLike, shape: tuple[int, ...] | None = None) -> Array:
    """``value`` as a finite float64 array, of ``shape`` if one is given (-1 matches any length)."""
    # Scenes are made of thousands of short tuples of floats, which need no look at types and shapes.
    if isinstance(value, tuple) and shape == (len(value),) and all(map(_plain, value)):
        return np.array(value)
    try:
        given = np.asarray(value)
        # numpy would read the text "1", take true for 1 and drop an imaginary part.
        if given.dtype.kind in "USbcmM":
            raise InputError(f"{name}: got {value!r}, expected numbers")
        array = given.astype(np.float64, copy=False)
    except (TypeError, ValueError) as cause:
        raise InputError(f"{name}: got {value!r}, expected numbers") from cause
    if shape is not None and array.shape != shape and not _fits(array.shape, shape):
        expected = str(shape).replace("-1", "any")
        raise InputError(f"{name}: got an array of shape {array.shape}, expected {expected}")
    if not np.isfinite(array).all():
        raise InputError(f"{name}: got {array.tolist()}, expected finite numbers")
    return array


def number(name: str, value: npt.ArrayLike) -> float:
    """``value`` as one finite float."""
    if type(value) is float and math.isfinite(value):
        return value  # by far the most usual case, and scenes are made of thousands
    return float(finite(name, value, ()))


def positive(name: str, value: npt.ArrayLike) -> float:
    """``value`` as one finite float above zero."""
    result = number(name, value)
    if result <= 0:
        raise InputError(f"{name}: got {result}, expected a number above 0")
    return result


def not_negative(name: str, value: npt.ArrayLike) -> float:
    """``value`` as one finite float, zero or above."""
    result = number(name, value)
    if result < 0:
        raise InputError(f"{name}: got {result}, expected 0 or above")
    return result


def within(name: str, value: npt.ArrayLike, low: float, high: float) -> float:
    """``value`` as one finite float in the closed interval [low, high]."""
    result = number(name, value)
    if not low <= result <= high:
        raise InputError(f"{name}: got {result}, expected a number from {low} to {high}")
    return result


def times(name: str, value: npt.ArrayLike) -> Array:
    """``value`` as finite times (n,); a single number counts as one time."""
    return finite(name, np.atleast_1d(finite(name, value)), (-1,))


def unit_quaternion(name: str, value: npt.ArrayLike) -> Array:
    """``value`` (4,), scalar last, normalised; raises if its norm is off by more than 1e-9."""
    q = finite(name, value, (4,))
    norm = math.hypot(*q)
    if abs(norm - 1) > UNIT_TOLERANCE:
        raise InputError(
            f"{name}: got norm {norm}, expected a unit quaternion (x, y, z, w) to {UNIT_TOLERANCE:g}"
        )
    return q / norm


def unit_quaternions(name: str, value: npt.ArrayLike) -> Array:
    """``value`` (..., 4), scalar last; raises if a norm is off 1 by more than 1e-9."""
    q = finite(name, value)
    if q.ndim == 0 or q.shape[-1] != 4:
        raise InputError(f"{name}: got an array of shape {q.shape}, expected (..., 4)")
    off = np.abs(np.linalg.norm(q, axis=-1) - 1)
    if np.any(off > UNIT_TOLERANCE):
        raise InputError(
            f"{name}: got a norm {off.max():g} off 1, expected unit quaternions (x, y, z, w) to "
            f"{UNIT_TOLERANCE:g}"
        )
    return q


def principal_moments(name: str, value: npt.ArrayLike, rounding: float = 4.0) -> Array:
    """``value`` (3,) [kg m²]: each positive, none above the sum of the other two.

    A plate (I3 = I1 + I2) is allowed; so many units in the last place are granted to its ``rounding``.
    """
    moments = finite(name, value, (3,))
    least, middle, largest = sorted(moments.tolist())
    if least <= 0:
        raise InputError(f"{name}: got {moments.tolist()}, expected three moments above 0")
    others = least + middle
    if largest > others * (1 + rounding * EPSILON):
        raise InputError(
            f"{name}: got {moments.tolist()}, whose largest exceeds the sum of the other two, {others}; "
            "no body has such moments"
        )
    return moments


def _plain(part: object) -> bool:
    return type(part) is float and math.isfinite(part)


def _fits(got: tuple[int, ...], expected: tuple[int, ...]) -> bool:
    return len(got) == len(expected) and all(e in (-1, g) for g, e in zip(got, expected, strict=True))
