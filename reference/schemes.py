"""What an integration scheme itself must give, exactly, where the motion is linear or polynomial.

A scheme turns Tq̈ + Cq̇ + Vq = f into a fixed linear map of the state; n steps are its n-th power. An
engine that runs the scheme at step dt must land on these numbers, however far they are from the truth.

Source: Hairer, Lubich & Wanner, *Geometric Numerical Integration*, § I.1 (the one-step schemes);
Hairer & Wanner, *Solving Ordinary Differential Equations II*, § IV.2 (stability functions).
"""

from typing import Literal

import numpy as np
import numpy.typing as npt

from .checked import Array, finite, positive, times
from .eigenpairs import Long, energy_matrices
from .errors import InputError

Scheme = Literal[
    "semi_implicit_euler", "implicit_damping", "rk4", "implicit_euler", "implicit_midpoint", "explicit_euler"
]

#: All but RK4 solve (T + a·dt·C + b·dt²·V) Δv = dt·(f − Vq − Cv − c·dt·Vv), then q += dt·(v + p·Δv).
_WEIGHTS: dict[Scheme, tuple[float, float, float, float]] = {
    "semi_implicit_euler": (0, 0, 0, 1),
    "implicit_damping": (1, 0, 0, 1),
    "implicit_euler": (1, 1, 1, 1),
    "implicit_midpoint": (0.5, 0.25, 0.5, 0.5),
    "explicit_euler": (0, 0, 0, 0),
}

SCHEMES: tuple[Scheme, ...] = (*_WEIGHTS, "rk4")


def uniform_acceleration(
    scheme: Scheme,
    x0: npt.ArrayLike,
    v0: npt.ArrayLike,
    acceleration: npt.ArrayLike,
    dt: float,
    steps: npt.ArrayLike,
) -> tuple[Array, Array]:
    """Position and velocity after n steps under a constant acceleration a.

    Velocities are exact, v0 + an·dt. Positions are exact for RK4 and the midpoint rule, a·dt·t/2
    further for the schemes that move with the new velocity and as much short with the old one.

    Parameters
    ----------
    scheme : one of `SCHEMES`
    x0, v0, acceleration : (d,) [m, m/s, m/s²]
    dt : step [s], above 0
    steps : (m,) numbers of steps, whole

    Returns
    -------
    x, v : (m, d)

    Raises
    ------
    InputError
        Another scheme, shapes that do not fit, dt not above 0, steps not whole or negative.

    Source: x = x0 + dt Σ v of the scheme, summed; see the module's source.
    """
    known_scheme(scheme)
    h, count = np.longdouble(positive("dt", dt)), whole_steps(steps).astype(np.longdouble)[:, None]
    start = finite("x0", x0, (-1,))
    speed, a = finite("v0", v0, start.shape), finite("acceleration", acceleration, start.shape)
    # Twice the weight of the new velocity, less one: 1, 0 or −1.
    shift = 0.0 if scheme == "rk4" else 2 * _WEIGHTS[scheme][3] - 1
    x = start + h * count * speed + h * h * a * (count * (count + shift) / 2)
    return x.astype(np.float64), (speed + a * (h * count)).astype(np.float64)


def linear_motion(
    scheme: Scheme,
    T: npt.ArrayLike,
    V: npt.ArrayLike,
    q0: npt.ArrayLike,
    v0: npt.ArrayLike,
    dt: float,
    steps: npt.ArrayLike,
    damping: npt.ArrayLike | None = None,
    force: npt.ArrayLike | None = None,
) -> tuple[Array, Array]:
    """Coordinates and velocities of Tq̈ + Cq̇ + Vq = f after n steps of a scheme.

    Parameters
    ----------
    scheme : one of `SCHEMES`
        `implicit_damping` is semi-implicit Euler with the damping force taken at the new velocity.
    T, V : (n, n)
        Symmetric, T positive definite; V may fall (an unstable equilibrium) or be 0.
    q0, v0 : (n,)
    dt : step [s], above 0
    steps : (m,) numbers of steps, whole
    damping : (n, n), C; need not be symmetric (gyroscopic and Coriolis terms)
    force : (n,), f, constant

    Returns
    -------
    q, v : (m, n)

    Raises
    ------
    InputError
        As `uniform_acceleration`; T or V not as above; no solution of an implicit step; or growth
        past the largest double (a step far beyond the stable one).

    Source: see the module's; the n-th power by repeated squaring.
    """
    masses, stiffness = energy_matrices(T, V)
    n = len(masses)
    start = np.concatenate([finite("q0", q0, (n,)), finite("v0", v0, (n,)), [1.0]])
    C = finite("damping", np.zeros((n, n)) if damping is None else damping, (n, n))
    f = finite("force", np.zeros(n) if force is None else force, (n,))
    count = whole_steps(steps)
    change = step_change(scheme, masses, stiffness, dt, C, f)
    with np.errstate(over="ignore", invalid="ignore"):
        states = _repeated(change, start, count).astype(np.float64)
    if not np.all(np.isfinite(states)):
        raise InputError(
            f"dt: got {dt}, with which {scheme} grows past the largest double within {count.max()} steps; "
            "expected a smaller step or fewer of them"
        )
    return states[:n].T, states[n : 2 * n].T


def step_change(
    scheme: Scheme,
    T: npt.ArrayLike,
    V: npt.ArrayLike,
    dt: float,
    damping: npt.ArrayLike,
    force: npt.ArrayLike,
) -> Long:
    """One step's change of the state (q, v, 1), a matrix (2n + 1, 2n + 1) in extended precision.

    Arguments and what it raises as for `linear_motion`. The step matrix is this plus 1: kept apart,
    because at small steps the sum would round the change away.
    """
    known_scheme(scheme)
    h = np.longdouble(positive("dt", dt))
    masses, stiffness = energy_matrices(T, V)
    n = len(masses)
    M, K, C = (matrix.astype(np.longdouble) for matrix in (masses, stiffness, np.asarray(damping)))
    f = np.asarray(force, dtype=np.longdouble)[:, None]
    unit, rest = np.eye(n, dtype=np.longdouble), np.zeros((1, 2 * n + 1), dtype=np.longdouble)
    if scheme == "rk4":
        Z = h * np.vstack([np.eye(n, 2 * n + 1, n), _solved(M, np.hstack([-K, -C, f])), rest])
        return Z + Z @ (Z / 2 + Z @ (Z / 6 + Z @ Z / 24))
    a, b, c, p = _WEIGHTS[scheme]
    dv = _solved(M + a * h * C + b * h * h * K, h * np.hstack([-K, -C - c * h * K, f]))
    dq = h * (np.hstack([0 * unit, unit, 0 * f]) + p * dv)
    return np.vstack([dq, dv, rest])


def known_scheme(scheme: Scheme) -> None:
    """Raise InputError unless ``scheme`` is one of `SCHEMES`; the message lists them."""
    if scheme not in SCHEMES:
        raise InputError(f"scheme: got {scheme!r}, expected one of {', '.join(SCHEMES)}")


def whole_steps(steps: npt.ArrayLike) -> npt.NDArray[np.int64]:
    """``steps`` (m,) as integers; raises InputError unless they are whole and from 0 to 2**53."""
    count = times("steps", steps)
    # Above 2**53 doubles skip whole numbers.
    if np.any(count != np.floor(count)) or np.any(count < 0) or np.any(count > 2**53):
        raise InputError(f"steps: got {count.tolist()}, expected whole numbers from 0 to 2**53")
    return count.astype(np.int64)


def _solved(matrix: Long, right: Long) -> Long:
    try:
        inverse = np.linalg.inv(matrix.astype(np.float64)).astype(np.longdouble)
    except np.linalg.LinAlgError as cause:
        raise InputError(
            "dt: got a step whose implicit equation has no solution, expected another"
        ) from cause
    # Newton's iteration squares the error of an inverse: from double to below extended rounding.
    for _ in range(3):
        inverse = inverse + inverse @ (np.eye(len(matrix)) - matrix @ inverse)
    return inverse @ right


def _repeated(power: Long, start: Array, count: npt.NDArray[np.int64]) -> Long:
    # (1 + B)ⁿ by squaring. B is held without the 1, which would cost the digits of a small B, until it
    # has grown; from then on 1 + B is held, or what decays would be lost in 1 + (−1).
    states = np.repeat(start.astype(np.longdouble)[:, None], len(count), axis=1)
    apart = 1
    while np.any(count):
        odd = count % 2 == 1
        states[:, odd] = power @ states[:, odd] + apart * states[:, odd]
        count = count // 2
        if np.any(count):
            power = power @ power + 2 * apart * power
        if apart and np.abs(np.diagonal(power)).max() > 0.5:
            power, apart = power + np.eye(len(power)), 0
    return states
