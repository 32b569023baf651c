"""Attitude and rates of a heavy symmetric top that nutates, at any times: quotients of theta functions.

`heavy_top_case` says which, and holds what does not depend on time. Here all is in double precision, but
for the phases, which are reduced in extended precision first.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from . import elliptic
from .checked import Array
from .double_double import affine, fraction
from .heavy_top_case import Case, Factor, case
from .heavy_top_constants import Constants, real
from .heavy_top_steady import ComplexArray, Triple, steady
from .precise import mp
from .theta import Lattice, Waves, theta, theta_above, waves

#: A modulus m below which the axis nutates by less than any double shows.
_UNSEEN = 1e-250

#: A u so small that no function of it differs from its first term.
_SOON = 1e-200


def nutating(fixed: Constants, now: Sequence[complex], t: Array) -> Triple:
    """α = w + iz, β = x + iy, Ω1 + iΩ2 (n,) at t (n,) in the body's axes; ``now`` holds them at t = 0.

    For a motion with gravity that is not steady.
    """
    this, spin = case(fixed), real(fixed.spin)
    if this.modulus.m < _UNSEEN:
        return steady(fixed, now, t)
    phase = elliptic.phase(this.modulus, this.rate, this.start, t)
    shapes = _shapes(this, (spin / 2, -spin / 2, -spin), t, phase)
    alpha, beta, Omega = (shape * unit for shape, unit in zip(shapes, _fitting(this, now), strict=True))
    return alpha, beta, Omega


def _shapes(case: Case, turning: Sequence[Any], t: Array, phase: elliptic.Phase) -> list[ComplexArray]:
    """The three functions but for a constant unit factor each, turned on by ``turning``·t [rad/s]."""
    lattice = case.modulus.lattice
    # Half a period of sn on, all of θ1, θ2 change sign.
    flipped = np.where(phase.quarter % 4 >= 2, -1.0, 1.0)
    results = [
        flipped * _turn(factor.rate + extra, t, lattice, factor.height, phase.remainder[0])
        for factor, extra in zip(case.factors, turning, strict=True)
    ]
    for top in (False, True):
        here = (phase.quarter % 2 == 1) == top
        if not here.any():
            continue
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
    """exp(iλt), and the hyperbolic form's Gaussian, which goes round by −π·height·u/(2KK′)."""
    circle = 2 * mp.pi
    _, rest = fraction(affine(rate / circle, 0, t))
    angle = float(circle) * rest[0]
    if lattice.hyperbolic and not mp.isinf(lattice.K):
        angle = angle - float(lattice.scale * height / lattice.K) * remainder
    return np.asarray(np.cos(angle) + 1j * np.sin(angle))


def _fitting(case: Case, now: Sequence[complex]) -> list[complex]:
    """Unit factors that make α, β, Ω what they are at t = 0; a derivative tells where one is 0 there."""
    alpha, beta, across = now
    rates = (-beta * across.conjugate(), alpha * across, alpha.conjugate() * beta)
    start, origin = np.zeros(1), elliptic.phase(case.modulus, case.rate, case.start, np.zeros(1))
    here = _shapes(case, (0, 0, 0), start, origin)
    if not all(now):
        after = _shapes(case, (0, 0, 0), start, origin._replace(remainder=(np.array([_SOON]), start)))
        here = [h if value else a for value, h, a in zip(now, here, after, strict=True)]
    wanted = [value or rate for value, rate in zip(now, rates, strict=True)]
    return [_unit(w) / _unit(complex(h[0])) for w, h in zip(wanted, here, strict=True)]


def _unit(z: complex) -> complex:
    return z / abs(z)
