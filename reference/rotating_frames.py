"""What a turning frame adds to the laws of motion: apparent accelerations, a puck on a turntable, a fall.

Ω is the angular velocity of the frame relative to the room, r and v are as measured in the frame.
"""

import numpy as np
import numpy.typing as npt

from .checked import Array, finite, not_negative, number, times, within
from .double_double import turning
from .gyration import gyration
from .precise import mp


def apparent_accelerations(
    Omega: npt.ArrayLike, Omega_rate: npt.ArrayLike, r: npt.ArrayLike, v: npt.ArrayLike
) -> tuple[Array, Array, Array]:
    """Coriolis, centrifugal and Euler accelerations seen in a turning frame.

    Parameters
    ----------
    Omega, Omega_rate : (..., 3) angular velocity of the frame [rad/s] and its rate [rad/s²]
    r, v : (..., 3) place [m] and velocity [m/s] in the frame, its own axes

    Returns
    -------
    coriolis 2v×Ω, centrifugal (Ω×r)×Ω, euler r×Ω̇ : (..., 3) [m/s²]

    Raises
    ------
    InputError
        For numbers that are not finite.

    Notes
    -----
    Taylor, sects. 9.5–9.7; with the rate of Ω, Landau & Lifshitz, *Mechanics*, § 39.
    """
    Omega, Omega_rate = finite("Omega", Omega), finite("Omega_rate", Omega_rate)
    r, v = finite("r", r), finite("v", v)
    return 2 * np.cross(v, Omega), np.cross(np.cross(Omega, r), Omega), np.cross(r, Omega_rate)


def straight_line_seen_turning(
    Omega: npt.ArrayLike, r0: npt.ArrayLike, v0: npt.ArrayLike, t: npt.ArrayLike
) -> tuple[Array, Array]:
    """A free particle (a puck without friction) seen from a frame that turns steadily with Ω.

    Parameters
    ----------
    Omega : (3,) angular velocity of the frame [rad/s]; a turntable's is (0, 0, Ω)
    r0, v0 : (3,) place [m] and velocity [m/s] in the frame at t = 0, when its axes are those of the room
    t : (n,) times [s], of either sign

    Returns
    -------
    r, v : (n, 3) in the frame: r = R(−Ωt) (r0 + (v0 + Ω×r0) t), v its rate [m], [m/s]

    Raises
    ------
    InputError
        For shapes that do not fit, numbers that are not finite, or times past 10¹⁵ turns.

    Notes
    -----
    Taylor, sect. 9.7 and problem 9.20 (the puck on a turntable); in the room the path is straight.
    """
    Omega, t = finite("Omega", Omega, (3,)), times("t", t)
    r0, v0 = finite("r0", r0, (3,)), finite("v0", v0, (3,))
    in_room = v0 + np.cross(Omega, r0)
    r = turned_back(Omega, r0 + in_room * t[:, None], t)
    return r, turned_back(Omega, np.broadcast_to(in_room, r.shape), t) - np.cross(Omega, r)


def turned_back(Omega: Array, vectors: Array, t: Array) -> Array:
    """``vectors`` (n, 3) of the room, in axes that turn with ``Omega`` (3,), at ``t`` (n,)."""
    rate = mp.sqrt(sum(mp.mpf(float(component)) ** 2 for component in Omega))
    cosine, sine = (array[:, None] for array in turning(rate, mp.mpf(0), t))
    axis = np.array([float(mp.mpf(float(component)) / rate) if rate else 0.0 for component in Omega])
    along = np.outer(vectors @ axis, axis)
    result: Array = along + cosine * (vectors - along) - sine * np.cross(axis, vectors)
    return result


def local_rotation(Omega: float, colatitude: float) -> Array:
    """Angular velocity (3,) of a planet that turns at ``Omega`` [rad/s], in axes east, north, up.

    ``colatitude`` [rad], 0 at the north pole to π, is the angle from the axis. Taylor, sect. 9.8.
    """
    Omega, theta = number("Omega", Omega), within("colatitude", colatitude, 0.0, np.pi)
    return np.array([0.0, Omega * np.sin(theta), Omega * np.cos(theta)])


def coriolis_fall(
    Omega: float,
    colatitude: float,
    gravity: float,
    r0: npt.ArrayLike,
    v0: npt.ArrayLike,
    t: npt.ArrayLike,
) -> tuple[Array, Array]:
    """Free flight over a turning planet, Coriolis acceleration included in full: r̈ = g + 2ṙ×Ω.

    Parameters
    ----------
    Omega : angular velocity of the planet [rad/s]
    colatitude : angle from its north pole [rad]
    gravity : g, what a plumb line and a spring show, centrifugal part included [m/s²]
    r0, v0 : (3,) place [m] and velocity [m/s] at t = 0, axes east, north, up
    t : (n,) times [s], of either sign

    Returns
    -------
    r, v : (n, 3) [m], [m/s]

    Raises
    ------
    InputError
        For numbers that are not finite, shapes that do not fit, a colatitude outside 0 … π, a negative g.

    Notes
    -----
    Taylor, sect. 9.8, solved exactly instead of order by order (see ``gyration``).
    """
    down = np.array([0.0, 0.0, -not_negative("gravity", gravity)])
    return gyration(-2 * local_rotation(Omega, colatitude), down, r0, v0, t)


def eastward_deflection(Omega: float, colatitude: float, gravity: float, t: npt.ArrayLike) -> Array:
    """How far east a stone dropped from rest lands, to first order in Ω: Ωg t³ sin θ/3 (n,) [m].

    Arguments as for ``coriolis_fall``. Taylor, sect. 9.8: 2.2 cm from 100 m at the equator.
    """
    g, eastward = not_negative("gravity", gravity), local_rotation(Omega, colatitude)[1]
    result: Array = eastward * g * times("t", t) ** 3 / 3
    return result
