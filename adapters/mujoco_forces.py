"""Forces from outside the joints in MuJoCo: by its callback for passive forces, at every stage of a step."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from ..reference.checked import Array
from ..scenarios.forces import forces_on
from ..scenarios.scene import Scene


class Forces:
    """The forces of a scene on its ``bodies``, numbered as MuJoCo does.

    ``xfrc_applied`` would hold them still over a step, at which Runge-Kutta loses three of its orders.
    """

    def __init__(self, mujoco: Any, scene: Scene, bodies: Array) -> None:
        self._mujoco, self._bodies = mujoco, bodies
        self._total = forces_on(scene.bodies, scene.forces)
        self._needs_velocity = any(force.needs_velocity for force in scene.forces)
        self._velocity, self._speed = np.zeros((len(bodies), 3)), np.zeros(6)

    @contextmanager
    def acting(self) -> Iterator[None]:
        """Let them act on what MuJoCo steps meanwhile: its callback is the process's, not a model's."""
        before = self._mujoco.get_mjcb_passive()
        self._mujoco.set_mjcb_passive(self._push)
        try:
            yield
        finally:
            self._mujoco.set_mjcb_passive(before)

    def _push(self, model: Any, data: Any) -> None:
        mujoco, velocity = self._mujoco, self._velocity
        if self._needs_velocity:
            for row, body in zip(velocity, self._bodies, strict=True):
                mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_BODY, body, self._speed, 0)
                row[:] = self._speed[3:]
        places = data.xipos[self._bodies]
        for force, place, body in zip(self._total(places, velocity), places, self._bodies, strict=True):
            mujoco.mj_applyFT(model, data, force, _NO_TORQUE, place, body, data.qfrc_passive)


_NO_TORQUE = np.zeros(3)
