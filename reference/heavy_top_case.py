"""All of a heavy top's motion that does not depend on time, in fifty digits.

The attitude's Cayley–Klein parameters α = w + iz, β = x + iy and Ω = Ω1 + iΩ2, seen from the axes of
`heavy_top_constants`, obey

    α̇ = ½(iaα − βΩ̄),    β̇ = ½(αΩ − iaβ),    Ω̇ = kᾱβ

and |α|² = (2 − d)/2, |β|² = d/2, |Ω|² = k(d − dE) are linear in d = d1 − (d1 − d2) sn²u, u = u0 + pt,
p = ½√(k(d1 − d3)). So each of the three is, but for a constant, θ_j(u + ih)/θ4(u) · exp(iλt): j = 1 for α,
which is least at the bottom u = 0, and j = 2 for β and Ω, least at the top u = K. Where the modulus vanishes
gives the height h, and λ makes the rate of the argument right at one point, where it is

    (2a + c)/(2(2 − d)) for α,    c/(2d) for β,    −(c + ad)/(2(d − dE)) for Ω.

Source: Klein & Sommerfeld, *Über die Theorie des Kreisels*, ch. VI (α, β, γ, δ as elliptic functions of
the second kind); Goldstein, *Classical Mechanics*, § 4.5 (the parameters) and § 5.7 (the cubic).
"""

from typing import Any, NamedTuple

import numpy as np

from . import elliptic
from .heavy_top_constants import Constants, real
from .heavy_top_roots import Roots
from .precise import mp
from .theta import Lattice, theta, theta_above, waves


class Factor(NamedTuple):
    """One of α, β, Ω: j of its θ_j, the height h of its zero, λ [rad/s], and its size.

    ``size`` is what to multiply the quotient by within half a quarter period of the bottom, and of the top.
    """

    number: int
    height: Any
    rate: Any
    size: tuple[float, float]


class Case(NamedTuple):
    """The modulus of sn, u = start + rate·t, and the factors α, β, Ω."""

    modulus: elliptic.Modulus
    start: Any
    rate: Any
    factors: tuple[Factor, ...]


def case(motion: Constants, found: Roots) -> Case:
    """The case of a motion with k > 0 that is not steady, and of its turning points."""
    k, a, c = (real(v) for v in motion[:3])
    d1, rest, highest = found.d1, found.from_rest[0], found.from_hanging[1]
    modulus = elliptic.modulus(found.d12 / found.d13, found.d23 / found.d13)
    p = mp.sqrt(k * found.d13) / 2
    below, above, far = found.from_start
    start = _first_kind(below / found.d12, above / found.d12, far / found.d13)
    # α is measured at the top, β and Ω at the bottom, where they are largest. The last argument has the
    # sign of the turning: of p_α + p_γ, of p_α − p_γ, and of −(c + a dE).
    alpha = _factor(
        1, modulus, p, highest / 2, (2 * a + c) / (2 * highest), _alpha_height(found), 2 * motion.a + motion.c
    )
    beta = _factor(2, modulus, p, d1 / 2, c / (2 * d1), _height(found, d1, *found.from_upright), motion.c)
    Omega = _factor(
        2,
        modulus,
        p,
        k * rest,
        -(c + a * d1) / (2 * rest),
        _height(found, *found.from_rest),
        motion.a * motion.e - motion.c * motion.k,
    )
    return Case(modulus, start if motion.rise > 0 else -start, p, (alpha, beta, Omega))


def _factor(
    number: int, modulus: elliptic.Modulus, p: Any, square: Any, rate: Any, height: Any, sign: Any
) -> Factor:
    """A factor from its modulus squared and its argument's rate where θ2 stands in its numerator.

    The height is set against the turning: above the real axis both θ1 and θ2 turn backwards.
    """
    lattice = modulus.lattice
    height = -height if sign > 0 else height
    origin = waves(lattice, (np.zeros(1), np.zeros(1)))
    above, below = theta_above(lattice, 2, height, origin)[0], theta(lattice, 4 if number == 2 else 3, origin)
    size = float(mp.sqrt(square)) * float(below[0] / above[0])
    return Factor(
        number,
        height,
        rate - p * elliptic.turn_rate(lattice, 2, height),
        (size, size * _rescaling(lattice)) if number == 2 else (size, size),
    )


def _rescaling(lattice: Lattice) -> float:
    """From θ2/θ4 to θ1/θ3: in the hyperbolic form 2q′^¼ is left out of θ1 and of what θ4 became."""
    return float(4 * mp.sqrt(lattice.nome)) if lattice.hyperbolic else 1.0


def _alpha_height(found: Roots) -> Any:
    """Where d = 2, at u = ih: sc²(h | 1 − m) = (2 − d1)/(d1 − d2)."""
    near, middle, far = found.from_hanging
    return _first_kind(near / middle, found.d12 / middle, found.d12 * far / (middle * found.d13))


def _height(found: Roots, from_bottom: Any, from_top: Any, from_third: Any) -> Any:
    """Where d = x, given d1 − x, d2 − x and x − d3, at u = K + ih: dn²(h | 1 − m) = (d1 − d2)/(d1 − x).

    On the separatrix d2 = x = d3, and the height no longer matters.
    """
    if not from_top:
        return mp.mpf(0)
    scale = from_bottom * found.d23
    sn2, cn2 = from_top * found.d13 / scale, from_third * found.d12 / scale
    return _first_kind(sn2, cn2, found.d12 / from_bottom)


def _first_kind(sn2: Any, cn2: Any, dn2: Any) -> Any:
    """The argument within [0, K] from the squares of sn, cn and dn: sn R_F(cn², dn², 1) (DLMF § 19.25(v))."""
    return mp.sqrt(sn2) * mp.elliprf(cn2, dn2, 1)
