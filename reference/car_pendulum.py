"""A pendulum in a car that speeds up steadily: a plane pendulum about a tilted vertical.

φ is measured from the vertical towards the rear, against the car's acceleration A.
Source: Taylor, *Classical Mechanics*, § 9.1, example 9.1.
"""

import numpy as np
import numpy.typing as npt

from .checked import Array, finite, number, positive, times
from .plane_pendulum import swing
from .precise import mp


def equilibrium(gravity: float, acceleration: float) -> float:
    """φ = atan(A/g) [rad], where it hangs still in the car; A [m/s²] of either sign.

    Raises InputError unless gravity is above 0. Source: Taylor example 9.1.
    """
    return float(np.arctan2(number("acceleration", acceleration), positive("gravity", gravity)))


def frequency(gravity: float, acceleration: float, length: float) -> float:
    """ω = √(√(g² + A²)/L) [rad/s] of small swings about `equilibrium`.

    Raises InputError unless gravity and length are above 0. Source: Taylor example 9.1.
    """
    strength = np.hypot(positive("gravity", gravity), number("acceleration", acceleration))
    return float(np.sqrt(strength / positive("length", length)))


def motion(
    gravity: float, acceleration: float, length: float, phi0: float, rate0: float, t: npt.ArrayLike
) -> tuple[Array, Array]:
    """φ and φ̇ (n,) [rad, rad/s] at the times t (n,) [s], at any amplitude; φ counts turns.

    φ̈ = (A cos φ − g sin φ)/L is θ̈ = −(√(g² + A²)/L) sin θ with θ = φ − atan(A/g).
    Raises InputError as `plane_pendulum.motion`. Source: Taylor § 9.1; Whittaker, *Analytical
    Dynamics*, § 44.
    """
    g, A = mp.mpf(positive("gravity", gravity)), mp.mpf(number("acceleration", acceleration))
    tilt = mp.atan2(A, g)
    square = mp.hypot(g, A) / mp.mpf(positive("length", length))
    theta0 = mp.mpf(number("phi0", phi0)) - tilt
    theta, rate = swing(square, theta0, mp.mpf(number("rate0", rate0)), times("t", t))
    return theta + float(tilt), rate


def angular_acceleration(gravity: float, acceleration: float, length: float, phi: npt.ArrayLike) -> Array:
    """φ̈ = (A cos φ − g sin φ)/L [rad/s²] at angles of any shape [rad]. Raises and source as `motion`."""
    g, A, angle = positive("gravity", gravity), number("acceleration", acceleration), finite("phi", phi)
    return (A * np.cos(angle) - g * np.sin(angle)) / positive("length", length)
