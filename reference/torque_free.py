"""A rigid body that no torque acts on: its whole motion in closed form, and the rates that people quote.

Euler's equations are solved by Jacobi's functions (Landau & Lifshitz, *Mechanics*, § 37), the attitude by an
elliptic integral of the third kind. Instead of the book's angle ψ about L, whose formula divides by
sin²θ and fails where an axis passes through L, the attitude is built from half the angle φ of the
Cayley–Klein gauge (Goldstein, § 4.5): with n = L/|L| in body axes and e the axis that n circles,

    q = (turn by φ about L) · (shortest turn that takes n to e),   φ̇ = (2T/L + ω·e)/(1 + n·e),

and since that axis can be chosen with n·e > 0 for ever, nothing is singular anywhere.
"""

from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import elliptic
from .checked import Array, finite, number, positive, principal_moments, unit_quaternion
from .double_double import turning
from .precise import mp
from .quaternions import conjugate, product
from .theta import Lattice


class _Case(NamedTuple):
    """Axes named by the function that each component of n follows: (cn, sn, dn), turned so that n·e > 0."""

    axes: list[int]
    signs: Array
    amplitudes: list[Any]
    moments: list[Any]
    L: Any
    T: Any
    modulus: elliptic.Modulus
    rate: Any
    start: Any


def motion(
    moments: npt.ArrayLike, q0: npt.ArrayLike, omega0: npt.ArrayLike, t: npt.ArrayLike
) -> tuple[Array, Array]:
    """Attitude and angular velocity at the times ``t`` of a body released with ``q0`` and ``omega0``.

    Parameters
    ----------
    moments : (3,) principal moments about the centre of mass along the body axes, in any order [kg m²]
    q0 : (4,) attitude at t = 0, unit quaternion, scalar last, body to world [1]
    omega0 : (3,) angular velocity at t = 0, body axes [rad/s]
    t : (n,) times, in any order, of either sign [s]; a single number counts as one time

    Returns
    -------
    q : (n, 4) unit quaternions, scalar last, body to world [1]
    omega : (n, 3) angular velocity, body axes [rad/s]

    Raises
    ------
    InputError : moments that no body has, a quaternion that is not unit to 1e-9, shapes that do not fit,
        numbers that are not finite, times so late (10¹⁵ radians) that the input does not determine the phase

    Notes
    -----
    Landau & Lifshitz, *Mechanics*, § 37, eqs. 37.8–37.12 for ω; the attitude as in the module's text.
    """
    moments = principal_moments("moments", moments)
    q0 = unit_quaternion("q0", q0)
    omega0 = finite("omega0", omega0, (3,))
    t = np.atleast_1d(finite("t", t))
    t = finite("t", t, (-1,))
    if _is_steady(moments, omega0):
        return _steady(q0, omega0, t)
    case = _case(moments, omega0)
    n = _direction(case, t)
    half_turn = _half_turn(case, t)
    L_over_I = np.array([float(case.L / moment) for moment in case.moments])
    q = _attitude(case, q0, n, half_turn, t)
    omega = _in_body_axes(case, n * L_over_I)
    return q, omega


def body_cone_rate(I1: float, I3: float, omega3: float) -> float:
    """Rate Ω_b = (I3 − I1)ω3/I1 at which ω goes round the symmetry axis, in body axes [rad/s].

    ω1 + iω2 = A exp(i(Ω_b t + φ)): positive turns from e1 to e2. Goldstein § 5.6 (Ω), Taylor § 10.8 (Ω_b)
    with I1 − I3 in its place are the opposite sign. ``I1`` = I2, ``I3`` [kg m²], ``omega3`` [rad/s].
    Raises InputError for moments that are not positive.
    """
    I1, I3, omega3 = positive("I1", I1), positive("I3", I3), number("omega3", omega3)
    return (I3 - I1) * omega3 / I1


def space_cone_rate(I1: float, I3: float, omega: npt.ArrayLike) -> float:
    """Rate φ̇ = L/I1 at which the symmetry axis and ω go round the fixed L [rad/s].

    ``I1`` = I2, ``I3`` [kg m²], ``omega`` (3,) body axes [rad/s]. Landau & Lifshitz § 33, eq. 33.6; Taylor
    § 10.8. Raises InputError for moments that are not positive or an ``omega`` that is not (3,).
    """
    I1, I3, omega = positive("I1", I1), positive("I3", I3), finite("omega", omega, (3,))
    return float(np.hypot(np.hypot(omega[0], omega[1]), I3 / I1 * omega[2]))


def _is_steady(moments: Array, omega0: Array) -> bool:
    """Whether ω × Iω = 0 exactly: every pair of axes has equal moments or lacks a component."""
    pairs = ((0, 1), (1, 2), (2, 0))
    return all(moments[j] == moments[k] or omega0[j] == 0 or omega0[k] == 0 for j, k in pairs)


def _steady(q0: Array, omega0: Array, t: Array) -> tuple[Array, Array]:
    """Turning for ever about the axis it turns about (or not at all)."""
    squares = [mp.mpf(w) ** 2 for w in omega0.tolist()]
    speed = mp.sqrt(mp.fsum(squares))
    axis = [float(mp.mpf(w) / speed) if speed else 0.0 for w in omega0.tolist()]
    cosine, sine = turning(speed / 2, 0, t)
    turn = np.column_stack([*(sine * component for component in axis), cosine])
    return _unit(product(q0, turn)), np.tile(omega0, (t.size, 1))


def _case(moments: Array, omega0: Array) -> _Case:
    """Everything about a motion that does not depend on time; no difference in it loses digits."""
    axes, beyond = _axes(moments, omega0)
    signs = _signs(axes, omega0)
    Ic, Is, Id = (mp.mpf(float(moments[a])) for a in axes)
    wc, ws, wd = (mp.mpf(float(omega0[a] * s)) for a, s in zip(axes, signs, strict=True))
    L2 = (Ic * wc) ** 2 + (Is * ws) ** 2 + (Id * wd) ** 2
    T2 = Ic * wc**2 + Is * ws**2 + Id * wd**2
    over_c = Is * (Is - Ic) * ws**2 + Id * (Id - Ic) * wd**2  # L² − 2T·Ic
    under_d = Ic * (Id - Ic) * wc**2 + Is * (Id - Is) * ws**2  # 2T·Id − L²
    L = mp.sqrt(L2)
    # Eqs. 37.8: amplitudes of L1/L, L2/L, L3/L; 37.9 the clock; 37.10 the modulus, and its complement.
    Ac = mp.sqrt(Ic * under_d / ((Id - Ic) * L2))
    As = mp.sqrt(Is * under_d / ((Id - Is) * L2)) * (1 if Id > Ic else -1)
    Ad = mp.sqrt(Id * over_c / ((Id - Ic) * L2))
    rate = mp.sqrt((Id - Is) * over_c / (Ic * Is * Id))
    m = (Is - Ic) * under_d / ((Id - Is) * over_c)
    m1 = (Id - Ic) * beyond / ((Id - Is) * over_c)
    start = elliptic.first_kind(Is * ws / (As * L), Ic * wc / (Ac * L), Id * wd / (Ad * L))
    modulus = elliptic.modulus(m, m1)
    return _Case(axes, signs, [Ac, As, Ad], [Ic, Is, Id], L, T2 / 2, modulus, rate, start)


def _axes(moments: Array, omega0: Array) -> tuple[list[int], Any]:
    """The axes (c, s, d), and L² − 2T·I_s without rounding: its sign is the side of the separatrix."""
    low, middle, high = np.argsort(moments, kind="stable").tolist()
    exact = [(Fraction(float(i)), Fraction(float(w))) for i, w in zip(moments, omega0, strict=True)]
    beyond = sum(i * (i - exact[middle][0]) * w * w for i, w in exact)
    axes = [low, middle, high] if beyond >= 0 else [high, middle, low]
    return axes, mp.mpf(beyond.numerator) / mp.mpf(beyond.denominator)


def _signs(axes: list[int], omega0: Array) -> Array:
    """Directions ±1 of the axes (c, s, d), right-handed, along which cn and dn start out positive."""
    c, s, d = (-1.0 if omega0[a] < 0 else 1.0 for a in axes)
    handed = 1.0 if axes in ([0, 1, 2], [1, 2, 0], [2, 0, 1]) else -1.0
    return np.array([c, handed * c * d, d])


def _direction(case: _Case, t: Array) -> Array:
    """N = L/|L| (n, 3) along the axes (c, s, d)."""
    sn, cn, dn = elliptic.jacobi(case.modulus, elliptic.phase(case.modulus, case.rate, case.start, t))
    Ac, As, Ad = (float(amplitude) for amplitude in case.amplitudes)
    return np.column_stack([Ac * cn, As * sn, Ad * dn])


def _half_turn(case: _Case, t: Array) -> elliptic.ComplexArray:
    """exp(iφ/2) (n,) but for a constant turn.

    φ̇/2 has its poles where dn = −1/A_d, at u = ±i(K′ + a) with sn(a | 1 − m) = A_d, of residue ±i/2 (the sign is
    that of I_d − I_c): so φ/2 is the argument of a theta function with twice the imaginary period, and a constant rate beside it.
    """
    Ac, _, Ad = case.amplitudes
    m, m1, lattice = case.modulus
    at_top = (2 * case.T / case.L + case.L * Ad / case.moments[2]) / (2 * (1 + Ad))  # φ̇/2 where u = 0
    if not m:
        cosine, sine = turning(at_top, 0, t)
        return cosine + 1j * sine
    a = Ad * mp.elliprf(Ac**2, m + m1 * Ac**2, 1)
    doubled = Lattice(lattice.K, 2 * lattice.K_prime)
    depth = (lattice.K_prime - a) * (-1 if case.moments[2] > case.moments[0] else 1)
    phase = elliptic.phase(case.modulus, case.rate, case.start, t)
    secular = at_top - case.rate * elliptic.turn_rate(doubled, 4, depth)
    cosine, sine = turning(secular, 0, t)
    return (cosine + 1j * sine) * elliptic.turn(doubled, 4, depth, phase)


def _attitude(case: _Case, q0: Array, n: Array, half_turn: elliptic.ComplexArray, t: Array) -> Array:
    start = np.zeros(1)
    now = _from_L(n, half_turn)
    then = _from_L(_direction(case, start), _half_turn(case, start))
    since = product(conjugate(then), now)
    vector = _in_body_axes(case, since[:, :3])
    return _unit(product(q0, np.column_stack([vector, since[:, 3]])))


def _from_L(n: Array, half_turn: elliptic.ComplexArray) -> Array:
    """The attitude (n, 4) of the axes (c, s, d) in a fixed frame whose third axis is L."""
    x, y, w = n[:, 1], -n[:, 0], 1 + n[:, 2]
    C, S = half_turn.real, half_turn.imag
    return _unit(np.column_stack([C * x - S * y, C * y + S * x, S * w, C * w]))


def _in_body_axes(case: _Case, vector: Array) -> Array:
    result = np.empty_like(vector)
    result[:, case.axes] = vector * case.signs
    return result


def _unit(q: Array) -> Array:
    return q / np.linalg.norm(q, axis=-1, keepdims=True)
