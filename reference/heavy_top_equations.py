"""Equations of motion of a heavy symmetric top, and what they keep: p_α, p_γ and E′.

β is the tilt of e3 from the vertical, α goes round the vertical, γ round e3. Source: Fetter & Walecka,
ch. 5 (these symbols); Goldstein, *Classical Mechanics*, § 5.5 (Euler's equations), § 5.7; Landau & Lifshitz,
*Mechanics*, § 35, problem 1.
"""

import numpy as np
import numpy.typing as npt

from .checked import Array, finite, number, unit_quaternions
from .errors import InputError
from .heavy_top_constants import moments_of_a_top, weight_moment
from .quaternions import conjugate, rotated


def accelerations(
    mass: float,
    length: float,
    moments: npt.ArrayLike,
    gravity: float,
    q: npt.ArrayLike,
    omega: npt.ArrayLike,
) -> Array:
    """dω/dt (..., 3) [rad/s²] in body axes at attitudes ``q`` (..., 4) and rates ``omega`` (..., 3) [rad/s].

    I ω̇ = Iω × ω + l e3 × Mg(−γ), γ the vertical in body axes: Euler's equations about the fixed point
    (Goldstein § 5.5). Arguments otherwise as in `heavy_top.motion`, and InputError as there.
    """
    I1, I3 = moments_of_a_top(moments)
    moment = float(weight_moment(mass, length, gravity))
    q, omega = unit_quaternions("q", q), finite("omega", omega)
    vertical = rotated(conjugate(q), np.array([0.0, 0.0, 1.0]))
    w1, w2, w3 = np.moveaxis(omega, -1, 0)
    rate1 = ((I1 - I3) * w2 * w3 + moment * vertical[..., 1]) / I1
    rate2 = ((I3 - I1) * w3 * w1 - moment * vertical[..., 0]) / I1
    return np.stack([rate1, rate2, np.zeros_like(rate1)], axis=-1)


def constants_of_motion(
    mass: float,
    length: float,
    moments: npt.ArrayLike,
    gravity: float,
    q: npt.ArrayLike,
    omega: npt.ArrayLike,
) -> tuple[Array, Array, Array]:
    """p_α, p_γ [kg m²/s] and E′ [J] (...) of states ``q`` (..., 4), ``omega`` (..., 3) in body axes.

    p_γ = I3ω3 is the angular momentum about e3, p_α that about the vertical, and E′ = E − p_γ²/(2I3) =
    ½I1(ω1² + ω2²) + Mgl cosβ. Fetter & Walecka ch. 5. Arguments otherwise as in `heavy_top.motion`, and
    InputError as there.
    """
    I1, I3 = moments_of_a_top(moments)
    moment = float(weight_moment(mass, length, gravity))
    q, omega = unit_quaternions("q", q), finite("omega", omega)
    vertical = rotated(conjugate(q), np.array([0.0, 0.0, 1.0]))
    L = omega * np.array([I1, I1, I3])
    kinetic = I1 * (omega[..., 0] ** 2 + omega[..., 1] ** 2) / 2
    return np.sum(L * vertical, axis=-1), L[..., 2], kinetic + moment * vertical[..., 2]


def effective_potential(
    mass: float,
    length: float,
    I1: float,
    gravity: float,
    p_alpha: float,
    p_gamma: float,
    beta: npt.ArrayLike,
) -> Array:
    """V_eff [J] (...) at the tilts ``beta`` (...) [rad]: E′ = ½I1β̇² + V_eff(β).

    V_eff = (p_α − p_γ cosβ)²/(2I1 sin²β) + Mgl cosβ, ``p_alpha`` and ``p_gamma`` in kg m²/s. Fetter &
    Walecka ch. 5; Goldstein § 5.7. Raises InputError for a β at which it is infinite.
    """
    moments_of_a_top([I1, I1])
    moment = float(weight_moment(mass, length, gravity))
    p_alpha, p_gamma, beta = number("p_alpha", p_alpha), number("p_gamma", p_gamma), finite("beta", beta)
    sine, half = np.sin(beta), np.tan(beta / 2)
    if np.any(sine == 0):
        raise InputError(f"beta: got {beta.tolist()}, expected tilts between 0 and π, where sin β is not 0")
    # (p_α − p_γ cosβ)/sinβ without a difference near the vertical: cosβ = 1 − tan(β/2) sinβ.
    round_the_vertical = (p_alpha - p_gamma) / sine + p_gamma * half
    result: Array = round_the_vertical**2 / (2 * I1) + moment * np.cos(beta)
    return result
