"""Two free bodies that pull on each other: their separation orbits, their centre of mass drifts."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from .checked import Array, finite, not_negative, positive, times
from .double_double import turning
from .errors import InputError
from .kepler_orbit import exact_motion
from .precise import mp


def reduced_mass(m1: float, m2: float) -> float:
    """μ = m1 m2/(m1 + m2) [kg]: the mass that the separation seems to have. Taylor, sect. 8.3."""
    m1, m2 = positive("m1", m1), positive("m2", m2)
    # The smaller over one plus the ratio: no overflow, and exactly m1 as m2 → ∞.
    return min(m1, m2) / (1 + min(m1, m2) / max(m1, m2))


def spring_motion(
    m1: float,
    m2: float,
    stiffness: float,
    positions: npt.ArrayLike,
    velocities: npt.ArrayLike,
    t: npt.ArrayLike,
    length: float = 0.0,
) -> tuple[Array, Array]:
    """Two bodies joined by a spring.

    Parameters
    ----------
    m1, m2 : masses [kg]
    stiffness : k [N/m]
    positions, velocities : (2, 3) of the two bodies at t = 0 [m], [m/s]
    t : (n,) times [s], of either sign
    length : of the slack spring [m]; above 0, the bodies must move along their line and never meet

    Returns
    -------
    positions, velocities : (n, 2, 3) [m], [m/s]

    Raises
    ------
    InputError
        For values out of range, shapes that do not fit, and for a spring of some length whose bodies
        turn about each other or meet: that motion is not harmonic.

    Notes
    -----
    The separation swings at ω = √(k/μ): Taylor, sects. 8.2–8.3; Landau & Lifshitz, *Mechanics*, §§ 13, 23.
    """
    m1, m2, k = positive("m1", m1), positive("m2", m2), positive("stiffness", stiffness)
    r0, v0 = (finite("positions", positions, (2, 3)), finite("velocities", velocities, (2, 3)))
    t, length = times("t", t), not_negative("length", length)
    apart, parting = r0[0] - r0[1], v0[0] - v0[1]
    omega = mp.sqrt(mp.mpf(k) * (mp.mpf(m1) + mp.mpf(m2)) / (mp.mpf(m1) * mp.mpf(m2)))
    slack = _slack(apart, parting, length, float(omega))
    cosine, sine = (array[:, None] for array in turning(omega, mp.mpf(0), t))
    swing, rate = apart - slack, parting / float(omega)
    r = slack + swing * cosine + rate * sine
    v = float(omega) * (rate * cosine - swing * sine)
    return _of_both(m1, m2, r0, v0, r, v, t)


def gravity_motion(
    m1: float,
    m2: float,
    G: float,
    positions: npt.ArrayLike,
    velocities: npt.ArrayLike,
    t: npt.ArrayLike,
) -> tuple[Array, Array]:
    """Two bodies that attract each other with G m1 m2/r², bound or not.

    Arguments, returns and errors as for ``spring_motion``, with ``G`` [m³/(kg s²)], and as for
    ``kepler_orbit.motion``. Goldstein, sects. 3.1 and 3.8; Landau & Lifshitz, *Mechanics*, §§ 13, 15.
    """
    m1, m2, G = positive("m1", m1), positive("m2", m2), positive("G", G)
    r0, v0 = (finite("positions", positions, (2, 3)), finite("velocities", velocities, (2, 3)))
    t = times("t", t)
    GM = mp.mpf(G) * (mp.mpf(m1) + mp.mpf(m2))
    r, v = exact_motion(GM, _difference(r0), _difference(v0), t)
    return _of_both(m1, m2, r0, v0, r, v, t)


def _difference(pair: Array) -> Sequence[Any]:
    return [mp.mpf(float(a)) - mp.mpf(float(b)) for a, b in zip(*pair, strict=True)]


def _slack(apart: Array, parting: Array, length: float, omega: float) -> Array:
    """The separation (3,) at which the spring is slack."""
    distance = float(np.linalg.norm(apart))
    if length == 0:
        return np.zeros(3)
    if distance == 0:
        raise InputError("positions: got the same place twice, expected a direction for the spring")
    line = apart / distance
    along = float(parting @ line)
    sideways = float(np.linalg.norm(parting - along * line))
    if sideways > 8 * np.finfo(np.float64).eps * float(np.linalg.norm(parting)):
        raise InputError(f"velocities: got {sideways} m/s across the spring, expected none for length > 0")
    if np.hypot(distance - length, along / omega) >= length:
        raise InputError("positions, velocities: the bodies would meet; expected a smaller swing")
    return length * line


def _of_both(m1: float, m2: float, r0: Array, v0: Array, r: Array, v: Array, t: Array) -> tuple[Array, Array]:
    """Places and velocities of both, from those of the first relative to the second."""
    shares = np.array([[m1 / (m1 + m2)], [m2 / (m1 + m2)]])
    V = np.sum(shares * v0, axis=0)
    R = np.sum(shares * r0, axis=0) + V * t[:, None]
    parts = np.array([[m2 / (m1 + m2)], [-m1 / (m1 + m2)]])
    return R[:, None, :] + parts * r[:, None, :], V + parts * v[:, None, :]
