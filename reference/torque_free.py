"""A rigid body that no torque acts on: its whole motion in closed form, and the rates of its two cones.

Euler's equations are solved by Jacobi's functions (`polhode`), the attitude by an elliptic integral of the
third kind. The angle that Landau & Lifshitz, *Mechanics*, § 37, use for it divides by sin²θ and fails where
an axis passes through L. Half of the angle φ in

    q = (turn by φ about L) · (shortest turn that takes n to e),   φ̇ = (2T/L + ω·e)/(1 + n·e)

does not, n = L/|L| in body axes, e the axis that n circles and so with n·e > 0 for ever: exp(iφ/2) is the
phase of the Cayley–Klein parameter α (Goldstein § 4.5), which has neither a pole nor a branch.
"""

import numpy as np
import numpy.typing as npt

from . import elliptic
from .checked import Array, finite, number, positive, principal_moments, times, unit_quaternion
from .double_double import turning
from .polhode import Polhode, direction, in_body_axes, is_point, polhode
from .precise import mp
from .quaternions import conjugate, product
from .theta import doubled


def motion(
    moments: npt.ArrayLike, q0: npt.ArrayLike, omega0: npt.ArrayLike, t: npt.ArrayLike
) -> tuple[Array, Array]:
    """Attitude and angular velocity at the times ``t`` of a body released with ``q0`` and ``omega0``.

    Parameters
    ----------
    moments : (3,) principal moments about the centre of mass along the body axes, in any order [kg m²]
    q0 : (4,) attitude at t = 0, unit quaternion, scalar last, body to world [1]
    omega0 : (3,) angular velocity at t = 0, body axes [rad/s]
    t : (n,) times, in any order and of either sign [s]; a single number counts as one time

    Returns
    -------
    q : (n, 4) unit quaternions, scalar last, body to world, changing without a jump from q0 [1]
    omega : (n, 3) angular velocity, body axes [rad/s]

    Raises
    ------
    InputError : moments that no body has, a quaternion that is not unit to 1e-9, shapes that do not fit,
        numbers that are not finite, times so late (10¹⁵ turns) that doubles do not determine the phase.

    Notes
    -----
    ω: Landau & Lifshitz, *Mechanics*, § 37; the attitude as in the module's text.
    """
    moments = principal_moments("moments", moments)
    q0 = unit_quaternion("q0", q0)
    omega0 = finite("omega0", omega0, (3,))
    t = times("t", t)
    if is_point(moments, omega0):
        return _steady(q0, omega0, t)
    curve = polhode(moments, omega0)
    # The start is one more time, so that q(0) = q0 holds whatever frame L was put in.
    n, phase = direction(curve, np.append(t, 0.0))
    from_L = _from_L(n, _half_turn(curve, phase, np.append(t, 0.0)))
    since = product(conjugate(from_L[-1]), np.eye(4))
    in_body = np.column_stack([in_body_axes(curve, since[:, :3]), since[:, 3]])
    L_over_I = np.array([float(curve.L / moment) for moment in curve.moments])
    return _unit(from_L[:-1] @ product(q0, in_body)), in_body_axes(curve, n[:-1] * L_over_I)


def body_cone_rate(I1: float, I3: float, omega3: float) -> float:
    """Rate Ω_b = (I3 − I1)ω3/I1 at which ω goes round the symmetry axis, in body axes [rad/s].

    ω1 + iω2 = A exp(i(Ω_b t + φ)): positive turns from e1 to e2, as in Landau & Lifshitz § 36. Taylor
    § 10.8 writes (I1 − I3)ω3/I1, which is the opposite sense.
    ``I1`` = I2, ``I3`` [kg m²], ``omega3`` [rad/s]. Raises InputError for moments that are not positive.
    """
    I1, I3, omega3 = positive("I1", I1), positive("I3", I3), number("omega3", omega3)
    return (I3 - I1) * omega3 / I1


def space_cone_rate(I1: float, I3: float, omega: npt.ArrayLike) -> float:
    """Rate φ̇ = L/I1 at which the symmetry axis and ω go round the fixed L [rad/s].

    ``I1`` = I2, ``I3`` [kg m²], ``omega`` (3,) body axes [rad/s]. Landau & Lifshitz § 33; Taylor
    § 10.8. Raises InputError for moments that are not positive or an ``omega`` that is not (3,).
    """
    I1, I3, omega = positive("I1", I1), positive("I3", I3), finite("omega", omega, (3,))
    return float(np.hypot(np.hypot(omega[0], omega[1]), I3 / I1 * omega[2]))


def _steady(q0: Array, omega0: Array, t: Array) -> tuple[Array, Array]:
    """Turning for ever about the axis it turns about, or not at all."""
    omega = [mp.mpf(component) for component in omega0.tolist()]
    speed = mp.norm(omega)
    axis = [float(component / speed) if speed else 0.0 for component in omega]
    cosine, sine = turning(speed / 2, 0, t)
    turn = np.column_stack([*(sine * component for component in axis), cosine])
    return _unit(product(q0, turn)), np.tile(omega0, (t.size, 1))


def _half_turn(curve: Polhode, phase: elliptic.Phase, t: Array) -> elliptic.ComplexArray:
    """exp(iφ/2) (n,) but for a constant turn.

    φ̇/2 has its poles where Ad·dn u = −1, at u = ±i(K′ + a) with sn(a | 1 − m) = Ad; their residues are
    ±i/2, by the sign of Id − Ic. So φ/2 is a constant rate and the argument of a theta function with
    twice the imaginary period, the one of dn.
    """
    Ac, _, Ad = curve.amplitudes
    Ic, _, Id = curve.moments
    m, m1, lattice = curve.modulus
    rate = curve.L * (2 * curve.T / curve.L**2 + Ad / Id) / (2 * (1 + Ad))  # φ̇/2 where u = 0
    periodic = np.ones(t.size, dtype=np.complex128)
    # With m = 0 (a symmetric top) n·e is constant, and so is φ̇.
    if m:
        a = Ad * mp.elliprf(Ac**2, m + m1 * Ac**2, 1)
        depth = mp.sign(Ic - Id) * (lattice.K_prime - a)
        rate -= curve.rate * elliptic.turn_rate(doubled(lattice), 4, depth)
        periodic = elliptic.turn(doubled(lattice), 4, depth, phase)
    cosine, sine = turning(rate, 0, t)
    return (cosine + 1j * sine) * periodic


def _from_L(n: Array, half_turn: elliptic.ComplexArray) -> Array:
    """The attitude (n, 4) of the axes (c, s, d) in a fixed frame whose third axis is L."""
    x, y, w = n[:, 1], -n[:, 0], 1 + n[:, 2]
    C, S = half_turn.real, half_turn.imag
    return _unit(np.stack([C * x - S * y, C * y + S * x, S * w, C * w], axis=-1))


def _unit(q: Array) -> Array:
    result: Array = q / np.linalg.norm(q, axis=-1, keepdims=True)
    return result
