"""Reactions of joints, in PyBullet: sensors in the joints of a copy of the world, which takes one step."""

from typing import Any, Protocol

import numpy as np

from ..reference.checked import Array
from ..reference.quaternions import cross, rotated
from ..scenarios.scene import Scene
from .pybullet_layout import Layout


class World(Protocol):
    """A scene in a client of PyBullet: where all is, and the bodies' inertial frames in their own."""

    client: int
    steps: int
    scene: Scene
    at: Layout
    center: Array
    axes: Array

    def advance(self, n: int) -> None:
        """Take ``n`` steps."""
        ...


class Sensors:
    """Sensors in a ``copy`` of a world that runs, of the same step.

    A sensor speaks of the state *before* the step that was taken last: put where the world that runs is, the
    copy takes that step for it. It tells the force and moment of the parent on the body, about the body's
    centre of mass, along its principal axes. The reading is handed on as it is but for frame and point.
    In 3.2.7 its moment holds Iω's gyroscopic term ω×Iω a second time, of the ω *after* the step, from the
    pass that PyBullet makes for constraints.
    """

    def __init__(self, p: Any, copy: World) -> None:
        self._p, self._copy = p, copy
        names = [body.name for body in copy.scene.bodies]
        self._held = [names.index(name) for name in copy.scene.reactions]
        for uid, link in self._places():
            p.enableJointForceTorqueSensor(uid, link, True, copy.client)

    def read(self, run: World) -> Array:
        """Reactions (k, 6) in the present state of ``run``, as ``Trajectory.reaction`` has them."""
        self._follow(run)
        self._copy.advance(1)
        told = [self._p.getJointStateMultiDof(*place, self._copy.client)[2] for place in self._places()]
        axes, center = self._copy.axes[self._held], self._copy.center[self._held]
        force, moment = (rotated(axes, part) for part in np.split(np.array(told), 2, axis=1))
        return np.hstack([force, moment + cross(center, force)])

    def _places(self) -> list[tuple[int, int]]:
        return [self._copy.at.bodies[body] for body in self._held]

    def _follow(self, run: World) -> None:
        """Put the copy where and when the world that runs is, in PyBullet's own numbers."""
        self._copy.steps = run.steps
        p, to, at = self._p, self._copy.client, self._copy.at
        for here, there in zip(at.free, run.at.free, strict=True):
            p.resetBasePositionAndOrientation(
                here.uid, *p.getBasePositionAndOrientation(there.uid, run.client), to
            )
            p.resetBaseVelocity(here.uid, *p.getBaseVelocity(there.uid, run.client), to)
        for ball, same in zip(at.balls, run.at.balls, strict=True):
            turn, omega, *_ = p.getJointStateMultiDof(same.uid, same.link, run.client)
            p.resetJointStateMultiDof(ball.uid, ball.link, turn, omega, to)
        for scalar, equal in zip(at.scalars, run.at.scalars, strict=True):
            position, velocity, *_ = p.getJointState(equal.uid, equal.link, run.client)
            p.resetJointState(scalar.uid, scalar.link, position, velocity, to)
