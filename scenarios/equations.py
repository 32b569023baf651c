"""A scene as the reference's equations of motion take it, and states to hold engines against them at."""

from typing import Any

import numpy as np

from ..reference import equations_of_motion
from ..reference.checked import Array
from .forces import forces_on
from .scene import Scene
from .trajectory import Trajectory

#: Random states beside the scene's own, and the seed that they are drawn by.
STATES, SEED = 100, 4


def links(scene: Scene) -> "list[equations_of_motion.Link]":
    """The scene's bodies, for equations that know no scene and no engine."""
    names = [body.name for body in scene.bodies]
    return [
        equations_of_motion.Link(
            mass=body.mass,
            inertia=body.inertia_array,
            com=body.center_of_mass,
            parent=names.index(body.parent) if body.parent else -1,
            joints=tuple(
                equations_of_motion.Joint(j.kind, j.axis, stiffness=j.stiffness, damping=j.damping)
                for j in body.joints
            ),
            position=body.position,
            quaternion=body.quaternion,
        )
        for body in scene.bodies
    ]


def outer_forces(scene: Scene, q: Array, v: Array) -> Array:
    """The scene's own forces (n, b, 3) [N] on its bodies at ``q`` (n, nq) and ``v`` (n, nv)."""
    position, _, velocity, _ = equations_of_motion.link_motion(links(scene), q, v)
    push = forces_on(scene.bodies, scene.forces)
    return np.array([push(at, going) for at, going in zip(position, velocity, strict=True)])


def motions(scene: Scene, v0: Array, t: Array) -> list[Trajectory]:
    """What becomes of the scene at ``t`` (n,) [s] from each start ``v0`` (m, nv): integrated, to about 1e-7.

    For what no closed form tells; no contact and no burning mass is known here.
    """
    import scipy.integrate  # scenes are listed without it

    integrate: Any = scipy.integrate  # ships no types
    bodies, nq, shape = links(scene), len(scene.q0), (len(v0), -1)
    turns = [at for _, joint, at, _ in scene.slices() if joint.kind in ("free", "ball")]

    def straightened(q: Array) -> Array:
        for at in turns:
            q[..., at][..., -4:] /= np.linalg.norm(q[..., at][..., -4:], axis=-1, keepdims=True)
        return q

    def rates(_: float, state: Array) -> Array:
        q, v = straightened(state.reshape(shape)[:, :nq].copy()), state.reshape(shape)[:, nq:]
        pushed = outer_forces(scene, q, v)
        a = equations_of_motion.accelerations(bodies, q, v, scene.gravity, forces=pushed)
        return np.hstack([equations_of_motion.coordinate_rates(bodies, q, v), a]).ravel()

    start = np.hstack([np.tile(scene.q0, (len(v0), 1)), v0]).ravel()
    found = integrate.solve_ivp(rates, (0.0, t[-1]), start, "DOP853", t, rtol=1e-7, atol=1e-9).y.T
    scalars = [(i, j) for _, joint, i, j in scene.slices() if joint.kind in ("hinge", "slide")]
    result = []
    for run in np.moveaxis(found.reshape(len(t), *shape), 1, 0):
        q, v = straightened(run[:, :nq].copy()), run[:, nq:]
        angle, rate = (np.hstack([x[:, :0], *(x[:, at[k]] for at in scalars)]) for k, x in enumerate((q, v)))
        result.append(Trajectory(t, *equations_of_motion.link_motion(bodies, q, v), angle, rate))
    return result


def states(scene: Scene) -> tuple[Array, Array]:
    """Coordinates (n, nq) and velocities (n, nv), laid out as ``q0`` and ``v0``: the scene's own first.

    The others are random, the same at every call: any attitude and angle, displacements up to 1 m from
    the scene's own (a tenth of what it is there where forces depend on it), speeds up to its largest.
    """
    chance = np.random.default_rng(SEED)
    q = np.tile(np.array(scene.q0), (STATES + 1, 1))
    v = np.tile(np.array(scene.v0), (STATES + 1, 1))
    fastest = max(1.0, float(np.abs(v[0]).max(initial=0.0)))
    v[1:] = chance.uniform(-fastest, fastest, v[1:].shape)
    for _, joint, at, _ in scene.slices():
        own = q[1:, at]
        if joint.kind in ("free", "ball"):
            turns = chance.normal(size=(STATES, 4))
            own[:, -4:] = turns / np.linalg.norm(turns, axis=1, keepdims=True)
        if joint.kind == "hinge":
            own[:] = chance.uniform(-np.pi, np.pi, own.shape)
        elif joint.kind != "ball":
            places = own[:, :3]
            reach = 0.1 * np.linalg.norm(places[0]) if scene.forces else 1.0
            places += chance.uniform(-reach, reach, places.shape)
    return q, v
