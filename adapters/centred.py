"""A scene seen from the centres of mass of its free bodies, for engines whose free joints sit at an origin.

A free body's origin off its centre of mass goes round that centre, and a step that moves the origin evenly
moves the centre wrongly. PyBullet's bases move by their centre; here the same is made of the other engines.
"""

from dataclasses import dataclass, replace

import numpy as np

from ..reference import quaternions
from ..reference.checked import Array
from ..scenarios.body import Body, Vector
from ..scenarios.scene import Scene


@dataclass(frozen=True)
class Centred:
    """A ``scene`` whose free bodies have their centre of mass at their origin, and the one it was ``before``.

    Shapes that touch hang on origins: scenes with contacts stay as they are.
    """

    before: Scene
    scene: Scene

    @property
    def moved(self) -> list[tuple[slice, slice, Array]]:
        """Places in q and v of each free joint that was moved, and by what (3,) [m], in its body's axes."""
        return [
            (at_q, at_v, np.array(_offset(self.before, body)))
            for body, joint, at_q, at_v in self.before.slices()
            if joint.kind == "free" and any(_offset(self.before, body))
        ]

    def state(self, q: Array, v: Array) -> tuple[Array, Array]:
        """Coordinates (nq,) and velocities (nv,) of the centred scene, from those of the one before."""
        q, v = np.array(q, dtype=np.float64), np.array(v, dtype=np.float64)
        for at_q, at_v, offset in self.moved:
            turn, omega = q[at_q][3:], v[at_v][3:]
            q[at_q.start : at_q.start + 3] += quaternions.rotated(turn, offset)
            v[at_v.start : at_v.start + 3] += quaternions.rotated(turn, quaternions.cross(omega, offset))
        return q, v

    def acceleration(self, q: Array, v: Array, found: Array) -> Array:
        """Accelerations (nv,) in the scene before, from those ``found`` in the centred one at its q and v."""
        result = np.array(found)
        for at_q, at_v, offset in self.moved:
            omega, alpha = v[at_v][3:], result[at_v][3:]
            inward = quaternions.cross(omega, quaternions.cross(omega, offset))
            result[at_v.start : at_v.start + 3] -= quaternions.rotated(
                q[at_q][3:], quaternions.cross(alpha, offset) + inward
            )
        return result

    def center_of_mass(self, body: Body, found: Array) -> Array:
        """A body's centre of mass (3,) [m] from the origin it had, from where it is ``found`` now."""
        return np.asarray(found + np.array(_offset(self.before, body)))


def centred(scene: Scene) -> Centred:
    """``scene`` from the centres of mass of its free bodies; the same scene if that is where it is."""
    offsets: dict[str | None, Vector] = {body.name: _offset(scene, body) for body in scene.bodies}
    if not any(any(offset) for offset in offsets.values()):
        return Centred(scene, scene)
    bodies = tuple(
        replace(
            body,
            center_of_mass=_less(body.center_of_mass, offsets[body.name]),
            position=_less(body.position, offsets.get(body.parent, _NOT)),
            solids=tuple(
                replace(solid, position=_less(solid.position, offsets[body.name])) for solid in body.solids
            ),
        )
        for body in scene.bodies
    )
    built = Centred(scene, replace(scene, bodies=bodies))
    q0, v0 = built.state(np.array(scene.q0), np.array(scene.v0))
    return replace(built, scene=replace(built.scene, q0=tuple(q0.tolist()), v0=tuple(v0.tolist())))


_NOT: Vector = (0.0, 0.0, 0.0)


def _offset(scene: Scene, body: Body) -> Vector:
    free = any(joint.kind == "free" for joint in body.joints)
    return body.center_of_mass if free and not scene.contacts else _NOT


def _less(a: Vector, b: Vector) -> Vector:
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]
