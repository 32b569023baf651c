"""A compound pendulum struck: a horizontal force on it for a while, and what its hinge bears of that.

Symbols as in `compound_pendulum`; the force acts in the plane of the swing, at ``distance`` b from the hinge
on the line through the centre of mass. While it acts, Iθ̈ = −mgl sin θ + Fb cos θ =
−√((mgl)² + (Fb)²) sin(θ − δ) with tan δ = Fb/(mgl): the body swings as in a gravity that is stronger, and
tilted by δ.

Source: Fowles & Cassiday, *Analytical Mechanics*, § 8.7 (impulse and the centre of percussion); § 8.4 for the
swing.
"""

from math import atan2, hypot

import numpy as np
import numpy.typing as npt

from .checked import Array, finite, number, times
from .compound_pendulum import motion
from .errors import InputError


def swing(
    mass: float,
    arm: float,
    inertia: float,
    gravity: float,
    distance: float,
    force: float,
    start: float,
    end: float,
    theta0: float,
    rate0: float,
    t: npt.ArrayLike,
) -> tuple[Array, Array]:
    """θ and θ̇ (n,) [rad, rad/s] at times t (n,) [s], with the ``force`` [N] at work from start to end [s].

    distance [m]; the force is along +x, where θ > 0 leads. Raises InputError as `compound_pendulum.motion`,
    and for an end before the start. Source: the equation of motion above, joined.
    """
    if not 0 <= number("start", start) <= number("end", end):
        raise InputError(f"start, end: got {start} and {end} s, expected a start from 0 on, no end before it")
    t, torque, weight = times("t", t), number("force", force) * number("distance", distance), mass * arm
    angle, rate = np.empty((2, len(t)))
    for begin, stop, pull in ((0.0, start, 0.0), (start, end, torque), (end, np.inf, 0.0)):
        tilt, stronger = atan2(pull, weight * gravity), hypot(pull / weight, gravity)
        during = (t >= begin) & (t < stop)
        asked = np.append(t[during], min(stop, t.max(initial=begin) + 1)) - begin
        theta, theta_dot = motion(mass, arm, inertia, stronger, theta0 - tilt, rate0, asked)
        angle[during], rate[during] = theta[:-1] + tilt, theta_dot[:-1]
        theta0, rate0 = float(theta[-1]) + tilt, float(theta_dot[-1])
    return angle, rate


def acceleration(
    mass: float,
    arm: float,
    inertia: float,
    gravity: float,
    distance: float,
    force: npt.ArrayLike,
    theta: npt.ArrayLike,
) -> Array:
    """θ̈ = (Fb cos θ − mgl sin θ)/I [rad/s²]; force and θ of one shape. Source: torques about the hinge."""
    angle, push = finite("theta", theta), finite("force", force)
    return np.asarray((push * distance * np.cos(angle) - mass * gravity * arm * np.sin(angle)) / inertia)


def borne_of_blow(
    mass: float, arm: float, inertia: float, distance: float, force: npt.ArrayLike, theta: npt.ArrayLike
) -> Array:
    """What the hinge bears across the arm of the force: F cos θ (mlb/I − 1) [N], along the body's way if > 0.

    Beside mg sin θ (1 − ml²/I), the weight's. None where b = I/(ml), at any angle: the centre of percussion.
    Source: Newton's second law for the centre of mass, with `acceleration`.
    """
    angle, push = finite("theta", theta), finite("force", force)
    return np.asarray(push * np.cos(angle) * (mass * arm * distance / inertia - 1))
