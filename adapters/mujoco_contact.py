"""Contact in MuJoCo: shapes, the pairs that touch, and a solver set so that it does what was asked.

MuJoCo's contacts are springs that take away a share of what would break them, the impedance. With a
damping of 1/dt along the normal a contact's velocity is 0 after one step, and with (1 + e)/dt it is
−e times what it was.

What slides is lifted by μ times as much as friction gives way along the surface, as MuJoCo's friction is
convex, and it hops where that is more than the share of its weight that it lies too deep by. So where a
scene lets something slide, friction is given no damping, some softness is left along the normal, and
across it next to none. Where it is to hold, without a damping it would not follow a surface that turns.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np

from ..scenarios.contact import Contact, Plane, Rim, Sphere
from ..scenarios.scene import Scene

#: The impedance, at any depth (MuJoCo's own changes over the first millimetre): its most, and of what slides.
HARD, SLIDING = 0.9999, 0.995
#: Of a rim, whose lowest point rises and falls as the disc leans: it must stay in touch over a step.
ON_A_RIM = 0.99
#: No spring or damper; with a 0 MuJoCo would take the other number for something else.
NOTHING = 1e-15
#: Half the width and half the depth [m] of the box that stands for a plane that moves.
WIDTH, DEPTH = 10.0, 0.5
#: How much less friction gives way than the normal does, where it holds and where something slides.
HOLDS, SLIDES = 10.0, 1e4
#: Thickness of the ellipsoid that stands for a rim, to its radius.
THIN = 1e-3


def add_contacts(mujoco: Any, spec: Any, bodies: Mapping[str | None, Any], scene: Scene, dt: float) -> None:
    """Give a model its shapes and contacts, and its solver what it needs for them, or leave it as it is."""
    if not scene.defaults:
        option = spec.option
        option.cone, option.tolerance = mujoco.mjtCone.mjCONE_ELLIPTIC, 0.0
        soft = any(_impedance(contact) < HARD for contact in scene.contacts)
        option.impratio = SLIDES if soft else HOLDS
    for number, contact in enumerate(scene.contacts):
        raised = 0.0 if scene.defaults else _settled(contact, scene, dt)
        _add_shape(mujoco, bodies[contact.first], contact.shape, f"{number} first", 0.0)
        _add_shape(mujoco, bodies[contact.second], contact.against, f"{number} second", raised)
        pair = spec.add_pair(name=contact.name, geomname1=f"{number} first", geomname2=f"{number} second")
        pair.friction[:2], pair.condim = contact.friction, 3 if contact.friction else 1
        if not scene.defaults:
            _set(pair, contact, dt)


def _set(pair: Any, contact: Contact, dt: float) -> None:
    pair.solimp[:2] = _impedance(contact)
    pair.solref = [-1 / dt**2, -1 / dt] if contact.friction else [-NOTHING, -(1 + contact.restitution) / dt]
    if contact.slides:
        pair.solreffriction = [-NOTHING, -NOTHING]


def told(model: Any, scene: Scene) -> dict[str, float]:
    """Friction and restitution of every contact, as the compiled model has them."""
    values: dict[str, float] = {}
    for number, contact in enumerate(scene.contacts):
        values[f"contact/{contact.name}/friction"] = float(model.pair_friction[number, 0])
        stiffness, damping = -model.pair_solref[number]
        # Given as a time and a share of what damps it out, both positive, it is never thrown back.
        again = damping * float(model.opt.timestep) - 1 if stiffness > 0 else 0.0
        values[f"contact/{contact.name}/restitution"] = float(again)
    return values


def _impedance(contact: Contact) -> float:
    if isinstance(contact.shape, Rim):
        return ON_A_RIM
    return SLIDING if contact.slides else HARD


def _settled(contact: Contact, scene: Scene, dt: float) -> float:
    """How deep [m] a body lies in what it rests on, so that it neither sinks nor is thrown up at first."""
    if not contact.friction:
        return 0.0
    return (1 - _impedance(contact)) * float(np.linalg.norm(scene.gravity)) * dt**2


def _add_shape(mujoco: Any, body: Any, shape: Any, name: str, raised: float) -> None:
    geom = body.add_geom(name=name, contype=0, conaffinity=0)
    if isinstance(shape, Sphere):
        geom.type, geom.size = mujoco.mjtGeom.mjGEOM_SPHERE, [shape.radius, 0, 0]
    elif isinstance(shape, Plane):
        _flat(mujoco, geom, shape, raised, fixed=body.name == "world")
    else:  # of an ellipsoid as thin as this only the rim ever touches
        geom.type, geom.size = (
            mujoco.mjtGeom.mjGEOM_ELLIPSOID,
            [shape.radius, shape.radius, THIN * shape.radius],
        )


def _flat(mujoco: Any, geom: Any, plane: Plane, raised: float, fixed: bool) -> None:
    """A plane; or, as MuJoCo's planes do not move, the face of a box."""
    geom.type = mujoco.mjtGeom.mjGEOM_PLANE if fixed else mujoco.mjtGeom.mjGEOM_BOX
    geom.size = [0, 0, 1] if fixed else [WIDTH, WIDTH, DEPTH]
    normal = np.array(plane.normal)
    geom.pos = normal * (plane.offset + raised - (0.0 if fixed else DEPTH))
    geom.quat = _turn_to(normal)


def _turn_to(normal: Any) -> list[float]:
    """Turn (4,), scalar first, that takes z to ``normal`` (3,)."""
    x, y, z = normal
    if z < -1 + 1e-12:
        return [0.0, 1.0, 0.0, 0.0]
    quat = np.array([1 + z, -y, x, 0.0])
    return [float(part) for part in quat / np.linalg.norm(quat)]
