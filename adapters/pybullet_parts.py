"""What a PyBullet world holds, counted.

It does not tell which pairs of shapes its filters let touch, nor whether bodies may sleep; the second shows
in its dampings, which are tried. Its solver runs in any case, over nothing where nothing can touch.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np

from ..scenarios.parts import BUILT
from ..scenarios.scene import Scene
from .pybullet_probes import Change


def built(p: Any, client: int, maximal: bool, scene: Scene) -> dict[str, int]:
    """Parts of a world by the names of ``scenarios.parts``, each with ``built/`` in front.

    Those of its shapes that inertias are worked out from it does not tell from others: the scene does.
    """
    solids = sum(len(body.solids) for body in scene.bodies)
    uids = [p.getBodyUniqueId(i, client) for i in range(p.getNumBodies(client))]
    seen = sum(len(p.getVisualShapeData(uid, physicsClientId=client)) for uid in uids)
    # In maximal coordinates it does not tell its shapes, but gives each of them a picture.
    shapes = seen if maximal else sum(_shapes(p, client, uid) for uid in uids)
    window = p.getConnectionInfo(client)["connectionMethod"] != p.DIRECT
    moving = [width for uid in uids for width in _moving(p, client, uid)]
    found = {
        "bodies": sum(_weighing(p, client, uid) for uid in uids),
        "joints": len(moving),
        "coordinates": sum(moving),
        "shapes": shapes - solids,
        "constraints": p.getNumConstraints(client),
        "pictures": seen - shapes + window,
        "others": sum(_idle(p, client, uid) for uid in uids),
    }
    return {BUILT + name: int(count) for name, count in found.items()}


def busy(p: Any, client: int, scene: Scene, change: Change) -> dict[str, float]:
    """Motors that push and sensors that feel something over a step in which every joint moves."""
    change(np.array(scene.q0), np.ones(len(scene.v0)), 1e-3, 1)
    states = list(_joint_states(p, client))
    motors = sum(any(_numbers(state[3])) for state in states)
    sensors = sum(any(state[2]) for state in states)
    return {f"{BUILT}actuators": motors, f"{BUILT}sensors": sensors}


def _joint_states(p: Any, client: int) -> Iterator[Any]:
    for i in range(p.getNumBodies(client)):
        uid = p.getBodyUniqueId(i, client)
        for link in range(p.getNumJoints(uid, client)):
            ball = p.getJointInfo(uid, link, client)[2] == p.JOINT_SPHERICAL
            yield (p.getJointStateMultiDof if ball else p.getJointState)(uid, link, client)


def _numbers(force: Any) -> tuple[float, ...]:
    return force if isinstance(force, tuple) else (force,)


def _links(p: Any, client: int, uid: int) -> range:
    return range(-1, p.getNumJoints(uid, client))


def _weighing(p: Any, client: int, uid: int) -> int:
    return sum(p.getDynamicsInfo(uid, link, client)[0] > 0 for link in _links(p, client, uid))


def _shapes(p: Any, client: int, uid: int) -> int:
    return sum(len(p.getCollisionShapeData(uid, link, client)) for link in _links(p, client, uid))


def _moving(p: Any, client: int, uid: int) -> Iterator[int]:
    """Velocities of each joint that moves, a base that weighs something being one."""
    if p.getDynamicsInfo(uid, -1, client)[0] > 0:
        yield 6
    for link in range(p.getNumJoints(uid, client)):
        kind = p.getJointInfo(uid, link, client)[2]
        if kind != p.JOINT_FIXED:
            yield 3 if kind == p.JOINT_SPHERICAL else 1


def _idle(p: Any, client: int, uid: int) -> int:
    """1 for a body that neither weighs nor touches anything."""
    if _weighing(p, client, uid) or p.getVisualShapeData(uid, physicsClientId=client):
        return 0
    return 1
