"""A ball that rolls on a turning table: its path in the room is a circle, 2Ω/7 for a solid one."""

import numpy as np
import numpy.typing as npt

from .checked import Array, finite, number, positive, times
from .gyration import gyration


def circling_rate(Omega: float, gyration_ratio: float = 0.4) -> float:
    """Rate Ω κ/(1 + κ) [rad/s] at which the velocity of a rolling ball turns, the table turning at Ω.

    ``gyration_ratio`` κ = I/(ma²) is 2/5 for a solid sphere (rate 2Ω/7), 2/3 for a thin hollow one (2Ω/5).
    From m v̇ = F, I ω̇ = −a ẑ×F and v + ω×(−aẑ) = Ω ẑ×r: (1 + 1/κ) v̇ = Ω ẑ×v.
    Weltner, *Am. J. Phys.* 47 (1979) 984.
    """
    kappa = positive("gyration_ratio", gyration_ratio)
    return number("Omega", Omega) * kappa / (1 + kappa)


def ball_on_a_turntable(
    radius: float,
    Omega: float,
    r0: npt.ArrayLike,
    v0: npt.ArrayLike,
    t: npt.ArrayLike,
    spin: float = 0.0,
    gyration_ratio: float = 0.4,
    pull: npt.ArrayLike = (0.0, 0.0),
) -> tuple[Array, Array, Array]:
    """Motion in the room of a ball that rolls without slipping on a table that turns about the z axis.

    Parameters
    ----------
    radius : a, of the ball [m]
    Omega : angular velocity of the table [rad/s]
    r0, v0 : (2,) centre, from the table's axis [m], and its velocity [m/s] at t = 0, in the room
    t : (n,) times [s], of either sign
    spin : ω_z of the ball, which stays as it is [rad/s]
    gyration_ratio : I/(ma²) [1]
    pull : (2,) part of gravity in the table's plane, if it is not level [m/s²]

    Returns
    -------
    r, v : (n, 2) of the centre [m], [m/s]
    omega_world : (n, 3) of the ball, world axes [rad/s]

    Raises
    ------
    InputError
        For values out of range, shapes that do not fit, or times past 10¹⁵ turns.

    Notes
    -----
    v̇ = W ẑ×v + pull/(1 + κ), W from ``circling_rate``; ω = (ẑ×v + Ωr)/a across z, from the contact that
    does not slip. On a tilted table the ball does not roll down: its circle drifts across the slope.
    """
    a, Omega = positive("radius", radius), number("Omega", Omega)
    r0, v0, pull = (finite(n, x, (2,)) for n, x in (("r0", r0), ("v0", v0), ("pull", pull)))
    omega_z, rate = number("spin", spin), circling_rate(Omega, gyration_ratio)
    turning = np.array([0.0, 0.0, rate])
    force = np.append(pull / (1 + gyration_ratio), 0.0)
    r, v = gyration(turning, force, np.append(r0, 0.0), np.append(v0, 0.0), times("t", t))
    omega = (np.cross([0.0, 0.0, 1.0], v) + Omega * r) / a
    omega[:, 2] = omega_z
    return r[:, :2], v[:, :2], omega
