"""A rigid body that no torque acts on: its whole motion in closed form, and the rates of its two cones.

Euler's equations are solved by Jacobi's functions (`polhode`), the attitude by an elliptic integral of the
third kind. The angle that Landau & Lifshitz, *Mechanics*, § 37, use for it divides by sin²θ and fails where
an axis passes through L. Half of the angle φ in

    q = (turn by φ about L) · (shortest turn that takes n to e),   φ̇ = (2T/L + ω·e)/(1 + n·e)

does not, n = L/|L| in body axes, e the axis that n circles and so with n·e > 0 for ever: exp(iφ/2) is the
phase of the Cayley–Klein parameter α (Goldstein § 4.5), which has neither a pole nor a branch.
"""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import elliptic
from .blocks import blocks
from .checked import Array, finite, number, positive, principal_moments, times, unit_quaternion
from .double_double import turning
from .polhode import Polhode, direction, in_body_axes, is_point, polhode
from .precise import mp
from .quaternions import conjugate, product
from .theta import Lattice, doubled


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
    turn = _half_turn(curve)
    to_world = _to_world(curve, turn, q0)
    L_over_I = np.array([[float(curve.L / moment)] for moment in curve.moments])
    q, omega = np.empty((t.size, 4)), np.empty((t.size, 3))
    for here in blocks(t.size):
        n, from_L = _from_L(curve, turn, t[here])
        q[here] = _unit(to_world @ from_L).T
        omega[here] = in_body_axes(curve, n * L_over_I).T
    return q, omega


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


class _HalfTurn(NamedTuple):
    """φ/2 = ``rate``·t + arg θ4(u + i·``depth``) over the ``lattice``, but for a constant."""

    rate: Any
    lattice: Lattice
    depth: Any


def _half_turn(curve: Polhode) -> _HalfTurn:
    """What φ/2 is made of.

    φ̇/2 has its poles where Ad·dn u = −1, at u = ±i(K′ + a) with sn(a | 1 − m) = Ad; their residues are
    ±i/2, by the sign of Id − Ic. So φ/2 is a constant rate and the argument of a theta function with
    twice the imaginary period, the one of dn. With m = 0, a symmetric top, φ̇ is constant.
    """
    Ac, _, Ad = curve.amplitudes
    Ic, _, Id = curve.moments
    m, m1, lattice = curve.modulus
    at_start = curve.L * (2 * curve.T / curve.L**2 + Ad / Id) / (2 * (1 + Ad))  # φ̇/2 where u = 0
    if not m:
        return _HalfTurn(at_start, lattice, None)
    a = Ad * mp.elliprf(Ac**2, m + m1 * Ac**2, 1)
    depth, twice = mp.sign(Ic - Id) * (lattice.K_prime - a), doubled(lattice)
    return _HalfTurn(at_start - curve.rate * elliptic.turn_rate(twice, 4, depth), twice, depth)


def _from_L(curve: Polhode, turn: _HalfTurn, t: Array) -> tuple[Array, Array]:
    """L/|L| (3, n) along the axes (c, s, d), and these axes' attitude (4, n) in a frame of third axis L."""
    n, phase = direction(curve, t)
    cosine, sine = turning(turn.rate, 0, t)
    if turn.depth is not None:
        periodic = elliptic.turn(turn.lattice, 4, turn.depth, phase)
        cosine, sine = (
            cosine * periodic.real - sine * periodic.imag,
            sine * periodic.real + cosine * periodic.imag,
        )
    x, y, w = n[1], -n[0], 1 + n[2]
    return n, _unit(np.stack([cosine * x - sine * y, cosine * y + sine * x, sine * w, cosine * w]))


def _to_world(curve: Polhode, turn: _HalfTurn, q0: Array) -> Array:
    """The matrix (4, 4) that takes the attitude of `_from_L` to that of the body in the world."""
    _, start = _from_L(curve, turn, np.zeros(1))
    since = product(conjugate(start[:, 0]), np.eye(4))
    in_body = np.column_stack([in_body_axes(curve, since[:, :3].T).T, since[:, 3]])
    return product(q0, in_body).T


def _steady(q0: Array, omega0: Array, t: Array) -> tuple[Array, Array]:
    """Turning for ever about the axis it turns about, or not at all."""
    omega = [mp.mpf(component) for component in omega0.tolist()]
    speed = mp.norm(omega)
    axis = [component / (speed or 1) for component in omega]
    cosine, sine = turning(speed / 2, 0, t)
    turn = np.column_stack([*(sine * float(component) for component in axis), cosine])
    return _unit(product(q0, turn).T).T, np.tile(omega0, (t.size, 1))


def _unit(q: Array) -> Array:
    """Quaternions (4, n) of unit length."""
    result: Array = q / np.sqrt(np.einsum("in,in->n", q, q))
    return result
