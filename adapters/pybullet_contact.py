"""Contact in PyBullet: the pairs that touch, and a solver that corrects nothing.

PyBullet multiplies the frictions and the restitutions of the two that touch: each gets the root.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..reference.errors import InputError
from ..scenarios.contact import Contact, Plane
from ..scenarios.scene import Scene
from .pybullet_layout import Place

#: Why no scheme of PyBullet's carries a disc on its rim.
NO_RIM = {
    "rim": "PyBullet has no shape that is right for a rim: a disc of 0.15 m, 0.001 rad aslant at half the "
    "speed at which it would stay up, must lean 0.10 rad after 0.8 s; a cylinder of 10 mm stands, one of 1 "
    "mm leans 0.42 rad and one of 0.1 mm 0.68 rad, at steps of 1 ms and 0.1 ms alike"
}
#: Nothing is corrected that the scene did not ask for: no push out of a depth, no least speed of a bounce.
SOLVER = {
    "numSolverIterations": 200, "solverResidualThreshold": 0, "contactERP": 0, "erp": 0, "frictionERP": 0,
    "contactSlop": 0, "restitutionVelocityThreshold": 0,
}  # fmt: skip
#: A step [s] in which nothing moves.
INSTANT = 1e-12


def connect(p: Any, client: int, scene: Scene, places: Sequence[Place]) -> list[tuple[Place, Place]]:
    """Let the pairs of the scene touch, and no others; where PyBullet has the two of each."""
    if not scene.defaults:
        p.setPhysicsEngineParameter(**SOLVER, physicsClientId=client)
    at: dict[str | None, Place] = {body.name: place for body, place in zip(scene.bodies, places, strict=True)}
    for place in places:
        p.setCollisionFilterGroupMask(*place, 0, 0, physicsClientId=client)
    pairs = [
        (at[c.first], _ground(p, client, c) if c.second is None else at[c.second]) for c in scene.contacts
    ]
    for contact, pair in zip(scene.contacts, pairs, strict=True):
        for place in pair:
            _rub(p, client, scene, contact, place)
        (uid, link), (other, other_link) = pair
        p.setCollisionFilterPair(uid, other, link, other_link, 1, physicsClientId=client)
    return pairs


def told(p: Any, client: int, scene: Scene, pairs: Sequence[tuple[Place, Place]]) -> dict[str, float]:
    """Friction and restitution of every contact, as PyBullet combines those of the two."""
    values: dict[str, float] = {}
    for contact, pair in zip(scene.contacts, pairs, strict=True):
        infos = [p.getDynamicsInfo(*place, client) for place in pair]
        values[f"contact/{contact.name}/friction"] = float(infos[0][1] * infos[1][1])
        values[f"contact/{contact.name}/restitution"] = float(infos[0][5] * infos[1][5])
    return values


def refuse(scene: Scene) -> None:
    """Raise ``InputError`` where one body would need two frictions, or two restitutions."""
    rubbed: dict[str, tuple[float, float]] = {}
    for contact in scene.contacts:
        for name in filter(None, (contact.first, contact.second)):
            asked = (contact.friction, contact.restitution)
            if rubbed.setdefault(name, asked) != asked:
                raise InputError(
                    f"scene {scene.full_name}: body {name!r} has contacts of different friction or "
                    "restitution; PyBullet has room for one of each on a body"
                )


def _rub(p: Any, client: int, scene: Scene, contact: Contact, place: Place) -> None:
    p.changeDynamics(
        *place, lateralFriction=np.sqrt(contact.friction), restitution=np.sqrt(contact.restitution),
        rollingFriction=0, spinningFriction=0, physicsClientId=client,
    )  # fmt: skip


def _ground(p: Any, client: int, contact: Contact) -> Place:
    """A plane of the world as a body of its own, that does not move and touches nothing by itself."""
    plane = contact.against
    if not isinstance(plane, Plane):
        raise InputError(f"contact {contact.name!r}: got {plane} in the world, expected a plane")
    shape = p.createCollisionShape(p.GEOM_PLANE, planeNormal=plane.normal, physicsClientId=client)
    place = (np.array(plane.normal) * plane.offset).tolist()
    uid = p.createMultiBody(0, shape, basePosition=place, physicsClientId=client)
    p.setCollisionFilterGroupMask(uid, -1, 0, 0, physicsClientId=client)
    return int(uid), -1
