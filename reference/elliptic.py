"""Jacobi's elliptic functions and the integral of the third kind, exact near a separatrix and at late times.

What a case needs once (modulus, periods, rates) is computed in fifty digits (`precise.mp`); what a time
needs is computed in double, vectorised, from a phase that was reduced in extended precision. The modulus
is given by m and by 1 − m, each exact to its own last digit: near a separatrix m alone says nothing.

How a top uses it::

    modulus = elliptic.modulus(m, m1)                     # m and 1 − m: numbers of precise.mp
    u0 = elliptic.first_kind(sn0, cn0, dn0)               # the phase at t = 0 from its functions
    third = elliptic.third_kind(modulus, n)               # scale·∫du/(1 − n sn²u), n < 0 or m < n < 1
    phase = elliptic.phase(modulus, rate, u0, t)          # u = u0 + rate·t, reduced
    sn, cn, dn = elliptic.jacobi(modulus, phase)
    periodic = elliptic.turn(modulus.lattice, third.function, third.depth, phase)
    secular = double_double.turning(third.rate * rate, 0, t)  # and exp(iX) = secular · periodic / periodic(0)
"""

from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from .checked import Array
from .double_double import Pair, affine, fraction, pair, scale
from .errors import InputError
from .precise import mp
from .theta import Lattice, Waves, at_origin, lattice, slope, theta, theta_above, waves

ComplexArray = npt.NDArray[np.complex128]


class Modulus(NamedTuple):
    """Parameter m = k², its complement 1 − m, and the quarter periods, as mpmath numbers."""

    m: Any
    m1: Any
    lattice: Lattice


class Phase(NamedTuple):
    """Real arguments u = quarter·K + remainder, |remainder| ≤ K/2 (with K = ∞ all of u is remainder)."""

    quarter: Array
    remainder: Pair


class ThirdKind(NamedTuple):
    """scale·∫₀ᵘ du/(1 − n sn²u) = rate·u + arg θ(u + i·depth) − arg θ(i·depth).

    θ is θ1 or θ2, as ``function`` says; ``rate`` is what remains beside θ's own angle, which `turn` gives
    and which is periodic but for whole turns. ``scale`` = √((1 − n)(1 − m/n)), all mpmath numbers.
    """

    scale: Any
    rate: Any
    function: int
    depth: Any


def modulus(m: Any, m1: Any) -> Modulus:
    """The modulus of parameter ``m`` in [0, 1] with ``m1`` = 1 − m, both exact (mpmath numbers or floats).

    K = π/(2 agm(1, k′)), K′ = π/(2 agm(1, k)): Gauss; DLMF § 19.8(i).
    Raises InputError outside [0, 1], or where the two do not add up to 1.
    """
    m, m1 = mp.mpf(m), mp.mpf(m1)
    if not (m >= 0 and m1 >= 0 and abs(m + m1 - 1) < 1e-15):
        raise InputError(f"m, m1: got {float(m)}, {float(m1)}; expected two numbers from 0 to 1, sum 1")
    return Modulus(m, m1, lattice(_quarter_period(m1), _quarter_period(m)))


def first_kind(sn: Any, cn: Any, dn: Any) -> Any:
    """The u in [−K, K] whose functions are ``sn``, ``cn`` ≥ 0 and ``dn`` ≥ 0, as an mpmath number.

    u = sn·R_F(cn², dn², 1) (Carlson; DLMF § 19.25(v)). All three are asked for, and taken as consistent,
    because 1 − sn² and 1 − m sn² lose digits near a separatrix.
    """
    return sn * mp.elliprf(cn * cn, dn * dn, 1)


def phase(modulus: Modulus, rate: Any, start: Any, t: Array) -> Phase:
    """The arguments ``start`` + ``rate``·t at the times ``t`` (n,), reduced by whole quarter periods.

    ``rate`` and ``start`` are mpmath numbers. Raises InputError past 10¹⁵ quarter periods.
    """
    K = modulus.lattice.K
    if mp.isinf(K):
        return Phase(np.zeros_like(t), affine(rate, start, t))
    quarter, rest = fraction(affine(rate / K, start / K, t))
    return Phase(quarter, scale(rest, pair(K)))


def jacobi(modulus: Modulus, phase: Phase) -> tuple[Array, Array, Array]:
    """sn, cn, dn (n,) each, relatively exact to a few units in the last place, near their zeros too.

    DLMF § 22.2: quotients of theta functions, here within K/2 of 0, and § 22.4(iii) for the shift by K.
    """
    w = waves(modulus.lattice, phase.remainder)
    *scales, k1 = _scales(modulus)
    below = theta(modulus.lattice, 4, w)
    s, c, d = (
        size * theta(modulus.lattice, index, w) / below for index, size in zip((1, 2, 3), scales, strict=True)
    )
    step = np.mod(phase.quarter, 4)
    odd, sign = step % 2 == 1, np.where(step >= 2, -1.0, 1.0)
    # On the separatrix itself there is no quarter period to pass, and no d = 0 to divide by.
    safe = np.where(odd, d, 1.0)
    sn = sign * np.where(odd, c / safe, s)
    cn = sign * np.where(odd, -k1 * (s / safe), c)
    return sn, cn, np.where(odd, k1 / safe, d)


def turn(lattice: Lattice, index: int, depth: Any, phase: Phase) -> ComplexArray:
    """exp(i arg θ_index(u + i·depth)) (n,), a unit complex number at each u of ``phase``.

    ``lattice`` may be another than the modulus's own if it has the same K (`theta.doubled` for integrals
    over dn); ``depth`` (mpmath number) is real, from −K′ to K′ of that lattice.
    """
    w = waves(lattice, phase.remainder)
    step = np.mod(phase.quarter, 4)
    result = np.empty(step.shape, dtype=np.complex128)
    for moved in range(4):
        here = step == moved
        if not here.any():
            continue
        shifted, sign = _shifted(index, moved)
        real, imaginary = theta_above(lattice, shifted, depth, Waves(*(part[here] for part in w)))
        result[here] = sign * (real + 1j * imaginary)
    result /= np.abs(result)
    if lattice.hyperbolic:
        result *= np.exp(-1j * float(_gaussian_slope(lattice, depth)) * phase.remainder[0])
    return result


def turn_rate(lattice: Lattice, index: int, depth: Any) -> Any:
    """d/du at u = 0 of the angle that `turn` gives, as an mpmath number [rad per unit of u].

    A secular rate follows from it: what the whole phase does at u = 0, less this.
    """
    rate = slope(lattice, index, depth)
    return rate - _gaussian_slope(lattice, depth) if lattice.hyperbolic else rate


def third_kind(modulus: Modulus, n: Any, n_above_m: Any = None, one_minus_n: Any = None) -> ThirdKind:
    """∫du/(1 − n sn²u) in the circular cases n < 0 and m < n < 1, split as `ThirdKind` says.

    With sn(ia) = 1/√n, or sn(K + ia) = 1/√n, the integrand's poles are zeros of θ1(z ± iπa/2K), or of θ2
    (Jacobi; Whittaker & Watson § 22.74). ``n_above_m`` = n − m and ``one_minus_n`` may be given where those
    differences would lose digits. Raises InputError for other n.
    """
    n = mp.mpf(n)
    above = n - modulus.m if n_above_m is None else n_above_m
    below = 1 - n if one_minus_n is None else one_minus_n
    if n < 0:
        index, depth = 1, mp.elliprf(-n, -above, below)
    elif above > 0 and below > 0:
        index, depth = 2, mp.sqrt(below) * mp.elliprf(above, n * modulus.m1, modulus.m1)
    else:
        raise InputError(f"n: got {float(n)}, expected below 0 or between m = {float(modulus.m)} and 1")
    size = mp.sqrt(below * above / n)
    # Both θ1 and θ2 turn backwards above the real axis: the sign of depth is chosen to turn forwards.
    return ThirdKind(size, size - turn_rate(modulus.lattice, index, -depth), index, -depth)


@lru_cache(64)
def _scales(modulus: Modulus) -> tuple[float, float, float, float]:
    """What makes sn u = u + …, cn 0 = 1 and dn 0 = 1 of quotients by θ4, and k′."""
    above = at_origin(modulus.lattice, 4)
    s, c, d = (float(above / at_origin(modulus.lattice, index)) for index in (1, 2, 3))
    return s, c, d, float(mp.sqrt(modulus.m1))


def _quarter_period(complement: Any) -> Any:
    return mp.pi / (2 * mp.agm(1, mp.sqrt(complement))) if complement else mp.inf


def _gaussian_slope(lattice: Lattice, depth: Any) -> Any:
    return 0 if mp.isinf(lattice.K) else lattice.scale * depth / lattice.K


def _shifted(index: int, quarters: int) -> tuple[int, float]:
    """θ_index(z + quarters·π/2) as another theta function of z, and its sign."""
    if index in (3, 4):
        return (7 - index if quarters % 2 else index), 1.0
    row = {1: [(1, 1.0), (2, 1.0), (1, -1.0), (2, -1.0)], 2: [(2, 1.0), (1, -1.0), (2, -1.0), (1, 1.0)]}
    return row[index][quarters]
