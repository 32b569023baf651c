"""Two links in a plane, one hung from the other: energies, accelerations and small oscillations.

θ1 and θ2 are both from the downward vertical; the angle of the second hinge is θ2 − θ1. A link has its
centre of mass at ``arms`` and its moment ``inertias`` about that centre; without them all its mass sits at
its end, as in the books. The second length matters only then.

Source: Landau & Lifshitz, *Mechanics*, § 5, problem 1, and § 23, problem 2; Taylor, *Classical
Mechanics*, § 11.4.
"""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from .checked import Array, finite, positive
from .errors import InputError


class Links(NamedTuple):
    """2T = Aθ̇1² + 2Bθ̇1θ̇2 cos(θ1 − θ2) + Dθ̇2² and V = −G1 cos θ1 − G2 cos θ2 [kg m², J]."""

    A: float
    B: float
    D: float
    G1: float
    G2: float
    #: AD − B², written without a difference
    determinant: float


def links(
    masses: npt.ArrayLike,
    lengths: npt.ArrayLike,
    gravity: float,
    arms: npt.ArrayLike | None = None,
    inertias: npt.ArrayLike = (0.0, 0.0),
) -> Links:
    """The five constants of two links; every other function here takes them.

    Parameters
    ----------
    masses : (2,) [kg], above 0
    lengths : (2,) hinge to hinge, and hinge to end [m], above 0
    gravity : [m/s²], above 0
    arms : (2,) hinge to centre of mass [m], above 0; ``lengths`` if not given
    inertias : (2,) about the centres of mass [kg m²], 0 or above

    Raises InputError for anything else. Source: Landau & Lifshitz § 5, problem 1, with T + ½Iθ̇².
    """
    m1, m2 = _two("masses", masses)
    l1, _ = _two("lengths", lengths)
    a1, a2 = _two("arms", lengths if arms is None else arms)
    I1, I2 = finite("inertias", inertias, (2,)).tolist()
    if min(I1, I2) < 0:
        raise InputError(f"inertias: got {[I1, I2]}, expected 0 or above")
    g = positive("gravity", gravity)
    first, D = I1 + m1 * a1**2, I2 + m2 * a2**2
    return Links(
        A=first + m2 * l1**2,
        B=m2 * l1 * a2,
        D=D,
        G1=(m1 * a1 + m2 * l1) * g,
        G2=m2 * a2 * g,
        determinant=first * D + m2 * l1**2 * I2,
    )


def energy(links: Links, angles: npt.ArrayLike, rates: npt.ArrayLike) -> Array:
    """T + V (...) [J] at angles and rates (..., 2) [rad, rad/s], 0 when hanging at rest.

    Raises InputError if shapes do not fit. Source: Landau & Lifshitz § 5, problem 1.
    """
    (th1, th2), (w1, w2) = _state(angles, rates)
    A, B, D, G1, G2, _ = links
    kinetic = (A * w1**2 + D * w2**2) / 2 + B * w1 * w2 * np.cos(th1 - th2)
    return np.asarray(kinetic + 2 * G1 * np.sin(th1 / 2) ** 2 + 2 * G2 * np.sin(th2 / 2) ** 2)


def accelerations(links: Links, angles: npt.ArrayLike, rates: npt.ArrayLike) -> Array:
    """(θ̈1, θ̈2) (..., 2) [rad/s²] at angles and rates (..., 2) [rad, rad/s].

    Aθ̈1 + B cos Δ θ̈2 = −B sin Δ θ̇2² − G1 sin θ1, B cos Δ θ̈1 + Dθ̈2 = B sin Δ θ̇1² − G2 sin θ2, Δ = θ1 − θ2.
    Raises InputError if shapes do not fit. Source: Lagrange's equations of `energy`; Taylor § 11.4.
    """
    (th1, th2), (w1, w2) = _state(angles, rates)
    return np.stack(in_any_precision(links, th1, th2, w1, w2), axis=-1)


def in_any_precision(links: Links, th1: Any, th2: Any, w1: Any, w2: Any) -> tuple[Any, Any]:
    """θ̈1 and θ̈2 of `accelerations`, in the precision of its numbers or arrays, which it does not check."""
    A, B, D, G1, G2, determinant = links
    cos, sin = np.cos(th1 - th2), np.sin(th1 - th2)
    push1 = -B * sin * w2**2 - G1 * np.sin(th1)
    push2 = B * sin * w1**2 - G2 * np.sin(th2)
    # AD − B² cos²Δ as a sum, so that light links below heavy ones lose nothing.
    whole = determinant + (B * sin) ** 2
    return (D * push1 - B * cos * push2) / whole, (A * push2 - B * cos * push1) / whole


def energy_matrices(links: Links) -> tuple[Array, Array]:
    """T and V (2, 2) of small oscillations, for `normal_modes`. Source: `energy` to second order."""
    A, B, D, G1, G2, _ = links
    return np.array([[A, B], [B, D]]), np.diag([G1, G2])


def frequencies(links: Links) -> Array:
    """Both frequencies (2,) [rad/s] of small oscillations, the slow one first.

    (AD − B²)ω⁴ − (AG2 + DG1)ω² + G1G2 = 0; (2 ∓ √2) g/l for equal masses and lengths.
    Source: Landau & Lifshitz § 23, problem 2.
    """
    A, B, D, G1, G2, determinant = links
    total = A * G2 + D * G1
    # The discriminant total² − 4 (AD − B²) G1 G2, as a sum of squares.
    root = np.hypot(A * G2 - D * G1, 2 * B * np.sqrt(G1 * G2))
    fast = (total + root) / (2 * determinant)
    return np.sqrt([G1 * G2 / (determinant * fast), fast])


def modes(links: Links) -> Array:
    """θ2/θ1 (2,) in the modes of `frequencies`: alike in the slow one, opposite in the fast one.

    (G1 − Aω²)/(Bω²) = Bω²/(G2 − Dω²); ±√2 for equal masses and lengths.
    Source: Taylor § 11.4.
    """
    A, B, D, G1, G2, _ = links
    squares = frequencies(links) ** 2
    # Two forms of one ratio: take the one that is not a difference of nearly equal numbers.
    first, second = G1 - A * squares, G2 - D * squares
    steady = np.abs(first) * D >= np.abs(second) * A
    other = np.where(steady, 1.0, second)
    return np.where(steady, first / (B * squares), B * squares / other)


def _two(name: str, value: npt.ArrayLike) -> list[float]:
    pair = finite(name, value, (2,))
    if np.any(pair <= 0):
        raise InputError(f"{name}: got {pair.tolist()}, expected two numbers above 0")
    return [float(x) for x in pair]


def _state(angles: npt.ArrayLike, rates: npt.ArrayLike) -> tuple[Array, Array]:
    theta, omega = finite("angles", angles), finite("rates", rates)
    if theta.ndim == 0 or theta.shape[-1] != 2 or theta.shape != omega.shape:
        raise InputError(f"angles, rates: got shapes {theta.shape}, {omega.shape}, expected two (..., 2)")
    return np.moveaxis(theta, -1, 0), np.moveaxis(omega, -1, 0)
