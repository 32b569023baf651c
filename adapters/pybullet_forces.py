"""What PyBullet is handed at the start of each step: forces of springs, and those from outside the joints."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from ..scenarios.forces import forces_on
from ..scenarios.scene import Scene
from .pybullet_layout import Layout

#: Hands PyBullet forces for one step.
Push = Callable[[], None]


def pushes(p: Any, client: int, scene: Scene, layout: Layout) -> list[Push]:
    """What to call before each step of a scene; nothing where nothing but gravity and dampers act."""
    springs = [_springs(p, client, *tree) for tree in layout.springs]
    return [*springs, _forces(p, client, scene, layout)] if scene.forces else springs


def _springs(p: Any, client: int, uid: int, links: Sequence[int], pulls: Sequence[float]) -> Push:
    read, push, torque = p.getJointStates, p.setJointMotorControlArray, p.TORQUE_CONTROL

    def pull() -> None:
        pulled = [k * state[0] for k, state in zip(pulls, read(uid, links, client), strict=True)]
        push(uid, links, torque, forces=pulled, physicsClientId=client)

    return pull


def _forces(p: Any, client: int, scene: Scene, layout: Layout) -> Push:
    total, count = forces_on(scene.bodies, scene.forces), len(scene.bodies)
    position, velocity = np.empty((count, 3)), np.empty((count, 3))
    linked = [
        (uid, numbers, [layout.bodies[number][1] for number in numbers])
        for uid, numbers in layout.linked.items()
    ]

    def push() -> None:
        for body, uid, _, _ in layout.free:
            position[body], _ = p.getBasePositionAndOrientation(uid, client)
            velocity[body], _ = p.getBaseVelocity(uid, client)
        for uid, numbers, links in linked:
            for body, state in zip(numbers, p.getLinkStates(uid, links, 1, 1, client), strict=True):
                position[body], velocity[body] = state[0], state[6]
        for place, force, at in zip(layout.bodies, total(position, velocity), position, strict=True):
            p.applyExternalForce(*place, force, at, p.WORLD_FRAME, client)

    return push
