"""What a scheme makes of a tree's state in a few steps: written for stacks of states, by no engine's method.

Whoever has the states of a run at some times can tell from them which equations and which scheme led from
each to the next. Velocities of balls are angular velocities in the turned axes, as ``multibody_tree`` says.

Source: Hairer, Lubich & Wanner, *Geometric Numerical Integration*, §§ I.1 (semi-implicit Euler) and IV.8
(Runge-Kutta on the Lie algebra, after Munthe-Kaas); Hairer & Wanner, *Solving Ordinary Differential
Equations II*, § IV.7 (one Newton step for an implicit one).
"""

from collections.abc import Callable, Sequence

import numpy as np

from . import quaternions
from .checked import Array
from .errors import InputError
from .multibody_tree import Link
from .tree_kinematics import joints_of

#: v̇ (..., nv) at a state (..., nq), (..., nv).
Accelerate = Callable[[Array, Array], Array]
#: The mass matrix and −∂f/∂v of the whole force f = M v̇, (..., nv, nv) each.
Linearised = Callable[[Array, Array], tuple[Array, Array]]
Step = Callable[[Sequence[Link], Accelerate, Array, Array, float], tuple[Array, Array]]


def advanced(
    scheme: str,
    links: Sequence[Link],
    accelerate: Accelerate,
    q: Array,
    v: Array,
    dt: float,
    steps: int,
    linearised: Linearised | None = None,
) -> tuple[Array, Array]:
    """The states that ``steps`` steps of dt [s] lead to from ``q`` (..., nq) and ``v`` (..., nv).

    ``scheme`` is one of ``SCHEMES``, or "implicit gyroscopic", which needs ``linearised``. Raises
    ``InputError`` for another.
    """
    if linearised is not None and scheme == "implicit gyroscopic":
        implicit = _implicitly(accelerate, linearised, dt)
        for _ in range(steps):
            q, v = semi_implicit_euler(links, implicit, q, v, dt)
        return q, v
    if scheme not in SCHEMES:
        raise InputError(f"scheme: got {scheme!r}, expected one of {', '.join(SCHEMES)}")
    for _ in range(steps):
        q, v = SCHEMES[scheme](links, accelerate, q, v, dt)
    return q, v


def semi_implicit_euler(
    links: Sequence[Link], accelerate: Accelerate, q: Array, v: Array, dt: float
) -> tuple[Array, Array]:
    """One step of v += a dt, then q ⊕= v dt."""
    v = v + dt * accelerate(q, v)
    return moved(links, q, dt * v), v


def explicit_euler(
    links: Sequence[Link], accelerate: Accelerate, q: Array, v: Array, dt: float
) -> tuple[Array, Array]:
    """One step of q ⊕= v dt with the old v, and v += a dt."""
    return moved(links, q, dt * v), v + dt * accelerate(q, v)


def rkmk4(
    links: Sequence[Link], accelerate: Accelerate, q: Array, v: Array, dt: float
) -> tuple[Array, Array]:
    """One step of the classical Runge-Kutta scheme on the Lie algebra at the step's start."""
    return _runge_kutta(links, accelerate, q, v, dt, _pulled_back)


def rk4_of_body_velocities(
    links: Sequence[Link], accelerate: Accelerate, q: Array, v: Array, dt: float
) -> tuple[Array, Array]:
    """One Runge-Kutta step that adds up the ω of its stages as if their axes were the same: of order 2."""
    return _runge_kutta(links, accelerate, q, v, dt, lambda links, turn, w: w)


#: By the twin names that engines declare; "exact" is close to the flow itself for steps of a few degrees.
SCHEMES: dict[str, Step] = {
    "semi-implicit Euler": semi_implicit_euler,
    "RKMK4": rkmk4,
    "RK4 of body velocities": rk4_of_body_velocities,
    "explicit Euler": explicit_euler,
}


def moved(links: Sequence[Link], q: Array, change: Array) -> Array:
    """Coordinates q ⊕ change: those (..., nq) moved along velocities' directions by ``change`` (..., nv)."""
    result = np.array(q)
    for joint, at_q, at_v in joints_of(links):
        if joint.kind in ("hinge", "slide"):
            result[..., at_q] += change[..., at_v]
            continue
        if joint.kind == "free":
            result[..., at_q : at_q + 3] += change[..., at_v : at_v + 3]
            at_q, at_v = at_q + 3, at_v + 3
        turn = quaternions.from_rotation_vector(change[..., at_v : at_v + 3])
        result[..., at_q : at_q + 4] = quaternions.product(q[..., at_q : at_q + 4], turn)
    return result


def apart(links: Sequence[Link], q: Array, other: Array) -> Array:
    """The change (..., nv) with other ⊕ change = q, turns by the shorter way."""
    changes = []
    for joint, at_q, _ in joints_of(links):
        if joint.kind in ("hinge", "slide"):
            changes.append(q[..., at_q : at_q + 1] - other[..., at_q : at_q + 1])
            continue
        if joint.kind == "free":
            changes.append(q[..., at_q : at_q + 3] - other[..., at_q : at_q + 3])
            at_q += 3
        here = slice(at_q, at_q + 4)
        turn = quaternions.product(quaternions.conjugate(other[..., here]), q[..., here])
        changes.append(quaternions.rotation_vector(turn))
    return np.concatenate(changes, axis=-1)


def _implicitly(accelerate: Accelerate, linearised: Linearised, dt: float) -> Accelerate:
    """Accelerations of (M − dt ∂f/∂v) a = f, in place of M a = f."""

    def solved(q: Array, v: Array) -> Array:
        M, drag = linearised(q, v)
        force = np.einsum("...ij,...j->...i", M, accelerate(q, v))
        return np.asarray(np.linalg.solve(M + dt * drag, force[..., None])[..., 0])

    return solved


def _runge_kutta(
    links: Sequence[Link],
    accelerate: Accelerate,
    q: Array,
    v: Array,
    dt: float,
    as_rate: Callable[[Sequence[Link], Array, Array], Array],
) -> tuple[Array, Array]:
    k, a = v, accelerate(q, v)
    sum_k, sum_a = k, a
    for reach, weight in ((dt / 2, 2), (dt / 2, 2), (dt, 1)):
        turn, w = reach * k, v + reach * a
        x = moved(links, q, turn)
        a, k = accelerate(x, w), as_rate(links, turn, w)
        sum_k, sum_a = sum_k + weight * k, sum_a + weight * a
    return moved(links, q, dt / 6 * sum_k), v + dt / 6 * sum_a


def _pulled_back(links: Sequence[Link], turn: Array, w: Array) -> Array:
    """``w`` as a rate of change of ``turn``: the inverse differential of exp at every ball."""
    rate = np.array(w)
    for joint, _, at in joints_of(links):
        if joint.kind in ("free", "ball"):
            here = slice(at + 3, at + 6) if joint.kind == "free" else slice(at, at + 3)
            u, x = turn[..., here], w[..., here]
            once = np.cross(u, x)
            rate[..., here] += once / 2 + _curving(u) * np.cross(u, once)
    return rate


def _curving(u: Array) -> Array:
    """(1 − θ/2 cot θ/2)/θ² of the length θ of ``u`` (..., 3), as (..., 1)."""
    angle = np.linalg.norm(u, axis=-1, keepdims=True)
    half = np.where(angle > 1e-4, angle, 1.0) / 2
    # Below 1e-4 the next term of the series, θ²/720, is lost beside 1/12 times θ² in what it multiplies.
    return np.where(angle > 1e-4, (1 - half / np.tan(half)) / (2 * half) ** 2, 1 / 12)
