"""Tides: what a distant mass does differently here than at the centre of what falls towards it."""

import numpy as np
import numpy.typing as npt

from .checked import Array, finite, positive
from .errors import InputError


def tidal_acceleration(GM: float, centre: npt.ArrayLike, r: npt.ArrayLike) -> Array:
    """Acceleration relative to the centre of a freely falling body, by the mass that it falls towards.

    Parameters
    ----------
    GM : gravitational constant times the distant mass [m³/s²]
    centre : (3,) d0, the body's centre, from the distant mass [m]
    r : (..., 3) points, from the body's centre [m]

    Returns
    -------
    (..., 3) : −GM (d̂/d² − d̂0/d0²), d = d0 + r [m/s²]

    Raises
    ------
    InputError
        If a point or the centre is at the distant mass, or a number is not finite.

    Notes
    -----
    Taylor, sect. 9.2. The difference is taken before it is rounded, with q = (d² − d0²)/d0² as in Encke's
    method (Danby, *Fundamentals of Celestial Mechanics*): 16 digits however near the point.
    """
    GM, d0, r = positive("GM", GM), finite("centre", centre, (3,)), finite("r", r)
    d = d0 + r
    distance = np.linalg.norm(d, axis=-1, keepdims=True)
    far = float(np.linalg.norm(d0))
    if far == 0 or np.any(distance == 0):
        raise InputError("centre, r: got a point at the distant mass, expected some distance")
    q = np.sum(r * (2 * d0 + r), axis=-1, keepdims=True) / far**2
    stretch = q * (3 + q * (3 + q)) / (1 + (distance / far) ** 3)  # (d/d0)³ − 1
    result: Array = -GM * (r - d0 * stretch) / distance**3
    return result


def tidal_tensor(GM: float, centre: npt.ArrayLike) -> Array:
    """First order in the distance: the tidal acceleration is this tensor (3, 3) times r [1/s²].

    GM/d0³ (3 d̂0 d̂0ᵀ − 1): twice as much stretching along d0 as squeezing across it.
    Arguments and errors as for ``tidal_acceleration``; Taylor, sect. 9.2.
    """
    GM, d0 = positive("GM", GM), finite("centre", centre, (3,))
    far = float(np.linalg.norm(d0))
    if far == 0:
        raise InputError("centre: got (0, 0, 0), expected some distance")
    n = d0 / far
    return np.asarray(GM / far**3 * (3 * np.outer(n, n) - np.eye(3)))


def tide_at_named_points(GM: float, distance: float, radius: float) -> tuple[float, float, float]:
    """Tidal acceleration at the near, far and side points of a round body [m/s²].

    Parameters
    ----------
    GM : [m³/s²]
    distance : between the centres [m]
    radius : of the body, below the distance [m]

    Returns
    -------
    near, far : outward, away from the body's own centre
    side : inward, towards its own centre, at a point at right angles to the distant mass

    Raises
    ------
    InputError
        For values out of range.

    Notes
    -----
    The points P, R and Q of Taylor, sect. 9.2: GM r(2d − r)/(d²(d − r)²), GM r(2d + r)/(d²(d + r)²) and
    GM r/(d² + r²)^(3/2). At the side point there is also a part away from the distant mass, a
    factor 3r/2d smaller.
    """
    GM, d, r = positive("GM", GM), positive("distance", distance), positive("radius", radius)
    if r >= d:
        raise InputError(f"radius: got {r}, expected below the distance {d}")
    near = GM * r * (2 * d - r) / (d * (d - r)) ** 2
    far = GM * r * (2 * d + r) / (d * (d + r)) ** 2
    return near, far, GM * r / float(np.hypot(d, r)) ** 3


def tide_height(mass_ratio: float, distance: float, radius: float) -> float:
    """Height between high and low water of an ocean that covers the body and follows the tide [m].

    3M R⁴/(2 m d³) with ``mass_ratio`` M/m of the distant mass to the body. Taylor, sect. 9.2: 54 cm by
    the moon and 25 cm by the sun.
    """
    ratio, d, R = (
        positive("mass_ratio", mass_ratio),
        positive("distance", distance),
        positive("radius", radius),
    )
    return 1.5 * ratio * (R / d) ** 3 * R
