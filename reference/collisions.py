"""Two bodies that meet: velocities after, energy lost, in the laboratory and about the centre of mass."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from .checked import Array, finite, positive, within
from .errors import InputError
from .two_body import reduced_mass


class Collision(NamedTuple):
    """What a collision leaves; velocities [m/s] in the shape they were given in."""

    v1: Array  # after
    v2: Array  # after
    impulse: Array  # on the first body [N s]
    energy_lost: float  # Q [J]


def collide(
    m1: float,
    m2: float,
    v1: npt.ArrayLike,
    v2: npt.ArrayLike,
    restitution: float,
    normal: npt.ArrayLike | None = None,
) -> Collision:
    """Collision of two smooth bodies with a coefficient of restitution.

    Parameters
    ----------
    m1, m2 : masses [kg]
    v1, v2 : velocities before, numbers or (3,) [m/s]
    restitution : e, from 0 (they stay together) to 1 (no energy lost)
    normal : (3,) line of the blow, of any length but 0 and either direction; only for vectors, and by
        default the line of the relative velocity (a head-on collision)

    Raises
    ------
    InputError
        For values out of range, shapes that do not fit, or a normal of no length.

    Notes
    -----
    Along the normal v1′ = ((m1 − e m2) v1 + m2 (1 + e) v2)/(m1 + m2), and the other way about for v2′;
    across it nothing changes. Q = ½μ(1 − e²)u², u the relative velocity along the normal. Written with the
    impulse μ(1 + e)u, so that momentum is kept to the last digit. Newton's law of impact; for
    e = 1 Landau & Lifshitz, *Mechanics*, § 17; with a loss Q, Goldstein, sect. 3.11.
    """
    e, mu = within("restitution", restitution, 0.0, 1.0), reduced_mass(m1, m2)
    v1, v2 = finite("v1", v1), finite("v2", v2)
    if v1.shape != v2.shape or v1.shape not in ((), (3,)):
        raise InputError(f"v1, v2: got shapes {v1.shape} and {v2.shape}, expected two numbers or two (3,)")
    closing = v2 - v1
    if normal is not None:
        n = finite("normal", normal, v1.shape)
        if n.shape != (3,) or not np.any(n):
            raise InputError(f"normal: got {n.tolist()}, expected a direction (3,)")
        n = n / np.abs(n).max()
        closing = n * (np.dot(closing, n) / np.dot(n, n))
    impulse = mu * (1 + e) * closing
    lost = 0.5 * mu * (1 - e) * (1 + e) * float(np.sum(closing**2))
    return Collision(v1 + impulse / m1, v2 - impulse / m2, impulse, lost)


def centre_of_mass_velocity(m1: float, m2: float, v1: npt.ArrayLike, v2: npt.ArrayLike) -> Array:
    """V = (m1 v1 + m2 v2)/(m1 + m2) [m/s], in the shape of ``v1`` and ``v2``. Goldstein, sect. 3.11."""
    m1, m2 = positive("m1", m1), positive("m2", m2)
    v1, v2 = finite("v1", v1), finite("v2", v2)
    share = 1 / (1 + m2 / m1)
    result: Array = share * v1 + (1 - share) * v2
    return result


def laboratory_angle(m1: float, m2: float, angle: npt.ArrayLike, restitution: float = 1.0) -> Array:
    """Angle in the laboratory by which m1, shot at a resting m2, is turned.

    Parameters
    ----------
    m1, m2 : masses [kg]
    angle : Θ (...), by which the relative velocity is turned, 0 to π [rad]
    restitution : e, relative speed after over before, above 0 to 1

    Returns
    -------
    (...) : ϑ, tan ϑ = sinΘ/(cosΘ + m1/(e m2)), 0 to π [rad]

    Raises
    ------
    InputError
        For values out of range.

    Notes
    -----
    Goldstein, sect. 3.11; Landau & Lifshitz, *Mechanics*, § 17. Equal masses without loss: ϑ = Θ/2, and the
    two part at a right angle.
    """
    m1, m2 = positive("m1", m1), positive("m2", m2)
    e, theta = within("restitution", restitution, 0.0, 1.0), finite("angle", angle)
    if np.any((theta < 0) | (theta > np.pi)) or e == 0:
        raise InputError(f"angle, restitution: got {theta.tolist()} and {e}, expected 0 to π, and above 0")
    return np.asarray(np.arctan2(m2 * e * np.sin(theta), m2 * e * np.cos(theta) + m1))
