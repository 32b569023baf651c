"""Energy and momenta of a trajectory, computed from its states in the same way for every engine."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..reference import quaternions
from ..reference.checked import Array
from .trajectory import Trajectory

if TYPE_CHECKING:
    from .scene import Scene


def masses(scene: Scene) -> Array:
    """Mass of every body, (b,) [kg]; of one that burns, at the start."""
    return np.array([body.mass for body in scene.bodies])


def spin_momentum_body(scene: Scene, motion: Trajectory) -> Array:
    """I ω of every body about its own centre of mass, (n, b, 3) [kg m²/s], body axes."""
    inertia = np.array([body.inertia for body in scene.bodies])
    return np.asarray(np.einsum("bij,nbj->nbi", inertia, motion.omega))


def kinetic_energy(scene: Scene, motion: Trajectory) -> Array:
    """½ Σ (m v² + ω·Iω), (n,) [J]."""
    orbital = np.einsum("b,nbi,nbi->n", masses(scene), motion.velocity, motion.velocity)
    spin = np.einsum("nbi,nbi->n", motion.omega, spin_momentum_body(scene, motion))
    return np.asarray((orbital + spin) / 2)


def potential_energy(scene: Scene, motion: Trajectory) -> Array:
    """−Σ m g·r + ½ Σ k q², and that of the scene's forces, (n,) [J]."""
    weight = -np.einsum("b,nbi,i->n", masses(scene), motion.position, np.array(scene.gravity))
    stiffness = np.array([joint.stiffness for joint in scene.scalar_joints])
    outer = sum(force.potential(scene.bodies, motion.position) for force in scene.forces)
    return np.asarray(weight + (motion.joint_position**2 @ stiffness) / 2 + outer)


def energy(scene: Scene, motion: Trajectory) -> Array:
    """Kinetic and potential energy together, (n,) [J]."""
    return kinetic_energy(scene, motion) + potential_energy(scene, motion)


def momentum(scene: Scene, motion: Trajectory) -> Array:
    """Σ m v, (n, 3) [kg m/s], world axes."""
    return np.asarray(np.einsum("b,nbi->ni", masses(scene), motion.velocity))


def angular_momentum_world(scene: Scene, motion: Trajectory) -> Array:
    """Σ (r × m v + R I ω) about the world's origin, (n, 3) [kg m²/s], world axes."""
    orbital = quaternions.cross(motion.position, masses(scene)[:, None] * motion.velocity)
    spin_body = spin_momentum_body(scene, motion)
    return np.asarray((orbital + quaternions.rotated(motion.quaternion, spin_body)).sum(axis=1))


def momentum_scale(scene: Scene, motion: Trajectory) -> float:
    """Size of the momenta that may cancel in the sum: max over time of Σ m |v| [kg m/s]."""
    return float(np.max(np.linalg.norm(motion.velocity, axis=2) @ masses(scene)))


def angular_momentum_scale(scene: Scene, motion: Trajectory) -> float:
    """Size of the angular momenta that may cancel in the sum [kg m²/s]."""
    orbital = np.linalg.norm(
        quaternions.cross(motion.position, masses(scene)[:, None] * motion.velocity), axis=2
    )
    spin = np.linalg.norm(spin_momentum_body(scene, motion), axis=2)
    return float(np.max((orbital + spin).sum(axis=1)))
