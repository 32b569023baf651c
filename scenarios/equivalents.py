"""The same system said in another way: in other units, turned, with other axes, with its bodies cut in two.

What an engine makes of it must be the same motion. Each function takes a scene and gives an ``Equivalent``:
a scene to run, and the way back to the motion of the one it stands for. Of truth and records of errors the
new scene has none.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..reference import quaternions
from ..reference.checked import Array, positive, unit_quaternion
from ..reference.errors import InputError
from .blows import Blow
from .body import Body, Joint, Matrix, Quaternion, Vector
from .burning import Burning
from .contact import Contact, Plane, Rim, Sphere
from .forces import Attraction, Center, Centrifugal, Constant, Coriolis, Force, Spring
from .scene import Scene
from .trajectory import Trajectory


@dataclass(frozen=True)
class Equivalent:
    """A ``scene`` that stands for another, and ``back`` from its motion to that of the other."""

    scene: Scene
    back: Callable[[Trajectory], Trajectory]


def scaled(scene: Scene, length: float = 1.0, mass: float = 1.0, time: float = 1.0) -> Equivalent:
    """``scene`` in units so much smaller: every length, mass and time so many times as large."""
    for name, factor in (("length", length), ("mass", mass), ("time", time)):
        positive(name, factor)
    L, M, T = length, mass, time
    units = {"free": (L,) * 3 + (1.0,) * 4, "ball": (1.0,) * 4, "hinge": (1.0,), "slide": (L,)}
    rates = {"free": (L / T,) * 3 + (1 / T,) * 3, "ball": (1 / T,) * 3, "hinge": (1 / T,), "slide": (L / T,)}
    q = np.concatenate([units[joint.kind] for joint in scene.joints])
    v = np.concatenate([rates[joint.kind] for joint in scene.joints])
    new = _bare(
        scene,
        bodies=tuple(_scaled_body(body, L, M, T) for body in scene.bodies),
        q0=_numbers(np.array(scene.q0) * q),
        v0=_numbers(np.array(scene.v0) * v),
        gravity=_vector(np.array(scene.gravity) * (L / T**2)),
        duration=scene.duration * T,
        dt=scene.dt * T,
        contacts=tuple(_scaled_contact(contact, L) for contact in scene.contacts),
        forces=tuple(_scaled_force(force, L, M, T) for force in scene.forces),
        burning=tuple(Burning(burning.body, burning.rate * M / T) for burning in scene.burning),
    )
    slides = np.array([L if joint.kind == "slide" else 1.0 for joint in scene.scalar_joints])

    def back(motion: Trajectory) -> Trajectory:
        return replace(
            motion,
            t=motion.t / T,
            position=motion.position / L,
            velocity=motion.velocity / (L / T),
            omega=motion.omega * T,
            joint_position=motion.joint_position / slides,
            joint_velocity=motion.joint_velocity * T / slides,
        )

    return Equivalent(new, back)


def turned(scene: Scene, turn: Quaternion) -> Equivalent:
    """``scene`` in a world that is turned as a whole by ``turn`` (4,), gravity and all.

    Raises ``InputError`` for a scene with planes in the world, which not every engine can turn.
    """
    if any(contact.second is None for contact in scene.contacts):
        raise InputError(f"scene {scene.full_name}: got contacts with the world, expected none to turn")
    R = unit_quaternion("turn", turn)
    q0, v0 = np.array(scene.q0), np.array(scene.v0)
    for _, joint, at_q, at_v in scene.slices():
        if joint.kind == "free":
            place = q0[at_q]
            q0[at_q] = np.concatenate([quaternions.rotated(R, place[:3]), quaternions.product(R, place[3:])])
            v0[at_v.start : at_v.start + 3] = quaternions.rotated(R, v0[at_v][:3])
    bodies = [
        body
        if body.parent or any(joint.kind == "free" for joint in body.joints)
        else replace(
            body,
            position=_vector(quaternions.rotated(R, np.array(body.position))),
            quaternion=_turn(quaternions.product(R, np.array(body.quaternion))),
        )
        for body in scene.bodies
    ]
    new = _bare(
        scene,
        bodies=tuple(bodies),
        q0=_numbers(q0),
        v0=_numbers(v0),
        gravity=_vector(quaternions.rotated(R, np.array(scene.gravity))),
        forces=tuple(_turned_force(force, R) for force in scene.forces),
    )

    def back(motion: Trajectory) -> Trajectory:
        inverse = quaternions.conjugate(R)
        return replace(
            motion,
            position=quaternions.rotated(inverse, motion.position),
            quaternion=quaternions.product(inverse, motion.quaternion),
            velocity=quaternions.rotated(inverse, motion.velocity),
        )

    return Equivalent(new, back)


def reaxed(scene: Scene, turn: Quaternion) -> Equivalent:
    """``scene`` with other axes in every body: those it had turned by ``turn`` (4,).

    Raises ``InputError`` for a scene with contacts, whose shapes have axes too.
    """
    if scene.contacts:
        raise InputError(f"scene {scene.full_name}: got contacts, expected none where axes are others")
    R = unit_quaternion("turn", turn)
    inverse = quaternions.conjugate(R)
    q0, v0 = np.array(scene.q0), np.array(scene.v0)
    for _, joint, at_q, at_v in scene.slices():
        if joint.kind in ("free", "ball"):
            turned_q = quaternions.product(q0[at_q][-4:], R)
            first = joint.kind == "ball"
            q0[at_q.stop - 4 : at_q.stop] = quaternions.product(inverse, turned_q) if first else turned_q
            v0[at_v.stop - 3 : at_v.stop] = quaternions.rotated(inverse, v0[at_v][-3:])
    new = _bare(
        scene,
        bodies=tuple(_reaxed_body(body, R) for body in scene.bodies),
        q0=_numbers(q0),
        v0=_numbers(v0),
    )

    def back(motion: Trajectory) -> Trajectory:
        return replace(
            motion,
            quaternion=quaternions.product(motion.quaternion, inverse),
            omega=quaternions.rotated(R, motion.omega),
        )

    return Equivalent(new, back)


def cut(scene: Scene, share: float = 0.25, turn: Quaternion = (0.0, 0.0, 0.0, 1.0)) -> Equivalent:
    """``scene`` with every body made of two: a ``share`` of it is another body, welded on, its axes turned.

    Raises ``InputError`` for a scene whose masses burn, or attract: these act on whole bodies.
    """
    if scene.burning or any(not isinstance(force, Constant) for force in scene.forces):
        raise InputError(f"scene {scene.full_name}: got forces on masses, expected none where these are cut")
    R = unit_quaternion("turn", turn)
    bodies: list[Body] = []
    for body in scene.bodies:
        kept = 1 - share
        bodies.append(replace(body, mass=body.mass * kept, inertia=_tensor(kept * body.inertia_array)))
        axes = quaternions.matrix(R)
        bodies.append(
            Body(
                f"{body.name}, welded",
                body.mass * share,
                _tensor(axes.T @ (share * body.inertia_array) @ axes),
                (),
                _vector(quaternions.rotated(quaternions.conjugate(R), np.array(body.center_of_mass))),
                body.name,
                quaternion=_turn(R),
            )
        )

    def back(motion: Trajectory) -> Trajectory:
        parts = ("position", "quaternion", "velocity", "omega")
        return replace(motion, **{name: getattr(motion, name)[:, ::2] for name in parts})

    return Equivalent(_bare(scene, bodies=tuple(bodies)), back)


def _bare(scene: Scene, **changed: Any) -> Scene:
    """The scene changed, without what is true and on record of it as it was."""
    none: dict[str, Any] = {"ladders": {}, "errors": {}, "observables": (), "pictures": (), "reactions": ()}
    bodies = tuple(replace(body, solids=()) for body in changed.pop("bodies"))  # by mass and inertia alone
    return replace(scene, truth=_unknown, scheme_motion=None, bodies=bodies, **none, **changed)


def _unknown(scene: Scene, t: Array) -> Trajectory:
    raise InputError(f"scene {scene.full_name}: no truth is known of it in other words")


def _scaled_body(body: Body, L: float, M: float, T: float) -> Body:
    return replace(
        body,
        mass=body.mass * M,
        inertia=_tensor(body.inertia_array * (M * L**2)),
        center_of_mass=_vector(np.array(body.center_of_mass) * L),
        position=_vector(np.array(body.position) * L),
        joints=tuple(_scaled_joint(joint, L, M, T) for joint in body.joints),
    )


def _scaled_joint(joint: Joint, L: float, M: float, T: float) -> Joint:
    unit = M * L**2 if joint.kind == "hinge" else M
    return replace(joint, stiffness=joint.stiffness * (unit / T**2), damping=joint.damping * (unit / T))


def _scaled_contact(contact: Contact, L: float) -> Contact:
    shape = replace(contact.shape, radius=contact.shape.radius * L)
    against: Any = contact.against
    if isinstance(against, (Sphere, Rim)):
        against = replace(against, radius=against.radius * L)
    elif isinstance(against, Plane):
        against = replace(against, offset=against.offset * L)
    return replace(contact, shape=shape, against=against)


def _scaled_force(force: Force, L: float, M: float, T: float) -> Force:
    if isinstance(force, Blow):
        force = replace(force, start=force.start * T, end=force.end * T)
    if isinstance(force, Constant):
        return replace(force, force=_vector(np.array(force.force) * (M * L / T**2)))
    if isinstance(force, Spring):
        return replace(force, stiffness=force.stiffness * (M / T**2), length=force.length * L)
    if isinstance(force, Attraction):
        return replace(force, G=force.G * (L**3 / (M * T**2)))
    if isinstance(force, Center):
        return replace(force, GM=force.GM * (L**3 / T**2), center=_vector(np.array(force.center) * L))
    if isinstance(force, Coriolis):
        return replace(force, Omega=_vector(np.array(force.Omega) / T))
    if isinstance(force, Centrifugal):
        Omega, center = np.array(force.Omega) / T, np.array(force.center) * L
        return replace(force, Omega=_vector(Omega), center=_vector(center))
    raise InputError(f"force: got {type(force).__name__}, whose units are not known here")


def _turned_force(force: Force, R: Array) -> Force:
    if isinstance(force, (Spring, Attraction)):
        return force
    if not isinstance(force, (Constant, Center, Coriolis, Centrifugal)):
        raise InputError(f"force: got {type(force).__name__}, whose directions are not known here")
    names = [name for name in ("force", "center", "Omega") if hasattr(force, name)]
    turned: dict[str, Any] = {
        name: _vector(quaternions.rotated(R, np.array(getattr(force, name)))) for name in names
    }
    return replace(force, **turned)


def _reaxed_body(body: Body, R: Array) -> Body:
    inverse, axes = quaternions.conjugate(R), quaternions.matrix(R)
    free = any(joint.kind == "free" for joint in body.joints)
    new = replace(
        body,
        inertia=_tensor(axes.T @ body.inertia_array @ axes),
        center_of_mass=_vector(quaternions.rotated(inverse, np.array(body.center_of_mass))),
        joints=tuple(
            replace(joint, axis=_unit(quaternions.rotated(inverse, np.array(joint.axis))))
            for joint in body.joints
        ),
    )
    if free:
        return new
    place, turn = np.array(body.position), quaternions.product(np.array(body.quaternion), R)
    if body.parent:
        place, turn = quaternions.rotated(inverse, place), quaternions.product(inverse, turn)
    return replace(new, position=_vector(place), quaternion=_turn(turn))


def _numbers(values: Array) -> tuple[float, ...]:
    return tuple(values.tolist())


def _vector(value: Array) -> Vector:
    x, y, z = value.tolist()
    return x, y, z


def _unit(value: Array) -> Vector:
    return _vector(value / np.linalg.norm(value))


def _turn(value: Array) -> Quaternion:
    x, y, z, w = value.tolist()
    return x, y, z, w


def _tensor(value: Array) -> Matrix:
    symmetric = (value + value.T) / 2
    return _vector(symmetric[0]), _vector(symmetric[1]), _vector(symmetric[2])
