"""Forces from outside the joints in MuJoCo: by its callback for passive forces, at every stage of a step."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import numpy as np

from ..reference.checked import Array
from ..scenarios.forces import Force, forces_on
from ..scenarios.scene import Scene


class Forces:
    """The forces of a scene on its ``bodies``, numbered as MuJoCo does.

    ``xfrc_applied`` would hold them still over a step, at which Runge-Kutta loses three of its orders.
    """

    def __init__(self, mujoco: Any, scene: Scene, bodies: Array) -> None:
        self._mujoco, self._kind, self._scene = mujoco, int(mujoco.mjtObj.mjOBJ_BODY), scene
        self._bodies, self._numbers = bodies, bodies.tolist()
        self._acting: Sequence[Force] = scene.forces
        self._total = forces_on(scene.bodies, scene.forces)
        self._needs_velocity = any(force.needs_velocity for force in scene.forces)
        self._velocity, self._speed = np.zeros((len(bodies), 3)), np.zeros(6)

    @contextmanager
    def acting(self, forces: Sequence[Force]) -> Iterator[None]:
        """Let those act on what MuJoCo steps meanwhile: its callback is the process's, not a model's."""
        if forces is not self._acting:
            self._acting, self._total = forces, forces_on(self._scene.bodies, forces)
        before = self._mujoco.get_mjcb_passive()
        self._mujoco.set_mjcb_passive(self._push)
        try:
            yield
        finally:
            self._mujoco.set_mjcb_passive(before)

    def found(self, model: Any, data: Any) -> Array:
        """What those that acted last are in the state of ``data`` (b, 3) [N], world axes."""
        mujoco, velocity, speed = self._mujoco, self._velocity, self._speed
        if self._needs_velocity:
            for row, body in zip(velocity, self._numbers, strict=True):
                mujoco.mj_objectVelocity(model, data, self._kind, body, speed, 0)
                row[:] = speed[3:]
        return self._total(data.xipos.take(self._bodies, 0), velocity)

    def _push(self, model: Any, data: Any) -> None:
        apply, result, places = self._mujoco.mj_applyFT, data.qfrc_passive, data.xipos.take(self._bodies, 0)
        for force, place, body in zip(self.found(model, data), places, self._numbers, strict=True):
            apply(model, data, force, _NO_TORQUE, place, body, result)


_NO_TORQUE = np.zeros(3)
