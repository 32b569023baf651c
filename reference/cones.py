"""The two cones of a free symmetric top: the one fixed in the body rolls on the one fixed in space.

Both touch along ω. The body cone has e3 for its axis, the space cone L (Landau & Lifshitz, *Mechanics*, § 33;
Goldstein § 5.6; Taylor § 10.8). The rates are `torque_free.body_cone_rate` and `torque_free.space_cone_rate`.
"""

import math
from typing import NamedTuple

import numpy.typing as npt

from .checked import finite, number, positive


class Cones(NamedTuple):
    """Angles [rad]: ``alpha`` between ω and e3, ``theta`` between L and e3, and the half angles of the cones.

    The half angle of a cone is at most π/2, whichever way ω points along e3. ``inside`` says that the space
    cone lies inside the body cone, as for an oblate top; for a prolate one it lies outside.
    """

    alpha: float
    theta: float
    body: float
    space: float
    inside: bool


def cones(I1: float, I3: float, omega: npt.ArrayLike) -> Cones:
    """The cones of a top with moments ``I1`` = I2 and ``I3`` [kg m²] turning with ``omega`` (3,) [rad/s].

    tan α = ω⊥/ω3, tan θ = I1ω⊥/(I3ω3). ω in body axes; with ω = 0 all angles are 0. Raises InputError for
    moments that are not positive or an ``omega`` that is not (3,).
    """
    I1, I3, omega = positive("I1", I1), positive("I3", I3), finite("omega", omega, (3,))
    across = math.hypot(omega[0], omega[1])
    alpha = math.atan2(across, omega[2])
    theta = math.atan2(I1 * across, I3 * omega[2])
    # α − θ without cancelling: across and along times the difference of the moments.
    between = math.atan2(across * omega[2] * abs(I3 - I1), I1 * across**2 + I3 * omega[2] ** 2)
    return Cones(alpha, theta, min(alpha, math.pi - alpha), abs(between), I3 > I1)


def space_cone_rate_from_angle(I1: float, I3: float, speed: float, alpha: float) -> float:
    """φ̇ = ω√(1 + ((I3/I1)² − 1) cos²α) [rad/s], the rate of the space cone by the angle of ω with e3.

    ``speed`` = |ω| [rad/s], ``alpha`` [rad]. The same as L/I1. Raises InputError for moments that are not
    positive.
    """
    I1, I3, speed, alpha = (
        positive("I1", I1),
        positive("I3", I3),
        number("speed", speed),
        number("alpha", alpha),
    )
    return speed * math.hypot(math.sin(alpha), I3 / I1 * math.cos(alpha))
