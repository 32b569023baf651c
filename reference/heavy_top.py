"""A symmetric top with one point fixed, under gravity (Lagrange's top): its motion in closed form.

The world's z axis points up; the body's axis e3 runs from the fixed point to the centre of mass; I1 is the
moment about any axis through the *fixed point* across e3, I3 the moment about e3. Three things stay as they
are: p_γ = I3ω3, p_α = the vertical angular momentum, and E′ (Goldstein, *Classical Mechanics*, § 5.7; Landau
& Lifshitz, *Mechanics*, § 35, problem 1; Fetter & Walecka, ch. 5).
"""

from collections.abc import Callable, Sequence
from functools import partial

import numpy as np
import numpy.typing as npt

from .blocks import blocks
from .checked import Array, finite, number, times
from .errors import InputError
from .heavy_top_attitude import nutating
from .heavy_top_constants import (
    Constants,
    constants,
    is_steady,
    is_weightless,
    moments_of_a_top,
    real,
    weight_moment,
)
from .heavy_top_steady import Triple, steady, weightless
from .precise import mp

#: (I3ω3)² may be short by this of what regular precession asks, so that the threshold's own spin will do [1].
_ROUNDING = 1e-15


def motion(
    mass: float,
    length: float,
    moments: npt.ArrayLike,
    gravity: float,
    q0: npt.ArrayLike,
    omega0: npt.ArrayLike,
    t: npt.ArrayLike,
) -> tuple[Array, Array]:
    """Attitude and rates of a heavy symmetric top at the times ``t``, from any state at t = 0.

    Parameters
    ----------
    mass : M [kg], above 0
    length : l [m], from the fixed point to the centre of mass, along +e3; 0 or above
    moments : (I1, I3) [kg m²] about the fixed point
    gravity : g [m/s²], downwards; 0 or above
    q0 : (4,) attitude at t = 0, scalar last, body to world, of unit length
    omega0 : (3,) angular velocity at t = 0 in body axes [rad/s]
    t : (n,) times [s], in any order, negative ones too; a single number counts as one time

    Returns
    -------
    q : (n, 4) unit quaternions, scalar last, body to world, changing without a jump from q0
    omega : (n, 3) angular velocity in body axes [rad/s]

    Raises
    ------
    InputError
        For an argument outside what is said above, for I3 > 2 I1, which no body has, or for a time so
        late (some 10¹⁵ turns) that double precision cannot hold the phase.

    Notes
    -----
    Klein & Sommerfeld, *Über die Theorie des Kreisels*, ch. VI; Goldstein, § 5.7 for the cubic. How it is
    computed is said in `heavy_top_attitude`.
    """
    fixed = constants(mass, length, moments, gravity, q0, omega0)
    when = times("t", t)
    # Not divided by its length here: only the arguments of α and β are used, and their ratio.
    x, y, z, w = finite("q0", q0).tolist()
    w1, w2, w3 = finite("omega0", omega0).tolist()
    start = complex(w, z), complex(x, y), complex(w1, w2)
    follow = _follower(fixed, start, float(np.abs(when).max(initial=0.0)))
    q, omega = np.empty((when.size, 4)), np.full((when.size, 3), w3)
    for here in blocks(when.size):
        alpha, beta, across = follow(when[here])
        # Of unit length but for rounding, which this takes out.
        size = np.sqrt(alpha.real**2 + alpha.imag**2 + beta.real**2 + beta.imag**2)
        parts = (beta.real, beta.imag, alpha.imag, alpha.real)
        for column, part in enumerate(parts):
            np.divide(part, size, out=q[here, column])
        omega[here, 0], omega[here, 1] = across.real, across.imag
    return q, omega


def _follower(fixed: Constants, start: Sequence[complex], latest: float) -> Callable[[Array], Triple]:
    """The motion as a function of times, none later than ``latest`` [s] in size."""
    if is_weightless(fixed, latest):
        return partial(weightless, fixed, start)
    if is_steady(fixed):
        return partial(steady, fixed, start)
    return nutating(fixed, start)


def regular_precession(
    mass: float, length: float, moments: npt.ArrayLike, gravity: float, theta: float, omega3: float
) -> tuple[float, float]:
    """Both rates φ̇ [rad/s] at which a top precesses at the constant tilt ``theta`` [rad], slow and fast.

    The roots of I1 cosθ φ̇² − I3ω3 φ̇ + Mgl = 0, slow being the lesser in size. ``mass`` [kg], ``length``
    [m], ``moments`` (I1, I3) about the fixed point [kg m²], ``gravity`` [m/s²], ``omega3`` about e3 [rad/s],
    which holds φ̇ cosθ already. Above the horizontal both have the sign of ω3; below it they are opposite,
    and at ω3 = 0 they are the conical pendulum's, the slow one taken as positive.

    Raises InputError where (I3ω3)² < 4MglI1 cosθ: no such motion at so little spin. Source: Goldstein,
    § 5.7 (regular precession); Klein & Sommerfeld, ch. IV.
    """
    I1, I3 = moments_of_a_top(moments)
    moment = real(weight_moment(mass, length, gravity))
    cosine, spin = mp.cos(number("theta", theta)), mp.mpf(I3) * number("omega3", omega3)
    under = spin * spin - 4 * moment * I1 * cosine
    if under < -_ROUNDING * spin * spin:
        least = float(mp.sqrt(4 * moment * I1 * cosine) / I3)
        raise InputError(
            f"omega3: got {omega3}, too slow for regular precession at theta = {theta}: at least {least:.17g}"
        )
    root = mp.sqrt(max(under, mp.mpf(0)))
    larger = spin + (root if spin >= 0 else -root)
    slow = 2 * moment / larger if larger else mp.mpf(0)
    return float(slow), float(larger / (2 * I1 * cosine))
