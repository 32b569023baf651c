"""Small oscillations about an equilibrium: frequencies, modes and the motion they add up to.

The energies are ½ η̇ᵀTη̇ and ½ ηᵀVη, η the displacements, T and V constant matrices.
Source: Goldstein, *Classical Mechanics*, §§ 6.1–6.3; Landau & Lifshitz, *Mechanics*, § 23.
"""

import numpy as np
import numpy.typing as npt

from .checked import Array, finite, times
from .eigenpairs import Long, eigenpairs, energy_matrices
from .errors import InputError


def normal_modes(T: npt.ArrayLike, V: npt.ArrayLike) -> tuple[Array, Array]:
    """Frequencies and modes of Tη̈ + Vη = 0, the slowest first.

    A frequency is exactly 0 where rounding the entries of V could have made it so; modes of equal
    frequency are orthogonal under T. Of each mode, the first entry above half its largest is positive.

    Parameters
    ----------
    T, V : (n, n)
        Symmetric; T positive definite (masses), V without a falling direction (stiffnesses).

    Returns
    -------
    omega : (n,)
        Roots of det(V − ω²T) = 0 [rad/s].
    A : (n, n)
        Modes as columns, AᵀTA = 1 and AᵀVA = diag(ω²).

    Raises
    ------
    InputError
        T or V is not symmetric to rounding, T is not positive definite, or the equilibrium is
        unstable (V falls in some direction): the message gives the growth rate.

    Source: Goldstein § 6.2 (the eigenvalue equation) and § 6.3 (normal coordinates).
    """
    omega, A = _extended_modes(*energy_matrices(T, V))
    return omega.astype(np.float64), A.astype(np.float64)


def normal_coordinates(T: npt.ArrayLike, V: npt.ArrayLike, eta: npt.ArrayLike) -> Array:
    """ξ = A⁻¹η = AᵀTη for displacements (or velocities) η (..., n); A as `normal_modes` returns it.

    Raises as `normal_modes` does, or if η does not end in n components.
    Source: Goldstein § 6.3.
    """
    masses, stiffness = energy_matrices(T, V)
    displaced = finite("eta", eta)
    if displaced.ndim == 0 or displaced.shape[-1] != len(masses):
        raise InputError(f"eta: got shape {displaced.shape}, expected (..., {len(masses)})")
    _, A = _extended_modes(masses, stiffness)
    return np.asarray(displaced @ (masses @ A), dtype=np.float64)


def motion(
    T: npt.ArrayLike, V: npt.ArrayLike, q0: npt.ArrayLike, v0: npt.ArrayLike, t: npt.ArrayLike
) -> tuple[Array, Array]:
    """Displacements and velocities at the times t: each mode on its own, zero modes drifting.

    Parameters
    ----------
    T, V : (n, n)
        As for `normal_modes`.
    q0, v0 : (n,)
        Displacements and velocities at t = 0.
    t : (m,)
        Times [s], of either sign; a single number counts as one.

    Returns
    -------
    q, v : (m, n)

    Raises
    ------
    InputError
        As `normal_modes`, or shapes do not fit.

    Source: Goldstein § 6.3: ξ = ξ(0) cos ωt + ξ̇(0) sin(ωt)/ω, whose limit for ω = 0 is ξ(0) + ξ̇(0)t.
    """
    masses, stiffness = energy_matrices(T, V)
    n = len(masses)
    start, speed = finite("q0", q0, (n,)), finite("v0", v0, (n,))
    now = times("t", t).astype(np.longdouble)[:, None]
    omega, A = _extended_modes(masses, stiffness)
    xi0, rate0 = start @ (masses @ A), speed @ (masses @ A)
    # Phases and sums stay in extended precision: ωt may be thousands of radians.
    cos, sin = np.cos(omega * now), np.sin(omega * now)
    drift = np.where(omega == 0, now, sin / np.where(omega == 0, 1, omega))
    q = (xi0 * cos + rate0 * drift) @ A.T
    v = (rate0 * cos - xi0 * omega * sin) @ A.T
    return q.astype(np.float64), v.astype(np.float64)


def _extended_modes(masses: Array, stiffness: Array) -> tuple[Long, Long]:
    squares, A = eigenpairs(masses, stiffness)
    if np.any(squares < 0):
        rate = float(np.sqrt(-squares.min()))
        raise InputError(
            f"V: got a matrix under which a displacement grows at {rate:g} 1/s; expected a stable or "
            "neutral equilibrium, ηᵀVη ≥ 0 for every η"
        )
    return np.sqrt(squares), A
