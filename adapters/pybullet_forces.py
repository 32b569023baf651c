"""What PyBullet is handed at the start of each step: forces of springs and from outside, falling masses."""

from collections.abc import Callable, Sequence
from functools import lru_cache, partial
from typing import Any

import numpy as np

from ..scenarios.blows import over_step
from ..scenarios.burning import Burning
from ..scenarios.forces import forces_on
from ..scenarios.scene import Scene
from .pybullet_layout import Layout

#: Hands PyBullet forces for the step of this number, the first being 0.
Push = Callable[[int], None]


def pushes(p: Any, client: int, scene: Scene, layout: Layout, dt: float) -> list[Push]:
    """What to call before each step, of ``dt`` [s]; nothing where nothing but gravity and dampers act."""
    found = [_springs(p, client, *tree) for tree in layout.springs]
    found += [_forces(p, client, scene, layout, dt)] if scene.forces else []
    return found + [_falling(p, client, scene, layout, burning, dt) for burning in scene.burning]


def _springs(p: Any, client: int, uid: int, links: Sequence[int], pulls: Sequence[float]) -> Push:
    read, push, torque = p.getJointStates, p.setJointMotorControlArray, p.TORQUE_CONTROL

    def pull(step: int) -> None:
        pulled = [k * state[0] for k, state in zip(pulls, read(uid, links, client), strict=True)]
        push(uid, links, torque, forces=pulled, physicsClientId=client)

    return pull


def _falling(p: Any, client: int, scene: Scene, layout: Layout, burning: Burning, dt: float) -> Push:
    """The mass of a body at the start of each step."""
    place = layout.bodies[burning.place(scene.bodies)]
    mass, _, moments, *_ = p.getDynamicsInfo(*place, client)

    def fall(step: int) -> None:
        share = burning.share(scene.bodies, step * dt)
        # A mass alone would overwrite the moments by those of a shape that is not there.
        left = [moment * share for moment in moments]
        p.changeDynamics(*place, mass=mass * share, localInertiaDiagonal=left, physicsClientId=client)

    return fall


def _forces(p: Any, client: int, scene: Scene, layout: Layout, dt: float) -> Push:
    those, always = lru_cache(partial(forces_on, scene.bodies)), forces_on(scene.bodies, scene.forces)
    timed = "blow" in scene.features
    position, velocity = np.empty((2, len(scene.bodies), 3))
    linked = [
        (uid, numbers, [layout.bodies[number][1] for number in numbers])
        for uid, numbers in layout.linked.items()
    ]

    def push(step: int) -> None:
        total = those(over_step(scene.forces, dt, step)) if timed else always
        for body, uid, _, _ in layout.free:
            position[body], _ = p.getBasePositionAndOrientation(uid, client)
            velocity[body], _ = p.getBaseVelocity(uid, client)
        for uid, numbers, links in linked:
            for body, state in zip(numbers, p.getLinkStates(uid, links, 1, 1, client), strict=True):
                position[body], velocity[body] = state[0], state[6]
        for place, force, at in zip(layout.bodies, total(position, velocity), position, strict=True):
            p.applyExternalForce(*place, force, at, p.WORLD_FRAME, client)

    return push
