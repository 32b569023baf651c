"""The closed curve on which L moves as seen from a free body: its axes, amplitudes, clock and modulus.

Landau & Lifshitz, *Mechanics*, § 37, order the moments and choose the axis that L circles by the sign of
L² − 2T·I2. Here the axes are named by the Jacobi function that each component of n = L/|L| follows,
(cn, sn, dn): the middle moment always goes with sn, and dn with the axis that is circled. Every difference
in the book's formulas that cancels near a separatrix is written as a sum over components, or taken exactly.
"""

from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np

from .checked import Array
from .elliptic import Modulus, Phase, first_kind, jacobi, modulus, phase
from .precise import mp

#: A direction that is right-handed with its next two in this order.
_RIGHT_HANDED = ([0, 1, 2], [1, 2, 0], [2, 0, 1])


class Polhode(NamedTuple):
    """The body axes that go with (cn, sn, dn), the directions ±1 taken along them, and the motion of n.

    n = (Ac·cn u, As·sn u, Ad·dn u), u = start + rate·t, with cn and dn positive at t = 0 and
    ``amplitudes`` (Ac, As, Ad); ``moments`` in the same order, ``L`` and ``T``: all mpmath numbers.
    """

    axes: list[int]
    directions: Array
    amplitudes: tuple[Any, Any, Any]
    moments: tuple[Any, Any, Any]
    L: Any
    T: Any
    modulus: Modulus
    rate: Any
    start: Any


def is_point(moments: Array, omega: Array) -> bool:
    """Whether L keeps its direction in the body: ω × Iω = 0, exactly.

    So it is if every pair of axes has equal moments (3,) [kg m²] or lacks a component of ω (3,) [rad/s].
    """
    pairs = ((0, 1), (1, 2), (2, 0))
    return all(moments[j] == moments[k] or omega[j] == 0 or omega[k] == 0 for j, k in pairs)


def polhode(moments: Array, omega: Array) -> Polhode:
    """The curve through ``omega`` (3,) [rad/s], where it is not a point (`is_point`); moments (3,) [kg m²].

    Landau & Lifshitz § 37: amplitudes, clock and modulus, with (c, s, d) for the book's (1, 2, 3).
    """
    axes, beyond_s = _axes(moments, omega)
    directions = _directions(axes, omega)
    Ic, Is, Id = (mp.mpf(float(moments[a])) for a in axes)
    wc, ws, wd = (mp.mpf(float(omega[a] * sign)) for a, sign in zip(axes, directions, strict=True))
    L = mp.sqrt((Ic * wc) ** 2 + (Is * ws) ** 2 + (Id * wd) ** 2)
    T = (Ic * wc**2 + Is * ws**2 + Id * wd**2) / 2
    beyond_c = Is * (Is - Ic) * ws**2 + Id * (Id - Ic) * wd**2  # L² − 2T·Ic, two terms of one sign
    short_of_d = Ic * (Id - Ic) * wc**2 + Is * (Id - Is) * ws**2  # 2T·Id − L², likewise
    Ac = mp.sqrt(Ic * short_of_d / (Id - Ic)) / L
    As = mp.sqrt(Is * short_of_d / (Id - Is)) / L * mp.sign(Id - Ic)
    Ad = mp.sqrt(Id * beyond_c / (Id - Ic)) / L
    rate = mp.sqrt((Id - Is) * beyond_c / (Ic * Is * Id))
    m = (Is - Ic) * short_of_d / ((Id - Is) * beyond_c)
    m1 = (Id - Ic) * beyond_s / ((Id - Is) * beyond_c)
    start = first_kind(Is * ws / (As * L), Ic * wc / (Ac * L), Id * wd / (Ad * L))
    return Polhode(axes, directions, (Ac, As, Ad), (Ic, Is, Id), L, T, modulus(m, m1), rate, start)


def direction(curve: Polhode, t: Array) -> tuple[Array, Phase]:
    """L/|L| (3, n) along the axes (c, s, d) at the times ``t`` (n,) [s], and the phases it was made from."""
    u = phase(curve.modulus, curve.rate, curve.start, t)
    sn, cn, dn = jacobi(curve.modulus, u)
    Ac, As, Ad = (float(amplitude) for amplitude in curve.amplitudes)
    return np.stack([Ac * cn, As * sn, Ad * dn]), u


def in_body_axes(curve: Polhode, vector: Array) -> Array:
    """Components (3, n) along the body's axes of a ``vector`` (3, n) given along (c, s, d)."""
    result = np.empty_like(vector)
    result[curve.axes] = vector * curve.directions[:, None]
    return result


def _axes(moments: Array, omega: Array) -> tuple[list[int], Any]:
    """The axes (c, s, d), and L² − 2T·Is without rounding: its sign is the side of the separatrix."""
    low, middle, high = np.argsort(moments, kind="stable").tolist()
    exact = [(Fraction(float(i)), Fraction(float(w))) for i, w in zip(moments, omega, strict=True)]
    beyond = sum(((i - exact[middle][0]) * i * w * w for i, w in exact), Fraction(0))
    axes = [low, middle, high] if beyond >= 0 else [high, middle, low]
    return axes, mp.mpf(beyond.numerator) / mp.mpf(beyond.denominator)


def _directions(axes: list[int], omega: Array) -> Array:
    """Directions along the axes (c, s, d), right-handed, in which n starts with cn ≥ 0 and dn > 0."""
    c, d = (-1.0 if omega[a] < 0 else 1.0 for a in (axes[0], axes[2]))
    return np.array([c, (1.0 if axes in _RIGHT_HANDED else -1.0) * c * d, d])
