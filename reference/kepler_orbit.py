"""Motion about a fixed centre of force −GM/r², from any state: ellipse, parabola, hyperbola, straight fall.

What a case needs once (energy, eccentricity, phase) is computed in fifty digits from the exact doubles that
were given, the phase is carried with its remainder, and Kepler's equation is solved to round-off; the
places at 10⁶ revolutions are then as good as those of the first.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from .checked import Array, finite, positive, times
from .double_double import affine, fraction, scale
from .errors import InputError
from .kepler_equation import eccentric_anomaly, hyperbolic_anomaly, parabolic_anomaly
from .precise import mp


class Orbit(NamedTuple):
    """What stays constant. The axis of a parabola is infinite, of a hyperbola below 0; no period is inf."""

    energy: float  # per mass [J/kg]
    angular_momentum: Array  # (3,) per mass [m²/s]
    eccentricity_vector: Array  # (3,) towards the nearest point (Laplace, Runge and Lenz) [1]
    eccentricity: float
    semi_major_axis: float  # [m]
    nearest: float  # distance of the nearest point [m]
    period: float  # [s]


class _Elements(NamedTuple):
    energy: Any
    momentum: list[Any]
    eccentricity_vector: list[Any]
    e: Any
    one_minus_e: Any
    size: Any  # |a|, infinite for a parabola
    nearest: Any
    towards: Array  # (3,) unit vector to the nearest point
    ahead: Array  # (3,) unit vector of the motion there; zero in a straight fall


def orbit(GM: float, r0: npt.ArrayLike, v0: npt.ArrayLike) -> Orbit:
    """The orbit through ``r0`` (3,) [m] with velocity ``v0`` (3,) [m/s], ``GM`` [m³/s²].

    Raises as ``motion`` does. Goldstein, sects. 3.7 and 3.9; Landau & Lifshitz, *Mechanics*, § 15.
    """
    GM_exact = mp.mpf(positive("GM", GM))
    elements = _elements(GM_exact, _exact("r0", r0), _exact("v0", v0))
    sign = -1 if elements.energy > 0 else 1
    bound = elements.energy < 0
    return Orbit(
        float(elements.energy),
        np.array([float(x) for x in elements.momentum]),
        np.array([float(x) for x in elements.eccentricity_vector]),
        float(elements.e),
        float(sign * elements.size),
        float(elements.nearest),
        float(2 * mp.pi * mp.sqrt(elements.size**3 / GM_exact)) if bound else np.inf,
    )


def motion(GM: float, r0: npt.ArrayLike, v0: npt.ArrayLike, t: npt.ArrayLike) -> tuple[Array, Array]:
    """Place and velocity about a fixed centre at the times ``t``.

    Parameters
    ----------
    GM : gravitational constant times mass of the centre [m³/s²]
    r0, v0 : (3,) place from the centre [m] and velocity [m/s] at t = 0
    t : (n,) times [s], of either sign

    Returns
    -------
    r, v : (n, 3) [m], [m/s]

    Raises
    ------
    InputError
        For a start at the centre, numbers that are not finite, shapes that do not fit, times past 10¹⁵
        revolutions, and times after (or before) a straight fall has met the centre.

    Notes
    -----
    Goldstein, sect. 3.8; Landau & Lifshitz, *Mechanics*, § 15, eqs. 15.10–15.12: with P to the nearest
    point and Q ahead there, r = a(cosE − e) P + a√(1−e²) sinE Q, E − e sinE = nt + M0, n² = GM/a³.
    """
    return exact_motion(mp.mpf(positive("GM", GM)), _exact("r0", r0), _exact("v0", v0), times("t", t))


def exact_motion(GM: Any, r0: Sequence[Any], v0: Sequence[Any], t: Array) -> tuple[Array, Array]:
    """As ``motion``, from numbers of fifty digits."""
    orbit = _elements(GM, r0, v0)
    radius = mp.sqrt(_dot(r0, r0))
    if orbit.energy == 0:
        x, y, vx, vy = _on_parabola(GM, orbit, _dot(r0, v0) / mp.sqrt(2 * GM), t)
    else:
        outward = _dot(r0, v0) / mp.sqrt(GM * orbit.size)  # e sinE, or e sinhH
        on_conic = _on_ellipse if orbit.energy < 0 else _on_hyperbola
        x, y, vx, vy = on_conic(GM, orbit, radius / orbit.size, outward, t)
    r = np.outer(x, orbit.towards) + np.outer(y, orbit.ahead)
    return r, np.outer(vx, orbit.towards) + np.outer(vy, orbit.ahead)


def _exact(name: str, value: npt.ArrayLike) -> list[Any]:
    return [mp.mpf(float(component)) for component in finite(name, value, (3,))]


def _dot(a: Sequence[Any], b: Sequence[Any]) -> Any:
    return sum(x * y for x, y in zip(a, b, strict=True))


def _cross(a: Sequence[Any], b: Sequence[Any]) -> list[Any]:
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def _elements(GM: Any, r0: Sequence[Any], v0: Sequence[Any]) -> _Elements:
    radius = mp.sqrt(_dot(r0, r0))
    if radius == 0:
        raise InputError("r0: got (0, 0, 0), expected some distance from the centre")
    energy = _dot(v0, v0) / 2 - GM / radius
    momentum = _cross(r0, v0)
    eccentric = [x / GM - y / radius for x, y in zip(_cross(v0, momentum), r0, strict=True)]
    e = mp.sqrt(_dot(eccentric, eccentric))
    if abs(energy) < mp.mpf(10) ** -40 * GM / radius:
        energy = mp.mpf(0)
    if e < mp.mpf(10) ** -40:  # a circle: any point is the nearest
        e, nearest_way = mp.mpf(0), r0
    else:
        nearest_way = eccentric
    one_minus_e = -2 * energy * _dot(momentum, momentum) / (GM**2 * (1 + e))
    return _Elements(
        energy,
        momentum,
        eccentric,
        e,
        one_minus_e,
        GM / abs(2 * energy) if energy else mp.inf,
        _dot(momentum, momentum) / (GM * (1 + e)),
        _unit(nearest_way),
        _unit(_cross(momentum, nearest_way)),
    )


def _unit(vector: Sequence[Any]) -> Array:
    length = mp.sqrt(_dot(vector, vector))
    return np.array([float(x / length) if length else 0.0 for x in vector])


def _on_ellipse(GM: Any, orbit: _Elements, radius: Any, outward: Any, t: Array) -> tuple[Array, ...]:
    a, e, one_minus_e = float(orbit.size), float(orbit.e), float(orbit.one_minus_e)
    b = float(orbit.size * mp.sqrt(orbit.one_minus_e * (1 + orbit.e)))
    E0 = mp.atan2(outward, 1 - radius) if orbit.e else mp.mpf(0)
    n, circle = mp.sqrt(GM / orbit.size**3), 2 * mp.pi
    turns = affine(n / circle, (E0 - outward) / circle, t)
    if orbit.one_minus_e == 0:
        _refuse_meeting(np.floor(turns[0]) == mp.floor((E0 - outward) / circle), t)
    high, low = scale(fraction(turns)[1], (float(circle), float(circle - float(circle))))
    E = eccentric_anomaly(np.asarray(high + low), e, one_minus_e)
    half = 2 * np.sin(E / 2) ** 2  # 1 − cosE without loss
    rate = float(n) / (one_minus_e + e * half)
    return a * (one_minus_e - half), b * np.sin(E), -a * np.sin(E) * rate, b * np.cos(E) * rate


def _on_hyperbola(GM: Any, orbit: _Elements, radius: Any, outward: Any, t: Array) -> tuple[Array, ...]:
    a, e, e_minus_one = float(orbit.size), float(orbit.e), float(-orbit.one_minus_e)
    b = float(orbit.size * mp.sqrt(-orbit.one_minus_e * (1 + orbit.e)))
    n, M0 = mp.sqrt(GM / orbit.size**3), outward - mp.asinh(outward / orbit.e)
    high, low = affine(n, M0, t)
    if orbit.one_minus_e == 0:
        _refuse_meeting(np.sign(high) == np.sign(float(M0)), t)
    M = np.asarray(high + low)
    H = hyperbolic_anomaly(M, e, e_minus_one)
    # Far out the sinh of a rounded H would lose digits; the equation itself gives it to the last one.
    sinh = np.where(np.abs(H) > 1, (M + H) / e, np.sinh(H))
    half = np.where(np.abs(H) > 1, np.hypot(1, sinh) - 1, 2 * np.sinh(H / 2) ** 2)  # coshH − 1
    rate = float(n) / (e_minus_one + e * half)
    return a * (e_minus_one - half), b * sinh, -a * sinh * rate, b * (1 + half) * rate


def _on_parabola(GM: Any, orbit: _Elements, start: Any, t: Array) -> tuple[Array, ...]:
    """In s = √q tan(ν/2): s³/3 + qs = √(GM/2) (t − t at the nearest point), r = q + s²."""
    q = float(orbit.nearest)
    high, low = affine(mp.sqrt(GM / 2), start**3 / 3 + orbit.nearest * start, t)
    area = np.asarray(high + low)
    if orbit.nearest == 0:
        _refuse_meeting(np.sign(area) == np.sign(float(start)), t)
        s = np.cbrt(3 * area)
    else:
        s = np.sqrt(q) * parabolic_anomaly(area / q**1.5)
    rate = float(mp.sqrt(GM / 2)) / (q + s * s)
    return q - s * s, 2 * np.sqrt(q) * s, -2 * s * rate, 2 * np.sqrt(q) * rate


def _refuse_meeting(before: npt.NDArray[np.bool_], t: Array) -> None:
    if not np.all(before):
        raise InputError(f"t: got {t[~before][0]}, by when a straight fall has met the centre")
