"""The wobble of the Earth's pole: free precession of a slightly oblate body, for many turns.

Ellipticity ε = (I3 − I1)/I1, about 1/305 for the Earth as far as it is rigid. ω goes round the axis of
figure at ε ω3, seen from the Earth: once in 305 days. The Earth yields, and Chandler found 433 days.
"""

import numpy as np
import numpy.typing as npt

from . import torque_free
from .checked import Array, number, positive, times, within
from .errors import InputError


def wobble_rate(ellipticity: float, omega3: float) -> float:
    """ε ω3 [rad/s], at which ω goes round the axis of figure in the body, the way the body turns for ε > 0.

    ``ellipticity`` ε is above −1/2 and at most 1: between a needle and a plate. ``omega3`` [rad/s] is the
    spin along the axis. Taylor, sect. 10.8; Goldstein, sect. 5.6; Landau & Lifshitz, *Mechanics*, § 33.
    """
    return _ellipticity(ellipticity) * number("omega3", omega3)


def wobble_period(ellipticity: float, omega3: float) -> float:
    """2π/|ε ω3| [s]: 305 turns for ε = 1/305; raises InputError where nothing wobbles."""
    rate = wobble_rate(ellipticity, omega3)
    if rate == 0:
        raise InputError(f"ellipticity, omega3: got {ellipticity} and {omega3}, expected both other than 0")
    return 2 * np.pi / abs(rate)


def space_cone_angle(ellipticity: float, alpha: float) -> float:
    """Angle [rad] between ω and L, when ω is at ``alpha`` [rad], 0 to π/2, from the axis of figure.

    Here α − θ, tanθ = tanα/(1 + ε): some ε α, on Earth 305 times less than α, so that in space the axis
    of rotation hardly moves. Negative for ε < 0. Landau & Lifshitz, *Mechanics*, § 33.
    """
    eps, alpha = _ellipticity(ellipticity), within("alpha", alpha, 0.0, np.pi / 2)
    s, c = np.sin(alpha), np.cos(alpha)
    return float(np.arctan2(eps * s * c, s * s + (1 + eps) * c * c))


def pole_path(
    ellipticity: float, omega3: float, amplitude: float, t: npt.ArrayLike, phase: float = 0.0
) -> Array:
    """Where the pole of rotation is on the body.

    Parameters
    ----------
    ellipticity, omega3 : as for ``wobble_rate``
    amplitude : angle of ω from the axis of figure, 0 to below π/2 [rad]
    t : (n,) times [s], of either sign
    phase : direction of the pole from the first axis at t = 0 [rad]

    Returns
    -------
    (n, 2) : ω1/ω3 and ω2/ω3

    Raises
    ------
    InputError
        For values out of range, or a body that does not spin.
    """
    _, omega = motion(ellipticity, omega3, amplitude, t, phase)
    return omega[:, :2] / omega[:, 2:]


def motion(
    ellipticity: float, omega3: float, amplitude: float, t: npt.ArrayLike, phase: float = 0.0
) -> tuple[Array, Array]:
    """Attitude q (n, 4), at first that of the world, and ω (n, 3) in body axes [rad/s].

    Arguments and errors as for ``pole_path``. ``torque_free.motion`` for the moments (1, 1, 1 + ε).
    """
    eps, alpha = _ellipticity(ellipticity), number("amplitude", amplitude)
    omega3, phase = number("omega3", omega3), number("phase", phase)
    if not 0 <= alpha < np.pi / 2 or omega3 == 0:
        raise InputError(
            f"amplitude, omega3: got {alpha} and {omega3}, expected an angle from 0 to below π/2, and a spin"
        )
    across = omega3 * np.tan(alpha)
    omega0 = [across * np.cos(phase), across * np.sin(phase), omega3]
    return torque_free.motion([1.0, 1.0, 1.0 + eps], [0, 0, 0, 1], omega0, times("t", t))


def _ellipticity(ellipticity: float) -> float:
    eps = positive("1 + ellipticity", 1 + number("ellipticity", ellipticity)) - 1
    if eps > 1:
        raise InputError(f"ellipticity: got {eps}, expected at most 1, that of a plate")
    return number("ellipticity", ellipticity)
