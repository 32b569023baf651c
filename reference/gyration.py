"""Motion under a steady force and a steady turning of the velocity: r̈ = f + W×ṙ, in closed form.

A falling stone on a turning planet (W = −2Ω), a ball on a turntable (W = 2Ω/7) and a charge in a magnetic
field all move so: across W a circle, drifting; along W a parabola.
"""

import numpy as np
import numpy.typing as npt

from .checked import Array, finite, times
from .double_double import turning
from .precise import mp


def gyration(
    W: npt.ArrayLike, f: npt.ArrayLike, r0: npt.ArrayLike, v0: npt.ArrayLike, t: npt.ArrayLike
) -> tuple[Array, Array]:
    """Place and velocity at the times ``t``.

    Parameters
    ----------
    W : (3,) rate at which the velocity is turned [rad/s]
    f : (3,) steady acceleration [m/s²]
    r0, v0 : (3,) place [m] and velocity [m/s] at t = 0
    t : (n,) times [s], of either sign

    Returns
    -------
    r, v : (n, 3) [m], [m/s]

    Raises
    ------
    InputError
        For shapes that do not fit, numbers that are not finite, or times past 10¹⁵ turns.

    Notes
    -----
    With ⊥ the part across W and φ = |W|t, the matrix exponential of W× (Goldstein, sect. 4.7) is
    v = v∥ + f∥t + cos φ v⊥ + (sin φ/W)(f⊥ + W×v⊥) + ((1 − cos φ)/W²) W×f⊥, and r its integral.
    The same problem for a charge: Landau & Lifshitz, *Classical Theory of Fields*, §§ 21–22.
    """
    W, f = finite("W", W, (3,)), finite("f", f, (3,))
    r0, v0, t = finite("r0", r0, (3,)), finite("v0", v0, (3,)), times("t", t)
    v_across, f_across = _across(W, v0), _across(W, f)
    cosine, first, second, third = (array[:, None] for array in _integrals(W, t))
    seconds = t[:, None]
    v = (v0 - v_across) + (f - f_across) * seconds
    v = v + cosine * v_across + first * (f_across + np.cross(W, v_across)) + second * np.cross(W, f_across)
    r = r0 + (v0 - v_across) * seconds + 0.5 * (f - f_across) * seconds**2
    r = r + first * v_across + second * (f_across + np.cross(W, v_across)) + third * np.cross(W, f_across)
    return r, v


def _across(W: Array, vector: Array) -> Array:
    """The part of ``vector`` across W; none where there is no W."""
    largest = np.abs(W).max()
    if largest == 0:
        return np.zeros(3)
    n = W / largest
    result: Array = np.cross(np.cross(n, vector), n) / np.dot(n, n)
    return result


def _integrals(W: Array, t: Array) -> tuple[Array, Array, Array, Array]:
    """With φ = |W|t: cos φ, and its first three integrals from 0 to t: sin φ/|W|, (1 − cos φ)/|W|², ..."""
    rate = mp.sqrt(sum(mp.mpf(float(component)) ** 2 for component in W))
    cosine, sine = turning(rate, mp.mpf(0), t)
    phase = float(rate) * t
    # Below a radian the differences lose digits: half angles and the power series keep them.
    small = np.abs(phase) < 1
    large = np.where(small, 1.0, phase)
    first = np.where(small, np.sinc(phase / np.pi), sine / large)
    second = np.where(small, 0.5 * np.sinc(phase / (2 * np.pi)) ** 2, (1 - cosine) / large**2)
    series = np.zeros_like(t)
    for n in range(9, -1, -1):  # (φ − sin φ)/φ³ = Σ (−φ²)ⁿ/(2n + 3)!; the eleventh term is below 1e-22
        series = (1 - np.where(small, phase, 0.0) ** 2 * series) / ((2 * n + 2) * (2 * n + 3))
    third = np.where(small, series, (phase - sine) / large**3)
    return cosine, t * first, t**2 * second, t**3 * third
