"""Attitude and rates of a heavy symmetric top as quotients of theta functions.

The attitude's Cayley–Klein parameters α = w + iz, β = x + iy and Ω = Ω1 + iΩ2, seen from the axes of
`heavy_top_roots`, obey

    α̇ = ½(iaα − βΩ̄),    β̇ = ½(αΩ − iaβ),    Ω̇ = kᾱβ

and |α|² = (2 − d)/2, |β|² = d/2, |Ω|² = k(d − dE) are linear in d = d1 − (d1 − d2) sn²u, u = u0 + pt,
p = ½√(k(d1 − d3)). So each of the three is, but for a constant, θ_j(u + ih)/θ4(u) · exp(iλt): j = 1 for α,
which is least at the bottom u = 0, and j = 2 for β and Ω. Where the modulus vanishes gives the height h,
and λ makes the rate of the argument right at one point, where it is

    (2a + c)/(2(2 − d)) for α,    c/(2d) for β,    −(c + ad)/(2(d − dE)) for Ω.

Source: Klein & Sommerfeld, *Über die Theorie des Kreisels*, ch. VI (α, β, γ, δ as elliptic functions of
the second kind); Goldstein, *Classical Mechanics*, § 4.5 (the parameters) and § 5.7 (the cubic).
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import elliptic
from .checked import Array
from .double_double import affine, fraction
from .heavy_top_roots import Constants, Roots, real, roots
from .precise import mp
from .theta import Lattice, Waves, theta, theta_above, waves

ComplexArray = npt.NDArray[np.complex128]

#: A u so small that no function of it differs from its first term [1].
_SOON = 1e-200

#: α, β and Ω, one after the other, each (n,) complex.
Triple = tuple[ComplexArray, ComplexArray, ComplexArray]


class Factor(NamedTuple):
    """One of α, β, Ω: the number of its theta function, the height of its zero, λ [rad/s], and its size.

    ``size`` is what to multiply by in the two halves of a swing: near the bottom, and near the top.
    """

    number: int
    height: Any
    rate: Any
    size: tuple[float, float]


class Case(NamedTuple):
    """All of a motion that does not depend on time: u = start + rate·t, and α, β, Ω."""

    modulus: elliptic.Modulus
    start: Any
    rate: Any
    factors: tuple[Factor, Factor, Factor]


def case(motion: Constants) -> Case:
    """The case of a motion with k > 0 that is not steady."""
    found = roots(motion)
    k, a, c = (real(v) for v in motion[:3])
    modulus = elliptic.modulus(found.d12 / found.d13, found.d23 / found.d13)
    p = mp.sqrt(k * found.d13) / 2
    below, above, far = found.from_start
    start = _first_kind(below / found.d12, above / found.d12, far / found.d13)
    lowest, highest = found.d1 / 2, found.from_hanging[1] / 2
    rest = found.from_rest[0]
    # For each: |·|² and the rate of its argument where that is taken, the height, and the sense of turning.
    at_top = (1, highest, (2 * a + c) / (4 * highest), _alpha_height(found), 2 * motion.a + motion.c)
    at_bottom = (2, lowest, c / (4 * lowest), _height(found, found.d1, *found.from_upright), motion.c)
    rates = (
        2,
        k * rest,
        -(c + a * found.d1) / (2 * rest),
        _height(found, *found.from_rest),
        _at_rest(motion),
    )
    alpha, beta, Omega = (_factor(modulus.lattice, p, *each) for each in (at_top, at_bottom, rates))
    return Case(modulus, start if motion.rise > 0 else -start, p, (alpha, beta, Omega))


def values(case: Case, now: Sequence[complex], turning: Sequence[Any], t: Array) -> Triple:
    """α, β, Ω (n,) at t (n,), which are ``now`` at t = 0, turned on by ``turning``·t [rad/s]."""
    shapes = _shapes(case, turning, t, elliptic.phase(case.modulus, case.rate, case.start, t))
    for shape, unit in zip(shapes, _fitting(case, now), strict=True):
        shape *= unit
    return shapes[0], shapes[1], shapes[2]


def _fitting(case: Case, now: Sequence[complex]) -> list[complex]:
    """Unit factors that make α, β, Ω what they are at t = 0; a derivative tells where one is 0 there."""
    alpha, beta, across = now
    rates = (-beta * across.conjugate(), alpha * across, alpha.conjugate() * beta)
    start, origin = np.zeros(1), elliptic.phase(case.modulus, case.rate, case.start, np.zeros(1))
    after = origin._replace(remainder=(np.array([_SOON]), start))
    here, soon = (_shapes(case, (0, 0, 0), start, phase) for phase in (origin, after))
    wanted = [value or rate for value, rate in zip(now, rates, strict=True)]
    found = [complex((h if value else s)[0]) for value, h, s in zip(now, here, soon, strict=True)]
    return [_unit(w) / _unit(f) for w, f in zip(wanted, found, strict=True)]


def _unit(z: complex) -> complex:
    return z / abs(z)


def _shapes(case: Case, turning: Sequence[Any], t: Array, phase: elliptic.Phase) -> list[ComplexArray]:
    lattice = case.modulus.lattice
    flipped = np.where(phase.quarter % 4 >= 2, -1.0, 1.0)
    results = [
        flipped * _turn(factor.rate + extra, t, lattice, factor.height, phase.remainder[0])
        for factor, extra in zip(case.factors, turning, strict=True)
    ]
    for top in (False, True):
        here = (phase.quarter % 2 == 1) == top
        w = waves(lattice, (phase.remainder[0][here], phase.remainder[1][here]))
        below = theta(lattice, 3 if top else 4, w)
        for result, factor in zip(results, case.factors, strict=True):
            result[here] *= _numerator(lattice, factor, top, w) / below
    return results


def _numerator(lattice: Lattice, factor: Factor, top: bool, w: Waves) -> ComplexArray:
    """A quarter period on, θ1 becomes θ2 and θ2 becomes −θ1 (Whittaker & Watson § 21.11)."""
    index = 3 - factor.number if top else factor.number
    x, y = theta_above(lattice, index, factor.height, w)
    size = -factor.size[1] if top and index == 1 else factor.size[top]
    return np.asarray(size * (x + 1j * y))


def _turn(rate: Any, t: Array, lattice: Lattice, height: Any, remainder: Array) -> ComplexArray:
    circle = 2 * mp.pi
    _, rest = fraction(affine(rate / circle, 0, t))
    angle = float(circle) * rest[0]
    if lattice.hyperbolic and not mp.isinf(lattice.K):
        angle = angle - float(lattice.scale * height / lattice.K) * remainder
    return np.asarray(np.cos(angle) + 1j * np.sin(angle))


def _factor(lattice: Lattice, p: Any, index: int, square: Any, rate: Any, height: Any, sign: Any) -> Factor:
    """θ_j from its modulus squared and its rate of turning where θ2 stands in its numerator.

    The height is turned against the argument: above the real axis both θ1 and θ2 turn backwards.
    """
    height = -height if sign > 0 else height
    x, _ = theta_above(lattice, 2, height, _origin(lattice))
    below = theta(lattice, 4 if index == 2 else 3, _origin(lattice))
    size = float(mp.sqrt(square)) * float(below[0] / x[0])
    # In the hyperbolic form θ1 and θ2 are scaled unlike θ3 and θ4, by 2q′^¼.
    other = size * float(4 * mp.sqrt(lattice.nome)) if lattice.hyperbolic and index == 2 else size
    return Factor(index, height, rate - p * elliptic.turn_rate(lattice, 2, height), (size, other))


def _origin(lattice: Lattice) -> Waves:
    return waves(lattice, (np.zeros(1), np.zeros(1)))


def _first_kind(sn2: Any, cn2: Any, dn2: Any) -> Any:
    """U within [0, K] from the squares of its three functions (DLMF § 19.25(v))."""
    return mp.sqrt(sn2) * mp.elliprf(cn2, dn2, 1)


def _alpha_height(found: Roots) -> Any:
    """Where d = 2, at u = ih: sn²(h | 1 − m) = (2 − d1)/(2 − d2)."""
    near, middle, far = found.from_hanging
    return _first_kind(near / middle, found.d12 / middle, found.d12 * far / (middle * found.d13))


def _height(found: Roots, from_bottom: Any, from_top: Any, from_third: Any) -> Any:
    """Where d = x, given d1 − x, d2 − x and x − d3, at u = K + ih.

    On the separatrix d2 = x = d3, and the height no longer matters.
    """
    if not from_top:
        return mp.mpf(0)
    sn2 = from_top * found.d13 / (from_bottom * found.d23)
    cn2 = from_third * found.d12 / (from_bottom * found.d23)
    return _first_kind(sn2, cn2, found.d12 / from_bottom)


def _at_rest(motion: Constants) -> Any:
    """The sign of Ω's turning: that of −(c + a dE)."""
    return motion.a * motion.e - motion.c * motion.k
