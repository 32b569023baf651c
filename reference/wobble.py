"""Rotation near a principal axis: wobble about a stable one, growth and flip about the middle one.

About axis k, with i and j the next two in cyclic order, Euler's equations to first order are ω̇i = −Ωi ωj and
ω̇j = Ωj ωi, where Ωi = ωk (Ik − Ij)/Ii and Ωj = ωk (Ik − Ii)/Ij (Landau & Lifshitz, *Mechanics*, § 37; Taylor
§ 10.8): an ellipse at the rate √(ΩiΩj), or growth at √(−ΩiΩj).
"""

import math

import numpy.typing as npt

from .checked import finite, number, principal_moments
from .errors import InputError
from .polhode import is_point, polhode
from .precise import mp


def linear_rates(moments: npt.ArrayLike, axis: int, spin: float) -> tuple[float, float]:
    """The (Ωi, Ωj) [rad/s] of a body spinning at ``spin`` [rad/s] about ``axis`` (0, 1 or 2).

    ``moments`` (3,) [kg m²]. Raises InputError for another axis, or moments that no body has.
    """
    moments, omega = principal_moments("moments", moments), number("spin", spin)
    if axis not in (0, 1, 2):
        raise InputError(f"axis: got {axis!r}, expected 0, 1 or 2")
    k = int(axis)
    i, j = (k + 1) % 3, (k + 2) % 3
    Ii, Ij, Ik = (float(moments[a]) for a in (i, j, k))
    return omega * (Ik - Ij) / Ii, omega * (Ik - Ii) / Ij


def wobble_rate(moments: npt.ArrayLike, axis: int, spin: float) -> float:
    """√(ΩiΩj) [rad/s], at which ω goes round a stable ``axis`` on a small ellipse; 0 where it stands.

    Arguments as for `linear_rates`. Raises InputError for the middle axis: it grows (`growth_rate`).
    """
    Omega_i, Omega_j = linear_rates(moments, axis, spin)
    if Omega_i * Omega_j < 0:
        raise InputError(
            f"axis: got {axis}, that of the middle moment, about which nothing wobbles: it grows"
        )
    return math.sqrt(abs(Omega_i * Omega_j))


def wobble_ratio(moments: npt.ArrayLike, axis: int) -> float:
    """√(Ωj/Ωi) [1]: the amplitude of ωj over that of ωi, for the same spin in either sense.

    Arguments as for `linear_rates`. Raises InputError where ω does not go round ``axis``: it is that of the
    middle moment, or its moment equals another one.
    """
    Omega_i, Omega_j = linear_rates(moments, axis, 1.0)
    if Omega_i * Omega_j <= 0:
        raise InputError(f"axis: got {axis}, expected that of the smallest or the largest moment, alone")
    return math.sqrt(Omega_j / Omega_i)


def growth_rate(moments: npt.ArrayLike, spin: float) -> float:
    """√(−ΩiΩj) [1/s], at which a small deviation from the axis of the middle moment grows.

    Arguments as for `linear_rates`; 0 if two moments are equal.
    """
    moments = principal_moments("moments", moments)
    Omega_i, Omega_j = linear_rates(moments, int(moments.argsort(kind="stable")[1]), spin)
    return math.sqrt(abs(Omega_i * Omega_j))


def flip_period(moments: npt.ArrayLike, omega: npt.ArrayLike) -> float:
    """4K(m)/λ [s], after which ω is what it was; spun about the middle axis the body flips twice in it.

    Exact for any amplitude: Landau & Lifshitz § 37. ``moments`` (3,) [kg m²], ``omega`` (3,) body axes
    [rad/s]. Infinite on the separatrix. Raises InputError where ω stands still in the body.
    """
    moments, omega = principal_moments("moments", moments), finite("omega", omega, (3,))
    if is_point(moments, omega):
        raise InputError(f"omega: got {omega.tolist()}, which stands still in this body: no period")
    curve = polhode(moments, omega)
    K = curve.modulus.lattice.K
    return math.inf if mp.isinf(K) else float(4 * K / curve.rate)
