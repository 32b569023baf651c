"""Attitude and rates of a heavy symmetric top that nutates, at any times: quotients of theta functions.

`heavy_top_case` says which, and holds what does not depend on time. Here all is in double precision, but
for the phases, which are reduced in extended precision first.
"""

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import partial
from typing import Any

import numpy as np

from . import elliptic
from .checked import Array
from .double_double import affine, fraction, two_sum
from .heavy_top_case import Case, Factor, case
from .heavy_top_constants import Constants, real
from .heavy_top_roots import roots
from .heavy_top_steady import ComplexArray, Triple, steady
from .precise import mp
from .theta import Lattice, Waves, theta, theta_above, waves

#: A modulus m, or a 1 − cos of the angle to the vertical, that no double shows.
_UNSEEN = Fraction(1, 10**200)

#: A step of u so small that no function of it differs from its first two terms.
_MOMENT = 1e-18

#: Beside its rate a function below this is compared after such a step.
_VANISHING = 1e-16


def nutating(fixed: Constants, now: Sequence[complex]) -> Callable[[Array], Triple]:
    """A motion with gravity that is not steady: from times (n,) to α = w + iz, β = x + iy and Ω1 + iΩ2.

    These are in the body's axes; ``now`` holds them at t = 0. What does not depend on time is computed here.
    """
    found = roots(fixed)
    if found.d12 < real(_UNSEEN) * found.d13:
        return _unseen(fixed, now)
    this, spin = case(fixed, found), real(fixed.spin)
    units = _fitting(this, fixed, now)

    def at(t: Array) -> Triple:
        phase = elliptic.phase(this.modulus, this.rate, this.start, t)
        shapes = _shapes(this, (spin / 2, -spin / 2, -spin), t, phase)
        alpha, beta, Omega = (shape * unit for shape, unit in zip(shapes, units, strict=True))
        return alpha, beta, Omega

    return at


def _unseen(fixed: Constants, now: Sequence[complex]) -> Callable[[Array], Triple]:
    """Regular precession but for a nutation that no double shows; next to the vertical, asleep."""
    alpha, beta, _ = now
    if fixed.d0 < _UNSEEN:
        return partial(
            steady, fixed._replace(d0=Fraction(0), c=Fraction(0), across=Fraction(0)), (alpha, 0j, 0j)
        )
    if 2 - fixed.d0 < _UNSEEN:
        upside_down = fixed._replace(d0=Fraction(2), c=-2 * fixed.a, across=Fraction(0))
        return partial(steady, upside_down, (0j, beta, 0j))
    return partial(steady, fixed, now)


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


def _fitting(case: Case, fixed: Constants, now: Sequence[complex]) -> list[complex]:
    """Unit factors that make α, β, Ω what they are at t = 0.

    One that all but vanishes there is compared a moment later, where the start's own digits still tell it.
    """
    alpha, beta, Omega = (mp.mpc(value) for value in now)
    ia, k = mp.mpc(0, real(fixed.a)), real(fixed.k)
    rates = (
        (ia * alpha - beta * mp.conj(Omega)) / 2,
        (alpha * Omega - ia * beta) / 2,
        k * mp.conj(alpha) * beta,
    )
    zero, origin = np.zeros(1), elliptic.phase(case.modulus, case.rate, case.start, np.zeros(1))
    moved = origin._replace(remainder=two_sum(origin.remainder[0] + _MOMENT, origin.remainder[1]))
    # Their sizes, which are above 0, may be too small for a double to keep its digits.
    plain = case._replace(factors=tuple(factor._replace(size=(1.0, 1.0)) for factor in case.factors))
    here, soon = (_shapes(plain, (0, 0, 0), zero, phase) for phase in (origin, moved))
    units = []
    for value, rate, at_start, later in zip((alpha, beta, Omega), rates, here, soon, strict=True):
        step = rate / case.rate
        vanishing = abs(value) < _VANISHING * abs(step)
        wanted, found = (value + _MOMENT * step, later) if vanishing else (value, at_start)
        units.append(_unit(wanted) / _unit(mp.mpc(found[0])))
    return units


def _unit(z: Any) -> complex:
    size = abs(z)
    return complex(z / size) if size else 1 + 0j
