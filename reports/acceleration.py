"""Accelerations: the engine's own, at given states, put into our equations of motion; no step is taken."""

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from ..reference import equations_of_motion
from ..reference.checked import Array
from ..scenarios.equations import links, outer_forces, states
from ..scenarios.scene import Scene
from .cell import Cell
from .verdict import Status, Verdict

#: Rounding: an engine's recursions take some hundred operations over a tree, each good to 1e-16.
TOLERANCE = 1e-12


class Expected(NamedTuple):
    """What the equations of motion of a scene say at its states, n of them."""

    inertia: Array
    acceleration: Array
    unit: Array
    size: Array


def check(cell: Cell) -> list[Verdict]:
    """One verdict where the engine's accelerations were logged.

    They are put into the equations of motion: what force is then left over along each velocity, as a
    part of the forces that should cancel there, inertial ones included. So it is the rounding of the
    equations that counts, and not how badly they may be conditioned.
    """
    if not cell.provenance.accelerations:
        return []
    exact, got = expected(cell.scene), np.array(cell.provenance.accelerations)
    name = "equations of motion"
    if got.shape != exact.acceleration.shape or not np.isfinite(got).all():
        message = f"got shape {got.shape}, expected finite accelerations {exact.acceleration.shape}"
        return [cell.verdict("acceleration", name, Status.FAIL, message)]
    left = np.einsum("nij,nj->ni", exact.inertia, got - exact.acceleration) / exact.unit
    parts = np.abs(left).max(axis=1) / exact.size
    worst = int(np.argmax(parts))
    status = Status.PASS if parts[worst] <= TOLERANCE else Status.FAIL
    message = (
        f"force that the equations of motion leave over at {len(got)} states, as a part of those in them; "
        f"most at {'the start' if worst == 0 else f'random state {worst}'}; rounding is allowed"
    )
    return [cell.verdict("acceleration", name, status, message, float(parts[worst]), TOLERANCE, "1")]


@lru_cache(maxsize=16)
def expected(scene: Scene) -> Expected:
    """The scene's inertia (n, nv, nv) and accelerations (n, nv) at ``equations.states``.

    ``unit`` (n, nv) is the root of each velocity's own inertia: divided by it, forces along metres and
    radians compare. ``size`` (n,) is then the largest force: inertial ones, weights and forces from
    outside before they cancel, as all do where a pendulum hangs at rest.
    """
    (q, v), bodies = states(scene), links(scene)
    forces = outer_forces(scene, q, v)
    inertia, bias = equations_of_motion.mass_matrix(bodies, q), equations_of_motion.bias(bodies, q, v)
    true = equations_of_motion.accelerations(bodies, q, v, scene.gravity, forces=forces)
    unit = np.sqrt(np.einsum("nii->ni", inertia))
    applied = np.einsum("nij,nj->ni", inertia, true) + bias
    moved = np.einsum("nij,nj->ni", np.abs(inertia), np.abs(true))
    omega = equations_of_motion.link_motion(bodies, q, v)[3]
    fastest = np.linalg.norm(omega, axis=2).max(axis=1)
    still = np.zeros_like(v)
    weight = equations_of_motion.required_forces(bodies, q, still, still, scene.gravity)
    pushed = equations_of_motion.required_forces(bodies, q, still, still, forces=forces)
    acting = np.abs(bias) + np.abs(applied) + np.abs(weight) + np.abs(pushed)
    size = ((moved + acting) / unit).max(axis=1)
    return Expected(inertia, true, unit, size + fastest * np.linalg.norm(unit * v, axis=1) + 1e-300)
