"""Integrators for an engine that has none: on any joints, given their accelerations and their ⊕."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import sqrt, tan

import numpy as np
from scipy.linalg import get_lapack_funcs

from ..reference.checked import Array


@dataclass(frozen=True)
class Mechanism:
    """What a scheme needs to know of the system.

    ``force(q, v)`` is that of springs, dampers and forces from outside (nv,); ``accelerate(q, v, force)``
    gives v̇ (nv,); ``integrate(q, dq)`` is q ⊕ dq; ``linearised(q, v)`` gives the mass matrix and −∂f/∂v
    of the whole generalised force f = M v̇ but for that from outside, (nv, nv) each and new at every call;
    ``balls`` are the first places in v of the angular velocities whose coordinates are quaternions.
    ``touch(q, before, free)`` are the velocities after contact, given those at the start of a step and
    those it would end with; ``None`` where nothing touches.
    """

    force: Callable[[Array, Array], Array]
    accelerate: Callable[[Array, Array, Array], Array]
    integrate: Callable[[Array, Array], Array]
    linearised: Callable[[Array, Array], tuple[Array, Array]]
    balls: Sequence[int]
    touch: Callable[[Array, Array, Array], Array] | None = None


# numpy's solve takes longer to check its arguments than LAPACK to solve for a few bodies.
(_solve,) = get_lapack_funcs(("gesv",), dtype=np.float64)

Advance = Callable[[Mechanism, Array, Array, float, int], tuple[Array, Array]]


def semi_implicit_euler(system: Mechanism, q: Array, v: Array, dt: float, n: int) -> tuple[Array, Array]:
    """Advance by v += a dt, then q ⊕= v dt."""
    force, accelerate, integrate, multiply = system.force, system.accelerate, system.integrate, np.multiply
    touch = system.touch
    # An array of no dimensions and a place for the product: numpy is a third of the cost of a step.
    step, change = np.array(dt), np.empty_like(v)
    for _ in range(n):
        multiply(accelerate(q, v, force(q, v)), step, change)
        if touch is None:
            v += change
        else:
            v = touch(q, v, v + change)
        multiply(v, step, change)
        q = integrate(q, change)
    return q, v


def implicit_gyroscopic(system: Mechanism, q: Array, v: Array, dt: float, n: int) -> tuple[Array, Array]:
    """As semi-implicit Euler, with (M − dt ∂f/∂v) a = f in place of M a = f."""
    force, accelerate, integrate, step = system.force, system.accelerate, system.integrate, np.array(dt)
    for _ in range(n):
        a = accelerate(q, v, force(q, v))
        if system.touch is not None:  # what contact does is a force like any other, as it is to MuJoCo
            a = (system.touch(q, v, v + step * a) - v) / step
        # Solved for the difference to the explicit a: the rounding of M and ∂f/∂v then counts dt times less.
        mass, drag = system.linearised(q, v)
        drag *= step
        a -= _solve(mass + drag, drag @ a)[2]
        v += step * a
        q = integrate(q, step * v)
    return q, v


def rkmk4(system: Mechanism, q: Array, v: Array, dt: float, n: int) -> tuple[Array, Array]:
    """The classical Runge–Kutta scheme on the Lie algebra at the step's start (Munthe-Kaas)."""
    force, accelerate, integrate = system.force, system.accelerate, system.integrate
    half, whole, once, twice, sixth = (np.array(x) for x in (dt / 2, dt, 1.0, 2.0, dt / 6))
    for _ in range(n):
        k, a = v, accelerate(q, v, force(q, v))
        sum_k, sum_a = k.copy(), a.copy()
        for reach, weight in ((half, twice), (half, twice), (whole, once)):
            turn, w = reach * k, v + reach * a
            x = integrate(q, turn)
            a = accelerate(x, w, force(x, w))
            k = _pulled_back(turn, w, system.balls)
            sum_k += weight * k
            sum_a += weight * a
        v = v + sixth * sum_a
        q = integrate(q, sixth * sum_k)
    return q, v


def _pulled_back(turn: Array, w: Array, balls: Sequence[int]) -> Array:
    """``w`` as a rate of change of ``turn``: the inverse differential of exp at each quaternion's part."""
    rate = w.copy()
    for i in balls:
        x, y, z = turn[i : i + 3].tolist()
        wx, wy, wz = w[i : i + 3].tolist()
        angle2 = x * x + y * y + z * z
        half = sqrt(angle2) / 2
        # c only ever multiplies θ²: what its subtraction loses at small θ is lost on nothing.
        c = (1 - half / tan(half)) / angle2 if half > 1e-4 else 1 / 12
        ax, ay, az = y * wz - z * wy, z * wx - x * wz, x * wy - y * wx
        rate[i] += ax / 2 + c * (y * az - z * ay)
        rate[i + 1] += ay / 2 + c * (z * ax - x * az)
        rate[i + 2] += az / 2 + c * (x * ay - y * ax)
    return rate
