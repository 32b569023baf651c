"""A rigid body on a horizontal hinge: its swing, its reversible points, and what its hinge feels.

``arm`` is the distance from the hinge to the centre of mass, ``inertia`` the moment about the hinge; the
angle θ is from the hanging position. With I/(ml) for the length it swings as a plane pendulum does.

Source: Goldstein, *Classical Mechanics*, ch. 5; Fowles & Cassiday, *Analytical Mechanics*, §§ 8.4, 8.7
(the physical pendulum, impulse and the centre of percussion).
"""

from typing import Any

import numpy as np
import numpy.typing as npt

from .checked import Array, finite, number, positive, times
from .errors import InputError
from .plane_pendulum import swing, swing_period
from .precise import mp


def motion(
    mass: float,
    arm: float,
    inertia: float,
    gravity: float,
    theta0: float,
    rate0: float,
    t: npt.ArrayLike,
) -> tuple[Array, Array]:
    """θ and θ̇ (n,) [rad, rad/s] at the times t (n,) [s], at any amplitude, θ̈ = −(mgl/I) sin θ.

    mass [kg], arm [m], inertia [kg m²], gravity [m/s²], theta0 [rad], rate0 [rad/s]; θ counts turns.
    Raises InputError as `plane_pendulum.motion`, and for an inertia below m·arm², which no body has.
    Source: Fowles & Cassiday § 8.4; Whittaker, *Analytical Dynamics*, § 44.
    """
    square = _square(mass, arm, inertia, gravity)
    return swing(square, mp.mpf(number("theta0", theta0)), mp.mpf(number("rate0", rate0)), times("t", t))


def acceleration(mass: float, arm: float, inertia: float, gravity: float, theta: npt.ArrayLike) -> Array:
    """θ̈ = −(mgl/I) sin θ [rad/s²] at angles of any shape [rad]. Raises as `motion`. Source: `motion`."""
    return -float(_square(mass, arm, inertia, gravity)) * np.sin(finite("theta", theta))


def period(mass: float, arm: float, inertia: float, gravity: float, amplitude: float) -> float:
    """Time of a full swing [s] of an amplitude [rad] below π; 2π√(I/(mgl)) for a small one.

    Raises InputError as `motion`, or for another amplitude. Source: `plane_pendulum.period`.
    """
    return swing_period(_square(mass, arm, inertia, gravity), amplitude)


def equivalent_length(mass: float, arm: float, inertia: float) -> float:
    """I/(ml) [m], from the hinge: where a point mass would swing alike, and where a blow spares the hinge.

    Centre of oscillation and centre of percussion are one point; hung there, the body has the same
    period (Huygens). Raises InputError as `motion`. Source: Fowles & Cassiday §§ 8.4, 8.7.
    """
    mass, arm, inertia = _body(mass, arm, inertia)
    return inertia / (mass * arm)


def beyond_centre(mass: float, arm: float, inertia: float) -> float:
    """k²/l = I/(ml) − l [m]: the same point, from the centre of mass; k² = (I − ml²)/m.

    The arm of the reversed pendulum. Raises InputError as `motion`. Source: Fowles & Cassiday § 8.4.
    """
    mass, arm, inertia = _body(mass, arm, inertia)
    return max(inertia / (mass * arm) - arm, 0.0)


def pivot_reaction(
    mass: float,
    arm: float,
    inertia: float,
    gravity: float,
    theta: npt.ArrayLike,
    rate: npt.ArrayLike,
) -> Array:
    """Force (..., 2) = (F_x, F_z) [N] of the hinge on the free body, z up, θ > 0 towards +x.

    θ and θ̇ (...) [rad, rad/s]. It is m(a − g), with the centre's acceleration from θ̇² and θ̈: along the
    arm ml θ̇² + mg cos θ, across it mg sin θ (1 − ml²/I).
    Raises InputError as `motion`. Source: Newton's second law for the centre of mass.
    """
    angle, speed = finite("theta", theta), finite("rate", rate)
    (mass, arm, inertia), gravity = _body(mass, arm, inertia), positive("gravity", gravity)
    inward = mass * (arm * speed**2 + gravity * np.cos(angle))
    across = mass * gravity * np.sin(angle) * (1 - mass * arm**2 / inertia)
    e_in = np.stack([-np.sin(angle), np.cos(angle)], axis=-1)
    e_on = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    return np.asarray(inward[..., None] * e_in + across[..., None] * e_on)


def struck(mass: float, arm: float, inertia: float, distance: float, impulse: float) -> tuple[float, float]:
    """Rate [rad/s] after a blow J [N s] at ``distance`` [m] below the hinge, and the hinge's own impulse.

    θ̇ = Jb/I and J_hinge = J(mlb/I − 1) [N s], along J if positive; none at `equivalent_length`. Body
    hanging at rest, blow horizontal. Raises InputError as `motion`. Source: Fowles & Cassiday § 8.7.
    """
    mass, arm, inertia = _body(mass, arm, inertia)
    blow, b = number("impulse", impulse), number("distance", distance)
    return blow * b / inertia, blow * (mass * arm * b / inertia - 1)


def _body(mass: float, arm: float, inertia: float) -> tuple[float, float, float]:
    mass, arm, inertia = positive("mass", mass), positive("arm", arm), positive("inertia", inertia)
    # A point mass has I = ml² exactly, and its product is rounded.
    if inertia < mass * arm**2 * (1 - 4 * np.finfo(np.float64).eps):
        raise InputError(
            f"inertia: got {inertia} about the hinge, expected at least mass·arm² = {mass * arm**2}"
        )
    return mass, arm, inertia


def _square(mass: float, arm: float, inertia: float, gravity: float) -> Any:
    mass, arm, inertia = _body(mass, arm, inertia)
    return mp.mpf(mass) * mp.mpf(arm) * mp.mpf(positive("gravity", gravity)) / mp.mpf(inertia)
