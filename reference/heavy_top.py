"""A symmetric top with one point fixed, under gravity (Lagrange's top): its motion in closed form.

The world's z axis points up; the body's axis e3 runs from the fixed point to the centre of mass; I1 is the
moment about any axis through the *fixed point* across e3, I3 the moment about e3. Three things stay as they
are: p_γ = I3ω3, p_α = the vertical angular momentum, and E′ (Goldstein, *Classical Mechanics*, § 5.7; Landau
& Lifshitz, *Mechanics*, § 35, problem 1; Fetter & Walecka, § 29).
"""

from fractions import Fraction

import numpy as np
import numpy.typing as npt

from .checked import Array, finite, not_negative, number, positive, principal_moments, unit_quaternion
from .double_double import turning
from .errors import InputError
from .heavy_top_attitude import ComplexArray, Triple, case, values
from .heavy_top_roots import Constants, constants, real, steady
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
    t : (n,) times [s], in any order, negative ones too

    Returns
    -------
    q : (n, 4) unit quaternions, scalar last, body to world, changing without a jump from q0
    omega : (n, 3) angular velocity in body axes [rad/s]

    Raises
    ------
    InputError
        For an argument outside what is said above, for I3 > 2 I1, which no body has, or for a time so
        late (some 10¹⁵ turns) that double precision cannot hold the phase.

    Source: Klein & Sommerfeld, *Über die Theorie des Kreisels*, ch. VI; Goldstein, § 5.7.
    """
    start, rates, times = finite("q0", q0, (4,)), finite("omega0", omega0, (3,)), finite("t", t, (-1,))
    unit_quaternion("q0", start)
    I1, I3 = _moments(moments)
    moment = _weight_moment(mass, length, gravity)
    fixed = constants(moment, I1, I3, list(start), list(rates))
    if _weightless(fixed, times):
        triple = _free(fixed, start, rates, times)
    elif steady(fixed):
        triple = _steady(fixed, start, rates, times)
    else:
        triple = _nutating(fixed, start, rates, times)
    return _packed(triple, float(rates[2]))


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
    I1, I3 = _moments(moments)
    moment = real(_weight_moment(mass, length, gravity))
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


def _moments(moments: npt.ArrayLike) -> tuple[float, float]:
    I1, I3 = finite("moments", moments, (2,))
    principal_moments("moments (I1, I1, I3)", [I1, I1, I3])
    return float(I1), float(I3)


def _weight_moment(mass: float, length: float, gravity: float) -> Fraction:
    """Mgl, exactly."""
    return (
        Fraction(positive("mass", mass))
        * Fraction(not_negative("length", length))
        * Fraction(not_negative("gravity", gravity))
    )


def _weightless(fixed: Constants, t: Array) -> bool:
    """Whether gravity turns the body by less than 10⁻²⁰ rad up to the last of the times ``t``."""
    latest = Fraction(float(np.abs(t).max(initial=0.0)))
    return fixed.k * latest * latest < Fraction(1, 10**20)


def _parameters(q: Array) -> tuple[complex, complex]:
    """Cayley–Klein parameters α = w + iz, β = x + iy of a quaternion (Goldstein, § 4.5)."""
    x, y, z, w = (float(v) for v in q / np.linalg.norm(q))
    return complex(w, z), complex(x, y)


def _free(fixed: Constants, q0: Array, omega0: Array, t: Array) -> Triple:
    """No gravity: a turn about the fixed Ω at |Ω|, which is L/I1, and one about e3 (Landau § 33)."""
    alpha, beta = _parameters(q0)
    across = complex(omega0[0], omega0[1])
    speed = mp.sqrt(real(fixed.a * fixed.a + fixed.across))
    axial, lateral = (float(v / speed) if speed else 0.0 for v in (real(fixed.a), mp.mpf(1)))
    cosine, sine = turning(speed / 2, 0, t)
    half, whole = _unit(fixed.spin / 2, t), _unit(fixed.spin, t)
    lateral_turn = across * lateral
    turned = alpha * (cosine + 1j * axial * sine) - beta * np.conj(lateral_turn) * sine
    other = beta * (cosine - 1j * axial * sine) + alpha * lateral_turn * sine
    return turned * half, other * np.conj(half), across * np.conj(whole)


def _steady(fixed: Constants, q0: Array, omega0: Array, t: Array) -> Triple:
    """Regular precession, or asleep, or hanging: α, β and Ω keep their size."""
    alpha, beta = _parameters(q0)
    k, a, c, _, d0, _, lateral, spin = fixed
    around = (2 * a + c) / (2 * (2 - d0)) if d0 != 2 else Fraction(0)
    back = c / (2 * d0) if d0 else Fraction(0)
    across = -k * (c + a * d0) / (2 * lateral) if lateral else Fraction(0)
    return (
        alpha * _unit(around + spin / 2, t),
        beta * _unit(back - spin / 2, t),
        complex(omega0[0], omega0[1]) * _unit(across - spin, t),
    )


def _nutating(fixed: Constants, q0: Array, omega0: Array, t: Array) -> Triple:
    """Between two turning points: theta functions, and constants that fit the state at t = 0."""
    alpha, beta = _parameters(q0)
    across = complex(omega0[0], omega0[1])
    spin = real(fixed.spin)
    return values(case(fixed), (alpha, beta, across), (spin / 2, -spin / 2, -spin), t)


def _unit(rate: Fraction, t: Array) -> ComplexArray:
    cosine, sine = turning(real(rate), 0, t)
    return np.asarray(cosine + 1j * sine)


def _packed(triple: Triple, omega3: float) -> tuple[Array, Array]:
    alpha, beta, across = triple
    q = np.column_stack([beta.real, beta.imag, alpha.imag, alpha.real])
    q /= np.linalg.norm(q, axis=1, keepdims=True)
    return q, np.column_stack([across.real, across.imag, np.full(len(across), omega3)])
