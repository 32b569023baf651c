"""Terms that may be over or missing in an engine's equations of motion, as forces along each velocity.

A term is a function of a model, its coordinates (..., nq) and its velocities (..., nv), and is (..., nv).
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ..reference import equations_of_motion, quaternions
from ..reference.checked import Array
from ..reference.tree_kinematics import motion, summed
from .supposed import Change, Model

Term = Callable[[Model, Array, Array], Array]


def forced(at: int, force: Callable[[Array, Array], Array]) -> Change:
    """X times ``force`` along one velocity."""

    def along(m: Model, q: Array, v: Array) -> Array:
        result = np.zeros_like(v)
        result[..., at] = -force(q, v)
        return result

    return added(along)


def added(term: Term) -> Change:
    """X times more of a ``term`` that stands on the side of inertia."""

    def changed(m: Model, x: float) -> Model:
        before = m.added
        return replace(m, added=lambda q, v: (before(q, v) if before else 0.0) - x * term(m, q, v))

    return changed


def bias(m: Model, q: Array, v: Array) -> Array:
    """All that stands on the side of inertia besides accelerations: gyroscopic, centrifugal and Coriolis."""
    return equations_of_motion.bias(m.links, q, v)


def gyroscopic(m: Model, q: Array, v: Array) -> Array:
    """What ω×Iω of all links is along each velocity."""
    state = motion(m.links, q, v)
    omega = summed(state.partial_omega, v)
    torque = quaternions.cross(omega, (_tensors(m, state.quaternion) @ omega[..., None])[..., 0])
    return np.asarray(np.sum(state.partial_omega * torque[..., None, :], axis=(-3, -1)))


def drag(m: Model, q: Array, v: Array, *, turning: bool, growing: bool) -> Array:
    """Every body's momentum, of its ``turning`` or of its centre; ``growing`` with its speed."""
    state = motion(m.links, q, v)
    partial = state.partial_omega if turning else state.partial_velocity
    speed = summed(partial, v)
    scale = 1 + np.linalg.norm(speed, axis=-1, keepdims=True) if growing else 1.0
    masses = np.array([link.mass for link in m.links])[:, None]
    momentum = (_tensors(m, state.quaternion) @ speed[..., None])[..., 0] if turning else masses * speed
    return np.asarray(np.sum(partial * (scale * momentum)[..., None, :], axis=(-3, -1)))


def _tensors(m: Model, attitudes: Array) -> Array:
    """Inertias of all links in world axes, (..., links, 3, 3)."""
    R = quaternions.matrix(attitudes)
    inertia: Array = R @ np.stack([np.asarray(link.inertia) for link in m.links]) @ np.swapaxes(R, -1, -2)
    return inertia


def linear_weight(model: Model, at_q: int, at_v: int) -> Callable[[Array, Array], Array]:
    """The weight along a velocity as it would be if it grew with the coordinate, less what it is."""

    def weight(q: Array) -> Array:
        still = np.zeros((*q.shape[:-1], len(model.scene.v0)))
        acting = equations_of_motion.required_forces(model.links, q, still, still, model.gravity)
        return np.asarray(-acting[..., at_v])

    def difference(q: Array, v: Array) -> Array:
        near, width = np.array(q), 1e-5
        near[..., at_q] = width
        far = np.array(near)
        far[..., at_q] = -width
        slope = (weight(near) - weight(far)) / (2 * width)
        return np.asarray(slope * q[..., at_q] - weight(q))

    return difference
