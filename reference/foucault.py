"""Foucault's pendulum: small swings on a turning planet, and how their plane turns."""

import numpy as np
import numpy.typing as npt

from .checked import Array, finite, number, positive, times, within
from .double_double import turning
from .precise import mp


def precession_rate(Omega: float, latitude: float) -> float:
    """−Ω sinλ [rad/s], about the upward vertical, of the plane of swing: with the sun north of the equator.

    ``Omega`` is the planet's angular velocity [rad/s], ``latitude`` λ −π/2 to π/2, north positive [rad].
    Taylor, sect. 9.9; Goldstein, sect. 4.10; Landau & Lifshitz, *Mechanics*, § 39, problem 3.
    """
    return float(-number("Omega", Omega) * np.sin(within("latitude", latitude, -np.pi / 2, np.pi / 2)))


def motion(
    length: float,
    gravity: float,
    Omega: float,
    latitude: float,
    r0: npt.ArrayLike,
    v0: npt.ArrayLike,
    t: npt.ArrayLike,
) -> tuple[Array, Array]:
    """Small swings on a planet, Coriolis force included in full.

    Parameters
    ----------
    length : L [m]
    gravity : g, what a plumb line shows, centrifugal part included [m/s²]
    Omega, latitude : as for ``precession_rate``
    r0, v0 : (2,) place [m] and velocity [m/s] of the bob at t = 0, axes east and north
    t : (n,) times [s], of either sign

    Returns
    -------
    r, v : (n, 2) [m], [m/s]

    Raises
    ------
    InputError
        For values out of range, shapes that do not fit, or times past 10¹⁵ swings.

    Notes
    -----
    With η = x + iy (x east, y north) and Ωz = Ω sinλ, η̈ + 2iΩz η̇ + (g/L)η = 0, solved by
    η = e^(−iΩz t) (η0 cos ω1t + (η̇0 + iΩzη0) sin ω1t/ω1), ω1² = g/L + Ωz². Taylor, sect. 9.9. The change of
    the centrifugal force with the swing, of order Ω²r, is left out, as it is there.
    """
    L, g = positive("length", length), positive("gravity", gravity)
    Omega_z = -precession_rate(Omega, latitude)
    omega1 = mp.sqrt(mp.mpf(g) / mp.mpf(L) + mp.mpf(Omega_z) ** 2)
    return _swings(omega1, Omega_z, r0, v0, t)


def motion_on_a_turntable(
    length: float, gravity: float, Omega: float, r0: npt.ArrayLike, v0: npt.ArrayLike, t: npt.ArrayLike
) -> tuple[Array, Array]:
    """Small swings of a pendulum hung over the axis of a turntable (or at a pole), seen on the table.

    Nothing is left out: in the room it swings at √(g/L) in an ellipse that stays, and the table turns by
    Ωt below it. Axes x and y turn with the table, counterclockwise for ``Omega`` > 0 seen from above.
    Arguments, returns and errors otherwise as for ``motion``. Taylor, sect. 9.9.
    """
    L, g, Omega = positive("length", length), positive("gravity", gravity), number("Omega", Omega)
    return _swings(mp.sqrt(mp.mpf(g) / mp.mpf(L)), Omega, r0, v0, t)


def _swings(
    omega: object, Omega_z: float, r0: npt.ArrayLike, v0: npt.ArrayLike, t: npt.ArrayLike
) -> tuple[Array, Array]:
    """An ellipse gone round at ``omega`` (an mpmath number), seen from axes that turn at ``Omega_z``."""
    t = times("t", t)
    x0, y0 = finite("r0", r0, (2,))
    vx0, vy0 = finite("v0", v0, (2,))
    eta0, rate0 = complex(x0, y0), complex(vx0, vy0)
    unturned = rate0 + 1j * Omega_z * eta0
    w = float(mp.mpf(omega))
    cosine, sine = turning(omega, mp.mpf(0), t)
    turn_cosine, turn_sine = turning(mp.mpf(Omega_z), mp.mpf(0), t)
    turn = turn_cosine - 1j * turn_sine
    eta = turn * (eta0 * cosine + unturned / w * sine)
    rate = turn * (unturned * cosine - eta0 * w * sine) - 1j * Omega_z * eta
    return np.column_stack([eta.real, eta.imag]), np.column_stack([rate.real, rate.imag])
