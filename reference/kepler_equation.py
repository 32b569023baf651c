"""Kepler's equation, solved to round-off for every eccentricity: ellipse, parabola, hyperbola.

Written in e and 1 − e (or e − 1) given apart, because next to a parabola the second is lost in the first:
E − e sinE = (1 − e) E + e (E − sinE), two terms of one sign.
"""

import numpy as np

from .checked import Array

# Newton's steps from a bound above the root shrink at least by a third even where the root is triple.
_MOST_STEPS = 100


def eccentric_anomaly(mean: Array, e: float, one_minus_e: float) -> Array:
    """E (n,) in −π … π [rad] of E − e sinE = M, for mean anomalies M (n,) in −π … π, 0 ≤ e ≤ 1.

    Goldstein, sect. 3.8; Landau & Lifshitz, *Mechanics*, § 15. The function bends one way on 0 … π, so
    that Newton's steps from above cannot pass the root.
    """
    M = np.abs(mean)
    with np.errstate(divide="ignore", over="ignore"):
        E = np.minimum(np.cbrt(12 * M / max(e, 1e-300)), np.pi)  # E − sinE ≥ E³/12 up to π
        if one_minus_e > 0:
            E = np.minimum(E, M / one_minus_e)
    for _ in range(_MOST_STEPS):
        residual = one_minus_e * E + e * less_sine(E) - M
        slope = one_minus_e + 2 * e * np.sin(E / 2) ** 2
        step = np.where(slope > 0, residual / np.where(slope > 0, slope, 1.0), 0.0)
        E = E - step
        if np.all(np.abs(step) <= 1e-15 * np.abs(E)):
            break
    result: Array = np.copysign(E, mean)
    return result


def hyperbolic_anomaly(mean: Array, e: float, e_minus_one: float) -> Array:
    """H (n,) of e sinhH − H = M, for M (n,) of either sign, e > 1. Landau & Lifshitz, *Mechanics*, § 15."""
    M = np.abs(mean)
    # Three bounds above the root, from (e − 1) sinhH ≤ M, H³/6 ≤ M and, past H = 2.2, sinhH ≤ 2M.
    H = np.minimum(np.cbrt(6 * M), np.maximum(2.2, np.arcsinh(2 * M)))
    if e_minus_one > 0:
        H = np.minimum(H, np.arcsinh(M / e_minus_one))
    for _ in range(_MOST_STEPS):
        residual = e_minus_one * np.sinh(H) + sine_less(H) - M
        slope = e_minus_one * np.cosh(H) + 2 * np.sinh(H / 2) ** 2
        step = np.where(slope > 0, residual / np.where(slope > 0, slope, 1.0), 0.0)
        H = H - step
        if np.all(np.abs(step) <= 1e-15 * np.abs(H)):
            break
    result: Array = np.copysign(H, mean)
    return result


def parabolic_anomaly(mean: Array) -> Array:
    """D (n,) of D + D³/3 = M, Barker's equation; D is the tangent of half the true anomaly.

    Goldstein, sect. 3.8. In closed form, and one step of Newton's for what the sinh of a large number lost.
    """
    D = 2 * np.sinh(np.arcsinh(1.5 * mean) / 3)
    result: Array = D - (D + D**3 / 3 - mean) / (1 + D * D)
    return result


def less_sine(x: Array) -> Array:
    """``x − sin x`` to its own last digits, however small x."""
    return np.where(np.abs(x) < 1, _odd_series(x, -1.0), x - np.sin(x))


def sine_less(x: Array) -> Array:
    """``sinh x − x`` to its own last digits, however small x."""
    return np.where(np.abs(x) < 1, _odd_series(x, 1.0), np.sinh(x) - x)


def _odd_series(x: Array, sign: float) -> Array:
    """x³/3! + sign x⁵/5! + x⁷/7! + …; used up to 1, where the tenth term is below 1e-20."""
    square = sign * np.minimum(x * x, 1.0)
    total = np.zeros_like(x)
    for n in range(10, 0, -1):
        total = (1 + square * total) / (2 * n * (2 * n + 1))
    return x**3 * total
