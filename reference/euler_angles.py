"""Euler's angles in the two orders that books use, their rates, and the angular velocity they make.

z-y-z is (α, β, γ), z-x-z is (φ, θ, ψ): turn about the world's z axis by the first angle, then about the
turned y or x axis by the second, then about the body's own z axis by the third. All functions take
angles (..., 3) [rad] and rates or ω (..., 3) [rad/s] that broadcast, and return (..., 3).

Everything raises InputError if an array does not end in three finite numbers; `*_rates*` also where the
middle angle has no sine, for there one ω belongs to many rates.

Source: Goldstein, *Classical Mechanics*, § 4.4 (z-x-z), § 4.9 eq. (4.87), appendix A (z-y-z);
Landau & Lifshitz, *Mechanics*, § 35; Fetter & Walecka, *Theoretical Mechanics of Particles and
Continua*, ch. 5 (z-y-z).
"""

import numpy as np
import numpy.typing as npt

from .checked import Array, finite, unit_quaternions
from .errors import InputError


def zyz_omega(angles: npt.ArrayLike, rates: npt.ArrayLike) -> Array:
    """ω in body axes from (α, β, γ) and their rates: α̇ e3⁰ + β̇ e2′ + γ̇ e3. Source: Goldstein app. A."""
    (_, b, c), (da, db, dc) = _parts("angles", angles), _parts("rates", rates)
    return _stack(
        -da * np.sin(b) * np.cos(c) + db * np.sin(c),
        da * np.sin(b) * np.sin(c) + db * np.cos(c),
        da * np.cos(b) + dc,
    )


def zyz_omega_world(angles: npt.ArrayLike, rates: npt.ArrayLike) -> Array:
    """ω in world axes from (α, β, γ) and their rates. Source: Goldstein app. A."""
    (a, b, _), (da, db, dc) = _parts("angles", angles), _parts("rates", rates)
    return _stack(
        -db * np.sin(a) + dc * np.sin(b) * np.cos(a),
        db * np.cos(a) + dc * np.sin(b) * np.sin(a),
        da + dc * np.cos(b),
    )


def zyz_rates(angles: npt.ArrayLike, omega: npt.ArrayLike) -> Array:
    """(α̇, β̇, γ̇) from ω in body axes: `zyz_omega` solved for the rates. Raises where sin β = 0."""
    (_, b, c), (w1, w2, w3) = _parts("angles", angles), _parts("omega", omega)
    da = (-w1 * np.cos(c) + w2 * np.sin(c)) / _sine(b)
    return _stack(da, w1 * np.sin(c) + w2 * np.cos(c), w3 - da * np.cos(b))


def zyz_rates_from_world(angles: npt.ArrayLike, omega_world: npt.ArrayLike) -> Array:
    """(α̇, β̇, γ̇) from ω in world axes: `zyz_omega_world` solved. Raises where sin β = 0."""
    (a, b, _), (wx, wy, wz) = _parts("angles", angles), _parts("omega_world", omega_world)
    dc = (wx * np.cos(a) + wy * np.sin(a)) / _sine(b)
    return _stack(wz - dc * np.cos(b), -wx * np.sin(a) + wy * np.cos(a), dc)


def zxz_omega(angles: npt.ArrayLike, rates: npt.ArrayLike) -> Array:
    """ω in body axes from (φ, θ, ψ) and their rates. Source: Goldstein eq. (4.87); L&L § 35."""
    (_, th, psi), (dphi, dth, dpsi) = _parts("angles", angles), _parts("rates", rates)
    return _stack(
        dth * np.cos(psi) + dphi * np.sin(th) * np.sin(psi),
        -dth * np.sin(psi) + dphi * np.sin(th) * np.cos(psi),
        dpsi + dphi * np.cos(th),
    )


def zxz_omega_world(angles: npt.ArrayLike, rates: npt.ArrayLike) -> Array:
    """ω in world axes from (φ, θ, ψ) and their rates. Source: Goldstein § 4.9 and its exercise.

    The angle inside is φ; notes that print ψ there have copied the body's.
    """
    (phi, th, _), (dphi, dth, dpsi) = _parts("angles", angles), _parts("rates", rates)
    return _stack(
        dth * np.cos(phi) + dpsi * np.sin(th) * np.sin(phi),
        dth * np.sin(phi) - dpsi * np.sin(th) * np.cos(phi),
        dphi + dpsi * np.cos(th),
    )


def zxz_rates(angles: npt.ArrayLike, omega: npt.ArrayLike) -> Array:
    """(φ̇, θ̇, ψ̇) from ω in body axes: `zxz_omega` solved for the rates. Raises where sin θ = 0."""
    (_, th, psi), (w1, w2, w3) = _parts("angles", angles), _parts("omega", omega)
    dphi = (w1 * np.sin(psi) + w2 * np.cos(psi)) / _sine(th)
    return _stack(dphi, w1 * np.cos(psi) - w2 * np.sin(psi), w3 - dphi * np.cos(th))


def zxz_rates_from_world(angles: npt.ArrayLike, omega_world: npt.ArrayLike) -> Array:
    """(φ̇, θ̇, ψ̇) from ω in world axes: `zxz_omega_world` solved. Raises where sin θ = 0."""
    (phi, th, _), (wx, wy, wz) = _parts("angles", angles), _parts("omega_world", omega_world)
    dpsi = (wx * np.sin(phi) - wy * np.cos(phi)) / _sine(th)
    return _stack(wz - dpsi * np.cos(th), wx * np.cos(phi) + wy * np.sin(phi), dpsi)


def zyz_attitude(angles: npt.ArrayLike) -> Array:
    """Attitude (..., 4), scalar last, body to world, of (α, β, γ).

    Its Cayley–Klein parameters hold only (α ± γ)/2: nothing is lost at β = 0. Source: Goldstein § 4.5.
    """
    a, b, c = _parts("angles", angles)
    fold, rest, half, twist = np.sin(b / 2), np.cos(b / 2), (a + c) / 2, (c - a) / 2
    return _stack(fold * np.sin(twist), fold * np.cos(twist), rest * np.sin(half), rest * np.cos(half))


def zxz_attitude(angles: npt.ArrayLike) -> Array:
    """Attitude (..., 4), scalar last, body to world, of (φ, θ, ψ). Source: Goldstein § 4.5."""
    phi, th, psi = _parts("angles", angles)
    fold, rest, half, twist = np.sin(th / 2), np.cos(th / 2), (phi + psi) / 2, (phi - psi) / 2
    return _stack(fold * np.cos(twist), fold * np.sin(twist), rest * np.sin(half), rest * np.cos(half))


def zyz_angles(q: npt.ArrayLike) -> Array:
    """(α, β, γ) of attitudes q (..., 4): α, γ in (−π, π], β in [0, π].

    At β = 0 only α + γ, at β = π only α − γ is determined: there γ = 0.
    Raises InputError if a norm is off 1 by more than 1e-9. Source: `zyz_attitude`, solved.
    """
    x, y, z, w = np.moveaxis(unit_quaternions("q", q), -1, 0)
    return _solved(np.arctan2(-x, y), x, y, z, w)


def zxz_angles(q: npt.ArrayLike) -> Array:
    """(φ, θ, ψ) of attitudes q (..., 4), in the ranges and with the limits of `zyz_angles`."""
    x, y, z, w = np.moveaxis(unit_quaternions("q", q), -1, 0)
    return _solved(np.arctan2(y, x), x, y, z, w)


def zxz_direction_cosines(angles: npt.ArrayLike) -> Array:
    """A (..., 3, 3) = A_ψ A_θ A_φ, whose rows are the body axes in world axes: x′ = A x.

    The order of the factors is the reverse of what some notes print. Source: Goldstein eq. (4.46).
    """
    phi, th, psi = _parts("angles", angles)
    (cf, sf), (ct, st), (cp, sp) = ((np.cos(x), np.sin(x)) for x in (phi, th, psi))
    rows = [
        _stack(cp * cf - ct * sf * sp, cp * sf + ct * cf * sp, sp * st),
        _stack(-sp * cf - ct * sf * cp, -sp * sf + ct * cf * cp, cp * st),
        _stack(st * sf, -st * cf, ct),
    ]
    return np.stack(rows, axis=-2)


def conditioning(middle_angle: npt.ArrayLike) -> Array:
    """How much an error of ω may grow in the rates: cot(β/2) below β = 90°, tan(β/2) above it.

    The ratio of the largest to the smallest stretch of rates to ω, whose squares are 1 ± cos β: the
    first and the third axis are β apart and the second is perpendicular to both. inf at β = 0.
    """
    half = np.abs(finite("middle_angle", middle_angle)) / 2
    small, large = np.sort(np.abs([np.sin(half), np.cos(half)]), axis=0)
    return np.where(small > 0, large / np.where(small > 0, small, 1), np.inf)


def _parts(name: str, value: npt.ArrayLike) -> Array:
    array = finite(name, value)
    if array.ndim == 0 or array.shape[-1] != 3:
        raise InputError(f"{name}: got an array of shape {array.shape}, expected (..., 3)")
    return np.moveaxis(array, -1, 0)


def _stack(*parts: Array) -> Array:
    return np.stack(np.broadcast_arrays(*parts), axis=-1)


def _sine(middle: Array) -> Array:
    sine = np.sin(middle)
    if np.any(sine == 0):
        raise InputError(
            "angles: got a middle angle whose sine is 0, expected one where the rates are determined"
        )
    return np.asarray(sine)


def _solved(half_difference: Array, x: Array, y: Array, z: Array, w: Array) -> Array:
    half_sum = np.arctan2(z, w)
    fold, rest = np.hypot(x, y), np.hypot(z, w)
    # Where one of the two is undetermined, it is taken so that the third angle is 0.
    half_difference = np.where(fold == 0, half_sum, half_difference)
    half_sum = np.where(rest == 0, half_difference, half_sum)
    return _stack(
        _wrapped(half_sum + half_difference), 2 * np.arctan2(fold, rest), _wrapped(half_sum - half_difference)
    )


def _wrapped(angle: Array) -> Array:
    return np.where(angle > np.pi, angle - 2 * np.pi, np.where(angle <= -np.pi, angle + 2 * np.pi, angle))
