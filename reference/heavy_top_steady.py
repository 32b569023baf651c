"""A symmetric top's motions that need no elliptic function: without weight, and at one tilt for ever.

Both give α = w + iz, β = x + iy and Ω1 + iΩ2 as `heavy_top_attitude` does, in the body's own axes.
"""

from collections.abc import Sequence
from fractions import Fraction

import numpy as np
import numpy.typing as npt

from .checked import Array
from .double_double import turning
from .heavy_top_constants import Constants, real
from .precise import mp

ComplexArray = npt.NDArray[np.complex128]

#: α, β and Ω1 + iΩ2, each (n,).
Triple = tuple[ComplexArray, ComplexArray, ComplexArray]


def weightless(fixed: Constants, now: Sequence[complex], t: Array) -> Triple:
    """No gravity: Ω, which is L/I1, stays fixed in the axes that turn about e3 (Landau & Lifshitz, § 33).

    So α̇ = ½(iaα − βΩ̄), β̇ = ½(αΩ − iaβ) has constant coefficients. ``now`` holds α, β, Ω1 + iΩ2 at t = 0.
    """
    alpha, beta, across = now
    speed = mp.sqrt(real(fixed.a * fixed.a + fixed.across))
    cosine, sine = turning(speed / 2, 0, t)
    axial = float(real(fixed.a) / speed) if speed else 0.0
    lateral = complex(mp.mpc(across) / speed) if speed else 0j
    half, whole = unit(fixed.spin / 2, t), unit(fixed.spin, t)
    return (
        (alpha * (cosine + 1j * axial * sine) - beta * lateral.conjugate() * sine) * half,
        (beta * (cosine - 1j * axial * sine) + alpha * lateral * sine) * half.conj(),
        across * whole.conj(),
    )


def steady(fixed: Constants, now: Sequence[complex], t: Array) -> Triple:
    """Regular precession, upright, or hanging: α, β and Ω only turn. ``now`` holds them at t = 0."""
    alpha, beta, across = now
    of_alpha, of_beta, of_Omega = rates(fixed)
    return (
        alpha * unit(of_alpha + fixed.spin / 2, t),
        beta * unit(of_beta - fixed.spin / 2, t),
        across * unit(of_Omega - fixed.spin, t),
    )


def rates(fixed: Constants) -> tuple[Fraction, Fraction, Fraction]:
    """How fast the arguments of α, β, Ω turn at t = 0, but for the spin [rad/s]; 0 for one that vanishes."""
    k, a, c, _, d0, _, across, _ = fixed
    still = Fraction(0)
    of_alpha = (2 * a + c) / (2 * (2 - d0)) if d0 != 2 else still
    of_beta = c / (2 * d0) if d0 else still
    return of_alpha, of_beta, -k * (c + a * d0) / (2 * across) if across else still


def unit(rate: Fraction, t: Array) -> ComplexArray:
    """exp(i·rate·t) (n,)."""
    cosine, sine = turning(real(rate), 0, t)
    return np.asarray(cosine + 1j * sine)
