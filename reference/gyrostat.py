"""A body with a rotor inside that turns about an axis fixed in it: laws of motion, and the exact free motion.

The inertia tensor I is that of carrier and rotor together; the rotor adds the angular momentum h = Jσ along
its axis a, J its moment about the axis and σ its spin relative to the carrier: L = Iω + Jσ a.
(Landau & Lifshitz, *Mechanics*, § 36, Euler's equations; Volterra 1899; Wittenburg, *Dynamics of Multibody
Systems*, on gyrostats.)
"""

import numpy as np
import numpy.typing as npt

from . import quaternions
from .checked import Array, finite, not_negative, number, positive, principal_moments, times, unit_quaternion
from .double_double import turning
from .errors import InputError
from .multibody_tree import inertia_of_a_body
from .precise import mp


def accelerations(
    inertia: npt.ArrayLike,
    axis: npt.ArrayLike,
    rotor_moment: float,
    omega: npt.ArrayLike,
    spin: npt.ArrayLike,
    torque: npt.ArrayLike = (0.0, 0.0, 0.0),
    motor: npt.ArrayLike = 0.0,
) -> tuple[Array, Array]:
    """dω/dt and dσ/dt of a gyrostat about its centre of mass (or a fixed point).

    Parameters
    ----------
    inertia : (3, 3) of carrier and rotor together, body axes [kg m²]
    axis : (3,) of the rotor, in the body, through its own centre of mass; any length but 0
    rotor_moment : J, of the rotor about its axis, below that of the whole [kg m²]
    omega : (..., 3) of the carrier, body axes [rad/s]
    spin : (...) σ of the rotor relative to the carrier [rad/s]
    torque : (..., 3) from outside, body axes [N m]
    motor : (...) torque of the carrier on the rotor along the axis [N m]

    Returns
    -------
    omega_rate (..., 3), spin_rate (...) [rad/s²]

    Raises
    ------
    InputError
        For values out of range or shapes that do not fit.

    Notes
    -----
    I ω̇ + Jσ̇ a = τ − ω×(Iω + Jσ a) and J(σ̇ + a·ω̇) = motor: a rotor that nothing drives keeps σ + a·ω.
    """
    tensor, J = inertia_of_a_body("inertia", inertia), positive("rotor_moment", rotor_moment)
    a = _unit(axis)
    omega, spin, torque = finite("omega", omega), finite("spin", spin), finite("torque", torque)
    carrier = tensor - J * np.outer(a, a)
    if np.linalg.eigvalsh(carrier).min() <= 0:
        raise InputError(f"rotor_moment: got {J}, expected less than the whole body's about any axis")
    momentum = omega @ tensor + J * spin[..., None] * a
    motor = np.broadcast_to(finite("motor", motor), spin.shape)
    left = torque - np.cross(omega, momentum) - motor[..., None] * a
    omega_rate = np.asarray(np.linalg.solve(carrier, left[..., None])[..., 0], dtype=np.float64)
    return omega_rate, motor / J - omega_rate @ a


def precession_rate(I1: float, I3: float, h: float, omega3: float) -> float:
    """((I3 − I1)ω3 + h)/I1 [rad/s]: rate of ω about the axis in a body with I1 = I2 and a rotor along axis 3.

    ``h`` is Jσ [kg m²/s]. Without it, ``torque_free.body_cone_rate``. Raises InputError for bad moments.
    """
    I1, I3 = _moments(I1, I3)
    return ((I3 - I1) * number("omega3", omega3) + number("h", h)) / I1


def motion(
    I1: float, I3: float, h: float, q0: npt.ArrayLike, omega0: npt.ArrayLike, t: npt.ArrayLike
) -> tuple[Array, Array]:
    """Free motion of a symmetric body with a rotor along its axis, in closed form.

    Parameters
    ----------
    I1, I3 : moments of carrier and rotor together, I3 about the axis of both [kg m²]
    h : Jσ, the rotor's own angular momentum along axis 3 [kg m²/s]
    q0 : (4,) attitude at t = 0
    omega0 : (3,) angular velocity at t = 0, body axes [rad/s]
    t : (n,) times [s], of either sign

    Returns
    -------
    q (n, 4), omega (n, 3) body axes [rad/s]

    Raises
    ------
    InputError
        For moments that no body has, a quaternion that is not unit, shapes that do not fit, or times past
        10¹⁵ turns.

    Notes
    -----
    ω3 and σ stay, driven or not; ω1 + iω2 turns at ``precession_rate`` Λ. From ω = L/I1 − Λe3 the attitude is
    a turn about L by |L|t/I1 and one about e3 by −Λt, as for a symmetric top (Landau & Lifshitz, § 33).
    """
    I1, I3 = _moments(I1, I3)
    h, q0, omega0 = number("h", h), unit_quaternion("q0", q0), finite("omega0", omega0, (3,))
    t = times("t", t)
    w1, w2, w3 = (mp.mpf(float(w)) for w in omega0)
    momentum = [w1 * I1, w2 * I1, w3 * I3 + mp.mpf(h)]
    size = mp.sqrt(sum(component**2 for component in momentum))
    Lambda = (momentum[2] - I1 * w3) / I1
    along = np.array([float(component / size) if size else 0.0 for component in momentum])
    cosine, sine = turning(size / (2 * I1), mp.mpf(0), t)
    about_L = np.column_stack([np.outer(sine, quaternions.rotated(q0, along)), cosine])
    half_cosine, half_sine = turning(Lambda / 2, mp.mpf(0), t)
    nothing = np.zeros_like(t)
    about_axis = np.column_stack([nothing, nothing, -half_sine, half_cosine])
    cosine, sine = turning(Lambda, mp.mpf(0), t)
    w1, w2, w3 = omega0
    omega = np.column_stack([w1 * cosine - w2 * sine, w2 * cosine + w1 * sine, np.full_like(t, w3)])
    return quaternions.product(quaternions.product(about_L, q0), about_axis), omega


def steady_wobble(moments: npt.ArrayLike, h: float, omega3: float) -> tuple[float, float]:
    """Frequency [rad/s] and growth [1/s] of a small departure from turning about axis 3; one of them is 0.

    Parameters
    ----------
    moments : (3,) principal moments of the whole body, in any order [kg m²]
    h : Jσ of a rotor along axis 3, whose σ stays [kg m²/s]
    omega3 : [rad/s]

    Notes
    -----
    I1I2λ² = −((I3 − I2)ω3 + h)((I3 − I1)ω3 + h): enough h steadies even the axis of the middle moment.
    Raises InputError for moments that no body has.
    """
    I1, I2, I3 = principal_moments("moments", moments)
    w, h = number("omega3", omega3), number("h", h)
    product = ((I3 - I2) * w + h) * ((I3 - I1) * w + h) / (I1 * I2)
    return float(np.sqrt(max(product, 0.0))), float(np.sqrt(max(-product, 0.0)))


def steadying_momentum(moments: npt.ArrayLike, omega3: float) -> float:
    """Least h = Jσ ≥ 0 [kg m²/s] that steadies turning about axis 3 at ``omega3`` ≥ 0 [rad/s].

    (max(I1, I2) − I3)ω3 where axis 3 is that of the middle moment, otherwise 0: it is steady anyway.
    Raises as ``steady_wobble``.
    """
    I1, I2, I3 = principal_moments("moments", moments)
    omega3 = not_negative("omega3", omega3)
    return float((max(I1, I2) - I3) * omega3) if min(I1, I2) < I3 < max(I1, I2) else 0.0


def _moments(I1: float, I3: float) -> tuple[float, float]:
    principal_moments("moments", [I1, I1, I3])
    return float(I1), float(I3)


def _unit(axis: npt.ArrayLike) -> Array:
    a = finite("axis", axis, (3,))
    if not np.any(a):
        raise InputError("axis: got (0, 0, 0), expected a direction")
    a = a / np.abs(a).max()
    unit: Array = a / np.linalg.norm(a)
    return unit
