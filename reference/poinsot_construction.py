"""Poinsot's construction: the inertia ellipsoid of a free body rolls on a plane fixed in space.

ρ = ω/√(2T) lies on the ellipsoid ρ·Iρ = 1, whose normal there is along L; so the plane across L at the
distance ρ·L/|L| = √(2T)/|L| touches it, and does so without slipping, for ρ is along ω. The point of contact
draws the polhode on the ellipsoid and the herpolhode on the plane (Goldstein § 5.6; Landau & Lifshitz,
*Mechanics*, § 37).
"""

import numpy as np
import numpy.typing as npt

from . import torque_free
from .checked import Array, finite, principal_moments
from .errors import InputError
from .polhode import is_point, polhode
from .precise import mp
from .quaternions import rotated


def semiaxes(moments: npt.ArrayLike) -> Array:
    """Semiaxes 1/√I (3,) of the inertia ellipsoid [kg^−½ m^−1], for ``moments`` (3,) [kg m²]."""
    result: Array = 1 / np.sqrt(principal_moments("moments", moments))
    return result


def contact_point(moments: npt.ArrayLike, omega: npt.ArrayLike) -> Array:
    """ρ = ω/√(2T), (..., 3) in body axes [kg^−½ m^−1], for ``omega`` (..., 3) in body axes [rad/s].

    ``moments`` (3,) [kg m²]. Raises InputError for an ω of zero, which touches nowhere.
    """
    moments, omega = principal_moments("moments", moments), finite("omega", omega)
    if omega.ndim == 0 or omega.shape[-1] != 3:
        raise InputError(f"omega: got an array of shape {omega.shape}, expected (..., 3)")
    if np.any(np.all(omega == 0, axis=-1)):
        raise InputError("omega: got 0, expected a body that turns")
    result: Array = omega / np.sqrt(np.sum(moments * omega**2, axis=-1, keepdims=True))
    return result


def plane_distance(moments: npt.ArrayLike, omega: npt.ArrayLike) -> float:
    """√(2T)/|L| [kg^−½ m^−1], from the ellipsoid's centre to the invariable plane.

    ``moments`` (3,) [kg m²], ``omega`` (3,) body axes [rad/s], not 0.
    """
    moments, omega = principal_moments("moments", moments), finite("omega", omega, (3,))
    return float(1 / np.linalg.norm(moments * contact_point(moments, omega)))


def curves(
    moments: npt.ArrayLike, q0: npt.ArrayLike, omega0: npt.ArrayLike, t: npt.ArrayLike
) -> tuple[Array, Array]:
    """Polhode and herpolhode: the point of contact (n, 3) in body axes and in world axes [kg^−½ m^−1].

    Arguments as for `torque_free.motion`; ``omega0`` not 0. World axes have their origin in the ellipsoid's
    centre: every point of the herpolhode is at `plane_distance` from it along L.
    """
    q, omega = torque_free.motion(moments, q0, omega0, t)
    rho = contact_point(moments, omega)
    return rho, rotated(q, rho)


def herpolhode_radii(moments: npt.ArrayLike, omega: npt.ArrayLike) -> tuple[float, float]:
    """Least and greatest distance of the herpolhode from the foot of L on the plane [kg^−½ m^−1].

    ``moments`` (3,) [kg m²], ``omega`` (3,) body axes [rad/s], not 0. The two are equal, and the herpolhode a
    circle, for a symmetric top; it is a point for a steady spin. On the separatrix the least is the limit 0.
    """
    moments, omega = principal_moments("moments", moments), finite("omega", omega, (3,))
    if is_point(moments, omega):
        return 0.0, 0.0
    # ρ² − h² with n where sn = 0 and where sn = 1: the sum over pairs of axes has no difference that cancels.
    curve = polhode(moments, omega)
    (Ac, As, Ad), (Ic, Is, Id) = ([x**2 for x in curve.amplitudes], curve.moments)
    two_T_over_L2 = 2 * curve.T / curve.L**2
    beside = Ac * Ad * (1 / Ic - 1 / Id) ** 2 / two_T_over_L2
    middle = As * Ad * curve.modulus.m1 * (1 / Is - 1 / Id) ** 2 / two_T_over_L2
    low, high = sorted((beside, middle))
    return float(mp.sqrt(low)), float(mp.sqrt(high))
